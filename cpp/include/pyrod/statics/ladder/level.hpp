// SPDX-License-Identifier: BSD-3-Clause
/// \file One level of a climb, whatever the scene is.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/cantilever_levels.hpp>
#include <pyrod/statics/ladder/network_levels.hpp>
#include <pyrod/statics/ladder/ready_ladder.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/solve.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace pyrod {

using LoadedLevel = std::function<LoadedRod(int level)>;
using PlacedLevel = std::function<PlacedNetwork(int level)>;

template <class Space>
Level cantilever_level(const LoadedLevel& loaded, const Placement<Spatial>& clamp) {
  auto levels = std::make_shared<CantileverLevels<Space>>(loaded, clamp);
  return [levels, clamp](int level, bool from_below, const std::optional<NetworkStart>& start,
                         const Options& options, const NetworkOptions&, const Trace& trace) {
    const auto frames = start ? restricted<Space>(start->frames, clamp.frame)
                              : std::vector<typename Space::Rotation>{};
    return levels->solve(level, from_below, frames, options, trace);
  };
}

template <class Space>
Level network_level(const PlacedLevel& placed) {
  auto levels = std::make_shared<NetworkLevels<Space>>(placed);
  return [levels](int level, bool from_below, const std::optional<NetworkStart>& start,
                  const Options& options, const NetworkOptions& more, const Trace& trace) {
    return levels->solve(level, from_below, start, options, more, trace);
  };
}

}  // namespace pyrod
