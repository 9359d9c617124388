// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/peak.hpp>

#include <doctest/doctest.h>

#include <numbers>
#include <vector>

using namespace pyrod;

namespace {

/// The largest of f on a grid of n + 1 points in [0, 1], whose steps grow by `growth` in all.
template <class F>
double highest(const F& f, int n, double growth = 1) {
  Vector s(n + 1);
  for (int j = 0; j <= n; ++j)
    s[j] = std::expm1(std::log(growth + 1e-9) * j / n) / (growth - 1 + 1e-9);
  if (growth == 1) s = Vector::LinSpaced(n + 1, 0, 1);
  const auto values = [&](int j) { return f(s[j]); };
  return Peak(s, values, 0, n).highest();
}

}  // namespace

TEST_CASE("a maximum between points is found to seventh order") {
  const auto wave = [](double s) { return std::sin(4 * s + 0.3); };
  for (const double growth : {1., 3.}) {
    CAPTURE(growth);
    CHECK(std::abs(highest(wave, 16, growth) - 1) < 1e-6);
    CHECK(std::abs(highest(wave, 64, growth) - 1) < 1e-10);
    CHECK(std::abs(highest(wave, 256, growth) - 1) < 1e-14);
  }
}

TEST_CASE("one beside an end is found, and one at an end is the value there") {
  const auto hill = [](double s) { return -(s - 0.01) * (s - 0.01); };
  CHECK(std::abs(highest(hill, 16)) < 1e-15);
  CHECK(highest([](double s) { return s * s; }, 16) == 1);
  CHECK(highest([](double s) { return -s; }, 16) == 0);
}

TEST_CASE("of two hills that with the higher top, though a vertex of the other is higher") {
  const double at = 0.53125;  // in the middle of an edge
  const auto hills = [&](double s) {
    const double a = (s - at) / 0.1, b = (s - 0.25) / 0.1;
    return 1.01 * std::exp(-a * a) + std::exp(-b * b);
  };
  CHECK(std::abs(highest(hills, 32) - highest(hills, 4096)) < 1e-5);
  CHECK(highest(hills, 32) > 1.0099);
}

TEST_CASE("few points, and values that are all the same") {
  CHECK(highest([](double) { return 3.; }, 1) == 3);
  CHECK(highest([](double) { return 3.; }, 7) == 3);
  CHECK(std::abs(highest([](double s) { return s * (1 - s); }, 2) - 0.25) < 1e-15);
  CHECK(std::abs(highest([](double s) { return s * (1 - s); }, 3) - 0.25) < 1e-15);
}
