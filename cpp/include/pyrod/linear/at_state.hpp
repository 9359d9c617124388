// SPDX-License-Identifier: BSD-3-Clause
/// \file A state of a network to linearise about, with the numbers of all that may change.
#pragma once

#include <pyrod/linear/items.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// Layout and state must stay where they are.
template <class Space>
struct AtState {
  const Layout<Space>& layout;
  const Network<Space>& net;
  const NetworkState<Space>& x;
  NetworkLoads<Space> loads;
  StateItems<Space> state;
  NumberItems<Space> numbers;
  ToldItems<Space> told;
  AttachmentNumbers<Space> attached;

  AtState(const Layout<Space>& of, const NetworkState<Space>& at)
      : layout(of),
        net(of.network()),
        x(at),
        loads(of),
        state(of),
        numbers(of),
        told(of),
        attached(of) {}
};

}  // namespace pyrod
