// SPDX-License-Identifier: BSD-3-Clause
/// \file Gradient and Hessian of a cell as they stand together, for differences.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/bend_twist.hpp>

namespace pyrod::test {

constexpr int twice(int spin) { return 2 * spin; }

template <class Space>
Vec<twice(Space::spin)> gradient(const TurnJet<Space>& jet) {
  Vec<twice(Space::spin)> g;
  g << jet.a, jet.b;
  return g;
}
template <class Space>
Mat<twice(Space::spin)> hessian(const TurnJet<Space>& jet) {
  Mat<twice(Space::spin)> H;
  H << jet.aa, jet.ab, jet.ab.transpose(), jet.bb;
  return H;
}

}  // namespace pyrod::test
