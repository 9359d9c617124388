// SPDX-License-Identifier: BSD-3-Clause
/// \file Where a rod is at rest, and where a clamp carries it: the default places of supports.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/scene/supports.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <variant>

namespace pyrod {

/// A clamp that carries a rod as a whole to where it holds it, and the vertex that it holds.
struct Carrier {
  Clamp clamp;
  int vertex;
};

/// The first support along the rod, of those that are clamps or have no position of their own, if
/// that is a clamp with a position or a frame of its own. Whoever leaves a place before it to its
/// default wants the rod to start from there, and bends it into the clamp.
inline std::optional<Carrier> carrier(const SceneOnGrids& on, int rod) {
  const Support* first = nullptr;
  double at = std::numeric_limits<double>::infinity();
  for (const auto& support : on.scene().supports) {
    const auto& place = place_of(support);
    const double s = place.rod == rod ? on.arc_length(place) : at;
    if (s < at && (std::holds_alternative<Clamp>(support) || !position_of(support)))
      first = &support, at = s;
  }
  const auto* clamp = first ? std::get_if<Clamp>(first) : nullptr;
  if (!clamp || (!clamp->position && !clamp->frame)) return std::nullopt;
  return Carrier{*clamp, on.vertex(clamp->at)};
}

/// A rod at rest, perhaps carried; its shape is computed when it is asked for.
class Rest {
 public:
  Rest(const Rod<Spatial>& rod, const Placement<Spatial>& placement)
      : rod_(rod), start_(placement) {}

  /// The rod carried as a whole.
  Rest(const Rod<Spatial>& rod, const Placement<Spatial>& placement, const Carrier& by)
      : Rest(rod, placement) {
    const auto at = Rest(rod, placement).place(by.vertex);
    if (by.clamp.frame) {
      const Quaternion turn = *by.clamp.frame * at.frame.conjugate();
      start_ = {at.position + rotate(turn, Vec3(start_.position - at.position)),
                turn * start_.frame};
    }
    if (by.clamp.position) start_.position += *by.clamp.position - at.position;
  }

  /// Position and frame of a vertex.
  Placement<Spatial> place(int vertex) {
    if (vertex == 0) return start_;
    if (!shape_) shape_ = rod_.at_rest(start_.position, start_.frame);
    const std::size_t j = std::size_t(vertex);
    const Vec3 half = rod_.grid.h(vertex - 1) / 2 * rod_.K0[j];
    return {shape_->positions[j], shape_->frames[j - 1] * exp(half)};
  }

 private:
  const Rod<Spatial>& rod_;
  Placement<Spatial> start_;
  std::optional<CosseratCurve<Spatial>> shape_;
};

}  // namespace pyrod
