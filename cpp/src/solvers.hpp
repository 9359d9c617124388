// SPDX-License-Identifier: BSD-3-Clause
/// \file The solvers that the bindings call. They are compiled once, in the sources named like this
/// one: a network takes a compiler most of a minute.
#pragma once

#include <pyrod/statics/cantilever_levels.hpp>
#include <pyrod/statics/network_levels.hpp>

namespace pyrod {

/// One level of a climb, whatever the scene is.
using Level =
    std::function<SceneSolution(int level, bool from_below, const std::optional<NetworkStart>&,
                                const Options&, const NetworkOptions&, const Trace&)>;
using LoadedLevel = std::function<LoadedRod(int level)>;
using PlacedLevel = std::function<PlacedNetwork(int level)>;

template <class Space, class Model>
Level cantilever_level(const LoadedLevel& loaded, const Placement<Spatial>& clamp) {
  auto levels = std::make_shared<CantileverLevels<Space, Model>>(loaded, clamp);
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

#define PYROD_NETWORK_SOLVERS(prefix, Space)                                                       \
  prefix template Level network_level<Space>(const PlacedLevel&);                                  \
  prefix template NetworkRun<Space> run<Space>(const Network<Spatial>&, const Placement<Spatial>&, \
                                               const std::optional<NetworkStart>&, const Options&, \
                                               const NetworkOptions&, const Trace&);

#define PYROD_CANTILEVER_SOLVERS(prefix, Space, Model)                             \
  prefix template Level cantilever_level<Space, Model>(const LoadedLevel&,         \
                                                       const Placement<Spatial>&); \
  prefix template Solution<Spatial> solve<Space, Model>(                           \
      const Rod<Spatial>&, const Placement<Spatial>&, const Loads<Spatial>&,       \
      const std::vector<Quaternion>&, const Options&, const Trace&);

PYROD_NETWORK_SOLVERS(extern, Planar)
PYROD_NETWORK_SOLVERS(extern, Spatial)
PYROD_CANTILEVER_SOLVERS(extern, Planar, Cosserat)
PYROD_CANTILEVER_SOLVERS(extern, Planar, ExtensibleKirchhoff)
PYROD_CANTILEVER_SOLVERS(extern, Planar, InextensibleKirchhoff)
PYROD_CANTILEVER_SOLVERS(extern, Spatial, Cosserat)
PYROD_CANTILEVER_SOLVERS(extern, Spatial, ExtensibleKirchhoff)
PYROD_CANTILEVER_SOLVERS(extern, Spatial, InextensibleKirchhoff)

}  // namespace pyrod
