// SPDX-License-Identifier: BSD-3-Clause
/// \file A network solved to a tolerance.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/ladder.hpp>
#include <pyrod/statics/ladder/levels.hpp>
#include <pyrod/statics/solution/reached.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <utility>

namespace pyrod {

/// What is climbed for, and how.
struct ClimbSettings {
  double tolerance;
  Options options = {};
  NetworkOptions more = {};
  Trace trace = {};
  std::function<void(const SoFar&)> progress = {};
};

namespace detail {

/// Whether another grid would end in time, if it took as long as the last.
class Clock {
 public:
  explicit Clock(double most) : most_(most) {}

  bool has_time() {
    const Time last = std::exchange(before_, now());
    return 2 * before_ - last - began_ <= most_;
  }

 private:
  using Time = double;  ///< [s]
  static Time now() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<Time>(since).count();
  }

  double most_;
  Time began_ = now(), before_ = began_;
};

}  // namespace detail

/// `rods`: on level 0; `corners`: see `LadderScene`.
template <class Space>
Climbed climb(const PosedLevel<Space>& source, std::span<const Rod<Spatial>> rods, bool corners,
              const std::optional<NetworkStart>& start, const ClimbSettings& settings) {
  Levels<Space> levels(source);
  Options options = settings.options;
  const auto solve = [&](int level, bool from_below, double step) {
    options.tolerance = step;
    return levels.solve(level, from_below, start, options, settings.more, settings.trace);
  };
  detail::Clock clock(options.max_time);
  const auto has_time = [&](const SoFar& reached) {
    if (settings.progress) settings.progress(reached);
    return clock.has_time();
  };
  return Ladder({rods, solve, has_time, corners}, settings.tolerance, options.max_edges).climb();
}

}  // namespace pyrod
