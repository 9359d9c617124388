// SPDX-License-Identifier: BSD-3-Clause
/// \file What changes of a network in equilibrium, as the linear response has it.
#pragma once

#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>

#include <limits>

namespace pyrod {

/// The state, see `StateItems`; what is told, see `ToldItems`; positions of the vertices, see
/// `PositionSums`.
template <class Space>
struct ResponseChange {
  using Points = Eigen::Matrix<double, Space::dim, Eigen::Dynamic>;

  Items<Space> state, told;
  Points positions;

  ResponseChange() = default;
  /// Zeros.
  explicit ResponseChange(const AtState<Space>& at)
      : state(Items<Space>::Zero(item_width<Space>, at.state.count())),
        told(Items<Space>::Zero(item_width<Space>, at.told.count())),
        positions(Points::Zero(Space::dim, at.told.vertices())) {}

  void set_nan() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    state.setConstant(nan), told.setConstant(nan), positions.setConstant(nan);
  }

  /// Calls visit(one, other) for the arrays of two changes.
  template <class A, class B, class Visit>
  static void for_both(A& a, B& b, Visit&& visit) {
    visit(a.state, b.state), visit(a.told, b.told), visit(a.positions, b.positions);
  }
};

}  // namespace pyrod
