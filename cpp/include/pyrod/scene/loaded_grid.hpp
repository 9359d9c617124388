// SPDX-License-Identifier: BSD-3-Clause
/// \file A rod on a grid, and what acts on it there.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/point_loads.hpp>

#include <utility>
#include <vector>

namespace pyrod {

/// A rod that has each edge of `places`, on which places are told, cut in so many. Loads add
/// themselves to it.
class LoadedGrid {
 public:
  /// `gravity`: of all loads of the scene.
  LoadedGrid(const RodOnGrid& made, const Grid& places, const Vec3& gravity)
      : made_(made),
        places_(places),
        gravity_(gravity),
        parts_(made.rod.edges() / places.edges()),
        loads_(made.rod.edges()) {}

  const Rod<Spatial>& rod() const { return made_.rod; }
  const Grid& grid() const { return made_.rod.grid; }
  const std::vector<double>& mass() const { return made_.mass; }  ///< per length, of the edges

  const Vec3& gravity() const { return gravity_; }  ///< of the scene [m/s²]

  Site site(const Place& place) const {
    return Site::on(places_, place.on(places_)).refined(parts_);
  }
  std::vector<Vec3> on_edges(const Along<Vec3>& along, const char* name) const {
    return sampled(along, centres(grid().arc_lengths()), name, "edge");
  }

  Loads<Spatial>& loads() { return loads_; }
  Loads<Spatial> take() { return std::move(loads_); }

 private:
  const RodOnGrid& made_;
  const Grid& places_;
  Vec3 gravity_;
  int parts_;
  Loads<Spatial> loads_;
};

}  // namespace pyrod
