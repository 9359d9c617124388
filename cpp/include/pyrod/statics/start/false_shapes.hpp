// SPDX-License-Identifier: BSD-3-Clause
/// \file Shapes at which Newton's method comes to rest, and which mean nothing.
#pragma once

#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// Takes out loops that lie in one cell: a shape whose neighbouring edges turn by more than half a
/// turn means nothing, unless it was given. Whether there were any.
template <class Space>
bool untie(const Layout<Space>& layout, NetworkState<Space>& x) {
  bool found = false;
  for (int rod = 0; rod < int(layout.network().rods.size()); ++rod)
    for (int j = 1; j < layout.network().rods[rod].edges(); ++j) {
      const auto& before = x.frames[layout.edge(rod, j - 1)];
      auto& frame = x.frames[layout.edge(rod, j)];
      const auto W = before.conjugate() * frame;
      if (is_principal(W)) continue;
      frame = before * principal(W);
      found = true;
    }
  return found;
}

/// Whether a span that cannot stretch is as long as its ends, which are held, are apart, and no
/// force was found in it, or one beyond all that acts.
template <class Space>
bool cannot_hold(const Layout<Space>& layout, const NetworkState<Space>& x, bool converged) {
  const auto& net = layout.network();
  double load = 0;
  for (const auto& node : net.nodes) load += node.force.norm();
  for (const auto& loads : net.loads)
    for (const auto& F : loads.force) load += F.norm();
  for (int p = 0; p < int(layout.spans().size()); ++p) {
    const auto& span = layout.spans()[p];
    const double most = 1e4 * (load + layout.unit_force(p));
    if (converged && !(x.forces[p].norm() > most)) continue;
    const auto &a = net.nodes[span.start], &b = net.nodes[span.end];
    if (a.free.cols() > 0 || b.free.cols() > 0) continue;
    const auto& rod = net.rods[span.rod];
    double length = 0, give = 0;
    for (int j = span.first; j < span.last; ++j)
      length += rod.grid.h(j), give += 1 / rod.stretching[j][Space::dim - 1];
    if (give == 0 && (b.position - a.position).norm() > length * (1 - 1e-9)) return true;
  }
  return false;
}

}  // namespace pyrod
