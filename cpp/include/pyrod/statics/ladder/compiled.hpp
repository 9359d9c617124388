// SPDX-License-Identifier: BSD-3-Clause
/// \file The solvers that the compiled library holds: a network takes a compiler most of a minute.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/level.hpp>
#include <pyrod/statics/ladder/ready_ladder.hpp>
#include <pyrod/statics/solving/cantilever.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_run.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <optional>
#include <vector>

namespace pyrod {

#define PYROD_NETWORK_SOLVERS(prefix, Space)                                                       \
  prefix template Level network_level<Space>(const PlacedLevel&);                                  \
  prefix template NetworkRun<Space> run<Space>(const Network<Spatial>&, const Placement<Spatial>&, \
                                               const std::optional<NetworkStart>&, const Options&, \
                                               const NetworkOptions&, const Trace&);

#define PYROD_CANTILEVER_SOLVERS(prefix, Space)                                                 \
  prefix template Level cantilever_level<Space>(const LoadedLevel&, const Placement<Spatial>&); \
  prefix template Solution<Spatial> solve<Space>(                                               \
      const Rod<Spatial>&, const Placement<Spatial>&, const Loads<Spatial>&,                    \
      const std::vector<Quaternion>&, const Options&, const Trace&);

PYROD_NETWORK_SOLVERS(extern, Planar)
PYROD_NETWORK_SOLVERS(extern, Spatial)
PYROD_CANTILEVER_SOLVERS(extern, Planar)
PYROD_CANTILEVER_SOLVERS(extern, Spatial)

}  // namespace pyrod
