// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene that is ready to be solved: on its grid, as a network, and on finer grids once
/// they are asked for.
#pragma once

#include <pyrod/core/sole_owner.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/scene_breaks.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/statics/solving/posed.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <tuple>
#include <utility>

namespace pyrod {

class ReadyScene {
 public:
  /// Of a scene that has vertices at its places.
  explicit ReadyScene(Scene scene, Smoothness smoothness = {})
      : grid_(std::move(scene)), network_(network_of(grid_)), smooth_(std::move(smoothness)) {}
  ReadyScene(const ReadyScene&) = delete;
  ReadyScene& operator=(const ReadyScene&) = delete;

  /// The same with other numbers; how unknowns are numbered is kept. Not while anybody uses it. If
  /// the scene is refused, nothing has changed.
  void change(Scene scene) {
    SceneOnGrids grid(std::move(scene));
    auto network = network_of(grid);
    const bool planar = grid.scene().space == Dimension::planar;
    planar ? change<Planar>(network) : change<Spatial>(network);
    planar ? std::get<Levels<Spatial>>(levels_).clear() : std::get<Levels<Planar>>(levels_).clear();
    grid_ = std::move(grid);
    network_ = std::move(network);
  }

  /// The same with other supports and loads, at the places of those before. Not while anybody uses
  /// it. If these are refused, it must not be used any more.
  void change(const Changes& changes) {
    grid_.change(changes);
    if (!changes.supports.empty()) {
      auto nodes = nodes_of(grid_);
      nodes.network.rods = std::move(network_.network.rods);
      nodes.network.loads = std::move(network_.network.loads);
      nodes.network.tendons = std::move(network_.network.tendons);
      network_ = std::move(nodes);
    }
    auto& loads = network_.network.loads;
    for (std::size_t i = 0; i < loads.size() && !changes.loads.empty(); ++i)
      loads[i] = grid_.loads(int(i));
    change<Planar>(changes), change<Spatial>(changes);
  }

  const Scene& scene() const { return grid_.scene(); }
  const SceneOnGrids& grid() const { return grid_; }
  const SceneNetwork& network() const { return network_; }
  const Smoothness& smoothness() const { return smooth_; }

  int edges() const {
    int sum = 0;
    for (const auto& rod : network_.network.rods) sum += rod.edges();
    return sum;
  }

  /// The network on a level of a climb.
  SceneNetwork network_on(int level) const {
    return level == 0 ? network_ : network_of(SceneOnGrids(scene(), level));
  }

  /// The same, posed; in the space of the scene. Those that are not large are kept.
  template <class Space>
  std::shared_ptr<const Posed<Space>> posed(int level = 0) const {
    const std::lock_guard lock(busy_);
    auto& kept = std::get<Levels<Space>>(levels_)[level];
    if (kept) return kept;
    const auto made = pose<Space>(level);
    if (level == 0 || (edges() << level) <= most_kept_) kept = made;
    return made;
  }

  /// Whether rods have corners, see `LadderScene`.
  bool corners() const {
    for (std::size_t i = 0; i < scene().rods.size(); ++i)
      if (scene().rods[i].corners &&
          std::ranges::any_of(grid_.rod(int(i)).K0, [](const Vec3& K) { return !K.isZero(0); }))
        return true;
    return false;
  }

 private:
  static constexpr int most_kept_ = 1 << 14;  ///< edges

  template <class Space>
  using Levels = std::map<int, std::shared_ptr<Posed<Space>>>;

  /// Keeps level 0, if it is this one's alone and `change` could put the change into it, and none
  /// of those that were refined from it.
  template <class Space, class Change>
  void change_coarsest(const Change& change) {
    auto& levels = std::get<Levels<Space>>(levels_);
    auto coarsest = levels.extract(0);
    levels.clear();
    if (coarsest && is_sole_owner(coarsest.mapped()) && change(*coarsest.mapped()))
      levels.insert(std::move(coarsest));
  }

  template <class Space>
  void change(const SceneNetwork& network) {
    change_coarsest<Space>([&](Posed<Space>& posed) {
      posed.change(network.network, network.plane);
      return true;
    });
  }

  template <class Space>
  void change(const Changes& changes) {
    change_coarsest<Space>([&](Posed<Space>& posed) {
      return (changes.supports.empty() || posed.move_nodes(network_.network)) &&
             (changes.loads.empty() || posed.change_loads(network_.network.loads));
    });
  }

  template <class Space>
  std::shared_ptr<Posed<Space>> pose(int level) const {
    if (level == 0) return std::make_shared<Posed<Space>>(network_.network, network_.plane);
    const auto on = network_on(level);
    return std::make_shared<Posed<Space>>(on.network, on.plane);
  }

  SceneOnGrids grid_;
  SceneNetwork network_;
  Smoothness smooth_;
  mutable std::tuple<Levels<Planar>, Levels<Spatial>> levels_;
  mutable std::mutex busy_;
};

}  // namespace pyrod
