// SPDX-License-Identifier: BSD-3-Clause
/// \file A ladder that may be climbed again and again.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/ladder.hpp>
#include <pyrod/statics/solution/reached.hpp>
#include <pyrod/statics/solution/scene_solution.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// One level of a climb, whatever the scene is.
using Level =
    std::function<SceneSolution(int level, bool from_below, const std::optional<NetworkStart>&,
                                const Options&, const NetworkOptions&, const Trace&)>;

/// A scene whose levels are made once, when a climb first needs them. One climb at a time: others
/// wait.
class ReadyLadder {
 public:
  /// `rods`: on level 0; `corners`: see `LadderScene`.
  ReadyLadder(std::vector<Rod<Spatial>> rods, Level level, bool corners)
      : rods_(std::move(rods)), level_(std::move(level)), corners_(corners) {}

  Climbed climb(const std::optional<NetworkStart>& start, Options options,
                const NetworkOptions& more, double tolerance, const Trace& trace,
                const std::function<void(const SoFar&)>& progress = {}) {
    const std::lock_guard lock(busy_);
    const auto solve = [&](int level, bool from_below, double step) {
      options.tolerance = step;
      return level_(level, from_below, start, options, more, trace);
    };
    Time began = now(), before = began;
    const auto has_time = [&](const SoFar& reached) {
      if (progress) progress(reached);
      const Time last = std::exchange(before, now());
      return 2 * before - last - began <= options.max_time;
    };
    return Ladder({rods_, solve, has_time, corners_}, tolerance, options.max_edges).climb();
  }

 private:
  using Time = double;  ///< [s]
  static Time now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<Time>(since).count();
  }

  std::vector<Rod<Spatial>> rods_;
  Level level_;
  bool corners_;
  std::mutex busy_;
};

}  // namespace pyrod
