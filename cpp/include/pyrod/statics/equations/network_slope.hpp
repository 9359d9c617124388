// SPDX-License-Identifier: BSD-3-Clause
/// \file What loads that grow add to the gradient of a network, at fixed unknowns.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/force_change.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// out = ∂g/∂t at x for the loads `now` + t `rate`.
template <class Space>
void find_slope(const Layout<Space>& layout, const EdgeColumns<Space>& columns,
                const NetworkLoads<Space>& now, const NetworkLoads<Space>& rate,
                const NetworkState<Space>& x, Vector& out) {
  constexpr int spin = Space::spin;
  out.setZero(layout.unknowns());
  typename NetworkLoads<Space>::Acting here, more;
  ForceChange<Space>(layout, columns).add(x, now.acting(x, here), rate.acting(x, more), out);
  for (const auto& [edge, m] : rate.edge_moments())
    out.segment<spin>(layout.frame_row(edge)) -= rotate_spin(x.frames[edge].conjugate(), m);
  for (const auto& [edge, m] : rate.follower_moments())
    out.segment<spin>(layout.frame_row(edge)) -= m;
  for (int v = 0; v < int(x.node_frames.size()); ++v) {
    const int b = layout.turn_block(v);
    if (b < 0) continue;
    const auto& T = layout.network().nodes[v].turns;
    const Spin<Space> m = rotate_spin(x.node_frames[v].conjugate(), rate.node_moments()[v]) +
                          rate.node_follower_moments()[v];
    out.segment(layout.row(b), T.cols()) -= T.transpose() * m;
  }
}

}  // namespace pyrod
