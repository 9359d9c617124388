// SPDX-License-Identifier: BSD-3-Clause
/// \file An equilibrium in the unknowns of a network, before it is worked out what that says.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <vector>

namespace pyrod {

template <class Space>
struct Found : Course {
  NetworkState<Space> state;
  std::vector<Spin<Space>> mode;  ///< see `Solution`
};

}  // namespace pyrod
