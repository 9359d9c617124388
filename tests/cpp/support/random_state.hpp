// SPDX-License-Identifier: BSD-3-Clause
/// \file States of networks that are no equilibria.
#pragma once

#include "support/random.hpp"

#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cstddef>

namespace pyrod::test {

/// Any frames, forces and places, nothing in equilibrium.
template <class Space>
NetworkState<Space> random_state(Random& random, const Layout<Space>& layout) {
  NetworkState<Space> x;
  for (int j = 0; j < layout.edges(); ++j) x.frames.push_back(random.rotation<Space>(0.5));
  for (std::size_t v = 0; v < layout.network().nodes.size(); ++v) {
    x.node_frames.push_back(random.rotation<Space>(0.3));
    x.positions.push_back(random.vector<Space::dim>());
  }
  for (const auto& span : layout.spans())
    x.forces.push_back(span.open * random.vector(int(span.open.cols())));
  for (int i = 0; i < layout.hinges(); ++i) x.hinge_angles.push_back(random.number());
  for (const auto& one : layout.network().tendons)
    x.tensions.push_back(one.length ? random.number(1, 2) : 0);
  return x;
}

}  // namespace pyrod::test
