// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene on its grids: rods with vertices at all places, and the loads brought to them.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/point_loads.hpp>
#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/scene/rod_spec.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/scene/supports.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

namespace detail {

/// Arc lengths at which rods need vertices, rod by rod.
using Wanted = std::vector<std::vector<double>>;

/// Where rods are held and joined; and where point loads act, of rods whose grid the solver
/// chooses, or of all.
inline Wanted vertices_of_places(const Scene& scene, bool all) {
  Wanted at(scene.rods.size());
  const auto mark = [&](const Place& place, bool point_load) {
    const auto& rod = scene.rods[std::size_t(place.rod)];
    const double s = place.on(Grid(rod.edge_lengths));
    const bool wanted = !point_load || all || rod.chooses;
    if (wanted && s > 0 && s < rod.length()) at[std::size_t(place.rod)].push_back(s);
  };
  for (const auto& support : scene.supports) mark(place_of(support), false);
  for (const auto& joint : scene.joints)
    for (const auto& place : joint.points) mark(place, false);
  for (const auto& load : scene.loads) {
    if (const auto* force = std::get_if<Force>(&load)) mark(force->at, true);
    if (const auto* moment = std::get_if<Moment>(&load)) mark(moment->at, true);
  }
  return at;
}

/// Calls visit(values, number of the rod, name) for what acts along rods.
template <class Visit>
void visit_along(Scene& scene, const Visit& visit) {
  for (auto& load : scene.loads) {
    if (auto* force = std::get_if<DistributedForce>(&load))
      visit(force->force_per_length, force->rod, "force_per_length");
    if (auto* moment = std::get_if<DistributedMoment>(&load))
      visit(moment->moment_per_length, moment->rod, "moment_per_length");
  }
}

/// Values edge by edge as a function of arc length.
inline std::function<Vec3(double)> steps_of(std::vector<Vec3> values, const Grid& grid) {
  return [values = std::move(values), grid](double s) {
    return values[std::size_t(edge_at(grid, s))];
  };
}

inline void add_vertices(const Wanted& at, Scene& scene) {
  for (std::size_t i = 0; i < at.size(); ++i)
    if (!at[i].empty()) scene.rods[i] = with_vertices(std::move(scene.rods[i]), at[i]);
}

}  // namespace detail

/// The scene with vertices where rods are held and joined; and where point loads act, of rods
/// whose grid the solver chooses, or of all. Lists of loads, one per edge of a rod as it was given,
/// or cut at its places, become steps, which hold on any grid.
inline Scene with_vertices_at_places(Scene scene, bool all) {
  scene.check_places();
  const std::vector<RodSpec> given = scene.rods;
  detail::add_vertices(detail::vertices_of_places(scene, false), scene);
  detail::Wanted at(scene.rods.size());
  detail::visit_along(scene, [&](Along<Vec3>& along, int rod, const char* name) {
    const auto* list = std::get_if<std::vector<Vec3>>(&along);
    if (!list) return;
    const auto size = Eigen::Index(list->size());
    const auto &before = given[std::size_t(rod)], &now = scene.rods[std::size_t(rod)];
    const Grid grid(size == before.edge_lengths.size() ? before.edge_lengths : now.edge_lengths);
    require(size == grid.edges(), name, ": expected 3 numbers, or ", now.edge_lengths.size(),
            " times 3 (one per edge), got shape (", size, ", 3)");
    for (std::size_t j = 1; now.chooses && j < list->size(); ++j)
      if ((*list)[j] != (*list)[j - 1]) at[std::size_t(rod)].push_back(grid.s(int(j)));
    along = detail::steps_of(*list, grid);
  });
  if (all) detail::add_vertices(detail::vertices_of_places(scene, true), scene);
  detail::add_vertices(at, scene);
  return scene;
}

/// What acts on a rod that has each edge of `places` cut in so many.
class LoadedGrid {
 public:
  LoadedGrid(const Rod<Spatial>& rod, const Grid& places)
      : rod_(rod), places_(places), parts_(rod.edges() / places.edges()), loads_(rod.edges()) {}

  Loads<Spatial> take() { return std::move(loads_); }

  void add(const Force& force) {
    const Site at = site(force.at);
    if (force.follower)
      loads_.add_follower_force(rod_.grid, force.force, at, {rod_.K0.front(), rod_.K0.back()});
    else
      loads_.add_force(rod_.grid, force.force, at);
  }
  void add(const Moment& moment) {
    const Site at = site(moment.at);
    if (!moment.follower) return loads_.add_moment(rod_.grid, moment.moment, at);
    const auto vertex = std::size_t(at.edge + (at.part >= 0.5));
    loads_.add_follower_moment(rod_.grid, moment.moment, at, rod_.bending[vertex].cwiseInverse());
  }
  void add(const DistributedForce& force) {
    const auto f = on_edges(force.force_per_length, "force_per_length");
    force.follower ? loads_.add_follower_force_per_length(rod_.grid, f)
                   : loads_.add_force_per_length(rod_.grid, f);
  }
  void add(const DistributedMoment& moment) {
    const auto l = on_edges(moment.moment_per_length, "moment_per_length");
    moment.follower ? loads_.add_follower_moment_per_length(rod_.grid, l)
                    : loads_.add_moment_per_length(rod_.grid, l);
  }
  void add_weight(const Vec3& acceleration, const std::vector<double>& mass) {
    std::vector<Vec3> f;
    for (const double m : mass) f.push_back(m * acceleration);
    loads_.add_force_per_length(rod_.grid, f);
  }

 private:
  Site site(const Place& place) const {
    return Site::on(places_, place.on(places_)).refined(parts_);
  }
  std::vector<Vec3> on_edges(const Along<Vec3>& along, const char* name) const {
    return sampled(along, centres(rod_.grid.arc_lengths()), name, "edge");
  }

  const Rod<Spatial>& rod_;
  const Grid& places_;
  int parts_;
  Loads<Spatial> loads_;
};

/// One level of a climb: all edges of the scene, whose places have vertices, are cut in 2ᵏ. Places
/// are found once, on level 0: on finer grids they are the same by number.
class SceneOnGrids {
 public:
  explicit SceneOnGrids(Scene scene, int level = 0) : scene_(std::move(scene)), parts_(1 << level) {
    scene_.check_places();
    for (const auto& spec : scene_.rods) {
      places_.emplace_back(spec.edge_lengths);
      rods_.push_back(on_grid(spec, parts_));
    }
    for (std::size_t i = 0; i < rods_.size(); ++i) loads_.push_back(acting_on(i));
  }

  const Scene& scene() const { return scene_; }
  const Rod<Spatial>& rod(int i) const { return rods_[std::size_t(i)].rod; }
  const Loads<Spatial>& loads(int i) const { return loads_[std::size_t(i)]; }

  /// The vertex at a place.
  int vertex(const Place& at) const {
    const auto& grid = places_[std::size_t(at.rod)];
    const double s = at.on(grid);
    Eigen::Index nearest = 0;
    (grid.arc_lengths().array() - s).abs().minCoeff(&nearest);
    return int(nearest) * parts_;
  }
  double arc_length(const Place& at) const { return at.on(places_[std::size_t(at.rod)]); }

 private:
  Loads<Spatial> acting_on(std::size_t i) const {
    LoadedGrid out(rods_[i].rod, places_[i]);
    for (const auto& load : scene_.loads)
      std::visit([&](const auto& one) { add(one, i, out); }, load);
    return out.take();
  }
  template <class PointLoad>
    requires requires(const PointLoad& load) { load.at; }
  void add(const PointLoad& load, std::size_t i, LoadedGrid& out) const {
    if (std::size_t(load.at.rod) == i) out.add(load);
  }
  template <class Distributed>
    requires requires(const Distributed& load) { load.rod; }
  void add(const Distributed& load, std::size_t i, LoadedGrid& out) const {
    if (std::size_t(load.rod) == i) out.add(load);
  }
  void add(const Gravity& gravity, std::size_t i, LoadedGrid& out) const {
    const auto heavy = [](const RodOnGrid& rod) {
      return std::ranges::any_of(rod.mass, [](double m) { return m > 0; });
    };
    require(std::ranges::any_of(rods_, heavy),
            "Gravity: no rod has a mass; give its material a density, or its section a "
            "mass_per_length");
    out.add_weight(gravity.acceleration, rods_[i].mass);
  }

  Scene scene_;
  int parts_;
  std::vector<Grid> places_;  ///< of level 0
  std::vector<RodOnGrid> rods_;
  std::vector<Loads<Spatial>> loads_;
};

}  // namespace pyrod
