// SPDX-License-Identifier: BSD-3-Clause
/// \file The instances of the solvers that pyrod::compiled has.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/ladder/climb.hpp>
#include <pyrod/statics/ladder/ladder.hpp>
#include <pyrod/statics/ladder/levels.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/recovery.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/clamped_start.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/start/start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <optional>
#include <span>

namespace pyrod {

#define PYROD_SOLVERS(prefix, Space)                                                            \
  prefix template class Layout<Space>;                                                          \
  prefix template class NetworkProblem<Space>;                                                  \
  prefix template class Start<Space>;                                                           \
  prefix template class ClampedStart<Space>;                                                    \
  prefix template class Newton<NetworkProblem<Space>>;                                          \
  prefix template class Recovery<Space>;                                                        \
  prefix template class Posed<Space>;                                                           \
  prefix template Found<Space> find<Space>(const Posed<Space>&,                                 \
                                           const std::optional<NetworkStart>&, const Options&,  \
                                           const NetworkOptions&, const Trace&);                \
  prefix template Found<Space> find_near<Space>(const Posed<Space>&, NetworkState<Space>,       \
                                                const Options&, const NetworkOptions&,          \
                                                const Trace&);                                  \
  prefix template Solution<Space> told<Space>(const Posed<Space>&, const Found<Space>&, int,    \
                                              bool);                                            \
  prefix template Climbed climb<Space>(const PosedLevel<Space>&, std::span<const Rod<Spatial>>, \
                                       bool, const std::optional<NetworkStart>&,                \
                                       const ClimbSettings&);

PYROD_SOLVERS(extern, Planar)
PYROD_SOLVERS(extern, Spatial)

}  // namespace pyrod
