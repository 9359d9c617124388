// SPDX-License-Identifier: BSD-3-Clause
/// \file Derivatives against differences, with the order that the differences must show.
#pragma once

#include <doctest/doctest.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>

namespace pyrod::test {

inline Eigen::VectorXd as_vector(double x) { return Eigen::VectorXd::Constant(1, x); }
template <class Derived>
Eigen::VectorXd as_vector(const Eigen::MatrixBase<Derived>& m) {
  return m.reshaped();
}

/// Checks `derivative` = f'(0), for numbers, vectors or matrices: the error of the central difference
/// must fall like h², and what is left without its powers h², h⁴, … must be rounding. Where f is a
/// parabola there is no error to fall.
template <class F, class D>
void check_derivative(const F& f, const D& derivative, double h = 0.05, double tolerance = 1e-10) {
  constexpr int levels = 5;
  std::array<Eigen::VectorXd, levels> difference;
  std::array<double, levels> error;
  const Eigen::VectorXd expected = as_vector(derivative);
  const double scale = std::max({expected.norm(), as_vector(f(0.)).norm(), 1e-3});
  for (int k = 0; k < levels; ++k, h /= 2) {
    difference[k] = (as_vector(f(h)) - as_vector(f(-h))) / (2 * h);
    error[k] = (difference[k] - expected).norm();
  }
  CAPTURE(error[0]);
  if (!(error[0] <= 1e-9 * scale)) {
    for (int k = 2; k + 1 < levels; ++k) {
      const double order = std::log2(error[k] / error[k + 1]);
      CHECK(order > 1.9);
      CHECK(order < 2.1);
    }
  }
  double power = 1;
  for (int m = 1; m < levels; ++m) {
    power *= 4;
    for (int k = levels - 1; k >= m; --k)
      difference[k] += (difference[k] - difference[k - 1]) / (power - 1);
  }
  CHECK((difference[levels - 1] - expected).norm() <= tolerance * scale);
}

}  // namespace pyrod::test
