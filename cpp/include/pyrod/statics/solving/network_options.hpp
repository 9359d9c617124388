// SPDX-License-Identifier: BSD-3-Clause
/// \file What a solve of a network may be asked for besides `Options`.
#pragma once

namespace pyrod {

struct NetworkOptions {
  bool stable = true;       ///< look for a minimum: leave saddles along their unstable modes
  bool eigenvalue = false;  ///< find the lowest eigenvalue at the solution
  bool rounding = false;    ///< tell what rounding may do
  bool anchored = false;    ///< of equilibria of equal energy find the one nearest to the start
};

}  // namespace pyrod
