// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene that is ready to be solved: on its grid, as a network, and on finer grids once
/// they are asked for.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/scene_breaks.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/scene/supports.hpp>
#include <pyrod/statics/ladder/ready_ladder.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>

namespace pyrod {

/// One rod, clamped at its start and free at its end, under loads that do not follow it.
inline bool is_cantilever(const Scene& scene) {
  if (scene.rods.size() != 1 || !scene.joints.empty() || scene.supports.size() != 1) return false;
  const auto* clamp = std::get_if<Clamp>(&scene.supports[0]);
  return clamp && clamp->turns == 0 && clamp->at.rod == 0 && !scene.has_followers() &&
         clamp->at.on(Grid(scene.rods[0].edge_lengths)) == 0;
}

class ReadyScene {
 public:
  /// Of a scene that has vertices at its places.
  explicit ReadyScene(Scene scene, Smoothness smoothness = {})
      : grid_(std::move(scene)), network_(network_of(grid_)), smooth_(std::move(smoothness)) {}
  ReadyScene(const ReadyScene&) = delete;
  ReadyScene& operator=(const ReadyScene&) = delete;

  const Scene& scene() const { return grid_.scene(); }
  const SceneOnGrids& grid() const { return grid_; }
  const SceneNetwork& network() const { return network_; }
  const Smoothness& smoothness() const { return smooth_; }

  int edges() const {
    int sum = 0;
    for (const auto& rod : network_.network.rods) sum += rod.edges();
    return sum;
  }

  /// The network on a level of a climb. Those that are not large are kept.
  std::shared_ptr<const SceneNetwork> network_on(int level) const {
    if (level == 0) return {std::shared_ptr<void>(), &network_};
    const std::lock_guard lock(busy_);
    auto& kept = levels_[level];
    if (kept) return kept;
    const auto made =
        std::make_shared<const SceneNetwork>(network_of(SceneOnGrids(scene(), level)));
    if ((edges() << level) <= most_kept_) kept = made;
    return made;
  }

  /// The ladder by one of the ways to solve it; `make`: its levels, if it is not there yet.
  template <class Make>
  ReadyLadder& ladder(bool cantilever, const Make& make) const {
    const std::lock_guard lock(busy_);
    auto& ladder = ladders_[cantilever];
    if (!ladder) ladder = std::make_unique<ReadyLadder>(network_.network.rods, make(), corners());
    return *ladder;
  }

 private:
  static constexpr int most_kept_ = 1 << 14;  ///< edges

  bool corners() const {
    for (std::size_t i = 0; i < scene().rods.size(); ++i)
      if (scene().rods[i].corners &&
          std::ranges::any_of(grid_.rod(int(i)).K0, [](const Vec3& K) { return !K.isZero(0); }))
        return true;
    return false;
  }

  SceneOnGrids grid_;
  SceneNetwork network_;
  Smoothness smooth_;
  mutable std::map<int, std::shared_ptr<const SceneNetwork>> levels_;
  mutable std::array<std::unique_ptr<ReadyLadder>, 2> ladders_;
  mutable std::mutex busy_;
};

}  // namespace pyrod
