// SPDX-License-Identifier: BSD-3-Clause
#include "support/difference.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pyrod::test {

void check_derivative(const std::function<Vector(double)>& f, const Vector& derivative, double h,
                      double tolerance) {
  constexpr int levels = 5;
  std::array<Vector, levels> difference;
  std::array<double, levels> error;
  const double scale = std::max({derivative.norm(), f(0).norm(), 1e-3});
  for (int k = 0; k < levels; ++k, h /= 2) {
    difference[k] = (f(h) - f(-h)) / (2 * h);
    error[k] = (difference[k] - derivative).norm();
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
  CHECK((difference[levels - 1] - derivative).norm() <= tolerance * scale);
}

void check_slope(const std::function<double(double)>& f, double derivative, double h,
                 double tolerance) {
  check_derivative([&](double t) { return Vector::Constant(1, f(t)); },
                   Vector::Constant(1, derivative), h, tolerance);
}

}  // namespace pyrod::test
