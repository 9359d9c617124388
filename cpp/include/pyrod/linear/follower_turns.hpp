// SPDX-License-Identifier: BSD-3-Clause
/// \file What turns of frames change of the forces that follow them.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// Forces on vertices, numbers ← turns of edges, state.
template <class Space>
ItemMap<Space> follower_turns(const Layout<Space>& layout, const NetworkState<Space>& x) {
  const StateItems<Space> state(layout);
  const NumberItems<Space> numbers(layout);
  ItemMap<Space> out;
  for (int rod = 0; rod < int(layout.network().rods.size()); ++rod)
    for (const auto& f : layout.network().loads[rod].follower_forces) {
      const int e = layout.edge(rod, f.edge);
      const Mat<Space::dim, Space::spin> F = -matrix(x.frames[e]) * skew(f.force);
      out.add(numbers.force(rod, f.vertex), state.turn(e), F);
    }
  return out;
}

}  // namespace pyrod
