// SPDX-License-Identifier: BSD-3-Clause
/// \file Supports that are moved step by step to where they hold, from where the rods are at rest.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/start/bow.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <numbers>

namespace pyrod {

/// Moves the points that supports prescribe in `x` to the fraction λ of the way from `from` to
/// where they are, and no frames.
template <class Space>
void move_points(const Layout<Space>& layout, double λ, const NetworkState<Space>& from,
                 NetworkState<Space>& x) {
  const auto& nodes = layout.network().nodes;
  for (int v = 0; v < int(nodes.size()); ++v) {
    const double unit = layout.unit_length(v);  // the length of the free directions
    const Point<Space> place = (1 - λ) * from.positions[v] + λ * nodes[v].position;
    const Point<Space> missing = place - x.positions[v];
    const auto& free = nodes[v].free;
    x.positions[v] += missing - free * (free.transpose() * missing) / (unit * unit);
  }
}

/// The same with the frames that supports prescribe.
template <class Space>
void move_supports(const Layout<Space>& layout, double λ, const NetworkState<Space>& from,
                   NetworkState<Space>& x) {
  move_points(layout, λ, from, x);
  const auto& net = layout.network();
  for (int v = 0; v < int(net.nodes.size()); ++v) {
    const auto &q = from.node_frames[v], &to = net.nodes[v].frame;
    if (net.nodes[v].turns.cols() == 0)
      x.node_frames[v] = between(q, q * principal(q.conjugate() * to), λ);
  }
  for (int rod = 0; rod < int(net.rods.size()); ++rod)
    for (const auto& a : layout.attached(rod))
      if (a.turns != 0 && net.nodes[a.node].turns.cols() == 0)
        x.node_frames[a.node] = Bow<Space>::twisted(x.node_frames[a.node] * a.relative,
                                                    2 * std::numbers::pi * λ * a.turns) *
                                a.relative.conjugate();
}

}  // namespace pyrod
