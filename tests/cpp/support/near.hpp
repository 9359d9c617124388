// SPDX-License-Identifier: BSD-3-Clause
/// \file Distances between what tests compare, and refusals.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rotation/space.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <vector>

namespace pyrod::test {

template <class A, class B>
double distance(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  return (a - b).norm();
}
inline double distance(double a, double b) { return std::abs(a - b); }
inline double distance(Angle a, Angle b) { return std::abs(a.radians - b.radians); }
/// A quaternion and its negative are far apart.
inline double distance(const Quaternion& a, const Quaternion& b) {
  return (a.coeffs() - b.coeffs()).norm();
}

/// The largest distance between items with the same number.
template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = distance(a[i], b[i]);
    if (!(d <= largest)) largest = d;  // NaN as well
  }
  return largest;
}

/// Runs `action`, which must be refused, and returns the message.
template <class Action>
std::string refusal(const Action& action) {
  try {
    action();
  } catch (const InvalidArgument& e) {
    return e.what();
  }
  return "(not refused)";
}

}  // namespace pyrod::test

/// `action` is refused with a message that begins with `beginning`.
#define CHECK_REFUSED(beginning, ...) \
  CHECK(::pyrod::test::refusal([&] {  \
          (void)(__VA_ARGS__);        \
        }).substr(0, std::string(beginning).size()) == beginning)
