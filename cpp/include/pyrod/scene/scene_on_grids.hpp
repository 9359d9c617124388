// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene on its grids: rods with vertices at all places, and the loads brought to them.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>
#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/loaded_grid.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/point_loads.hpp>
#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/scene/rod_spec.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/scene/supports.hpp>
#include <pyrod/scene/tendons_on_grids.hpp>

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

/// Where rods are held and joined, where tendons end; and where point loads act, of rods whose grid
/// the solver chooses, or of all.
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
  for (const auto& load : scene.loads)
    if (const auto* place = point_of(load)) mark(*place, true);
  for (const auto& actuator : scene.actuators) {
    const auto& tendon = std::get<Tendon>(actuator);
    auto& own = at[std::size_t(tendon.rod)];
    const auto places = places_of(tendon, scene.rods[std::size_t(tendon.rod)].length());
    own.insert(own.end(), places.begin(), places.end());
  }
  return at;
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
/// or cut at its places, become steps, which hold on any grid, and those of tendons polygons.
inline Scene with_vertices_at_places(Scene scene, bool all) {
  scene.check_places();
  const std::vector<RodSpec> given = scene.rods;
  detail::add_vertices(detail::vertices_of_places(scene, false), scene);
  detail::Wanted at(scene.rods.size());
  const auto make_steps = [&](Along<Vec3>& along, int rod, const char* name) {
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
  };
  for (auto& load : scene.loads) visit_along(load, make_steps);
  for (auto& actuator : scene.actuators) {
    auto& tendon = std::get<Tendon>(actuator);
    const auto rod = std::size_t(tendon.rod);
    make_polygon(tendon, Grid(given[rod].edge_lengths), Grid(scene.rods[rod].edge_lengths));
    if (scene.rods[rod].chooses)
      for (const double s : places_of(tendon, scene.rods[rod].length())) at[rod].push_back(s);
  }
  if (all) detail::add_vertices(detail::vertices_of_places(scene, true), scene);
  detail::add_vertices(at, scene);
  return scene;
}

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
    for (const auto& load : scene_.loads) check_load(load, rods_, scene_.loads);
    for (int i = 0; i < int(rods_.size()); ++i) loads_.push_back(acting_on(i));
  }

  const Scene& scene() const { return scene_; }
  const Rod<Spatial>& rod(int i) const { return rods_[std::size_t(i)].rod; }
  const Loads<Spatial>& loads(int i) const { return loads_[std::size_t(i)]; }

  /// Other supports and loads, at the places of those before.
  void change(const Changes& changes) {
    for (const auto& [i, load] : changes.loads) check_load(load, rods_, scene_.loads);
    changes.apply(scene_);
    if (changes.loads.empty()) return;
    for (int i = 0; i < int(rods_.size()); ++i) loads_[std::size_t(i)] = acting_on(i);
  }

  /// What one load alone does to a rod.
  Loads<Spatial> acting(const Load& load, int i) const {
    LoadedGrid on = bare(i);
    add(load, on);
    return on.take();
  }

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
  LoadedGrid bare(int i) const {
    return {rods_[std::size_t(i)], places_[std::size_t(i)], gravity_of(scene_.loads)};
  }
  Loads<Spatial> acting_on(int i) const {
    LoadedGrid on = bare(i);
    for (const auto& load : scene_.loads)
      if (rod_of(load).value_or(i) == i) add(load, on);
    return on.take();
  }
  static void add(const Load& load, LoadedGrid& on) {
    std::visit([&](const auto& one) { one.act(on); }, load);
  }

  Scene scene_;
  int parts_;
  std::vector<Grid> places_;  ///< of level 0
  std::vector<RodOnGrid> rods_;
  std::vector<Loads<Spatial>> loads_;
};

}  // namespace pyrod
