// SPDX-License-Identifier: BSD-3-Clause
/// \file A ladder that may be climbed again and again.
#pragma once

#include <pyrod/statics/level.hpp>

#include <chrono>
#include <mutex>
#include <utility>

namespace pyrod {

/// A scene whose levels are made once, when a climb first needs them. One climb at a time: others
/// wait.
class ReadyLadder {
 public:
  /// `rods`: on level 0; `corners`: see `LadderScene`.
  ReadyLadder(std::vector<Rod<Spatial>> rods, Level level, bool corners)
      : rods_(std::move(rods)), level_(std::move(level)), corners_(corners) {}

  /// Of all rods, on level 0.
  int edges() const {
    int sum = 0;
    for (const auto& rod : rods_) sum += rod.edges();
    return sum;
  }

  Climbed climb(const std::optional<NetworkStart>& start, Options options,
                const NetworkOptions& more, double tolerance, const Trace& trace) {
    const std::lock_guard lock(busy_);
    const auto solve = [&](int level, bool from_below, double step) {
      options.tolerance = step;
      return level_(level, from_below, start, options, more, trace);
    };
    Time began = now(), before = began;
    const auto has_time = [&](const SoFar& reached) {
      so_far_ = reached;
      const Time last = std::exchange(before, now());
      return 2 * before - last - began <= options.max_time;
    };
    so_far_ = {};
    return Ladder({rods_, solve, has_time, corners_}, tolerance, options.max_edges).climb();
  }

  /// Of the climb that runs; ask in its thread.
  const SoFar& so_far() const { return so_far_; }

 private:
  using Time = double;  ///< [s]
  static Time now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<Time>(since).count();
  }

  std::vector<Rod<Spatial>> rods_;
  Level level_;
  bool corners_;
  SoFar so_far_;
  std::mutex busy_;
};

}  // namespace pyrod
