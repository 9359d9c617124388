// SPDX-License-Identifier: BSD-3-Clause
/// \file Errors in units of the last place.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

namespace pyrod::test {

/// Error of `got` in units of the last place of `exact`.
inline double ulps(double got, long double exact) {
  const double size = std::abs(double(exact));
  const double ulp = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return double(std::abs(static_cast<long double>(got) - exact) / ulp);
}

struct Worst {
  double ulps = 0, at = 0;
};

/// Where in `samples` f is farthest from `exact`, both functions of one number. NaN is worst.
template <class F, class Exact>
Worst worst(const std::vector<double>& samples, const F& f, const Exact& exact) {
  Worst found;
  for (const double θ : samples) {
    const double error = ulps(f(θ), exact(static_cast<long double>(θ)));
    if (!(error <= found.ulps)) found = {error, θ};
    if (std::isnan(error)) break;
  }
  return found;
}

/// Zero, tiny numbers, powers, an even sampling up to `end`, and both sides of each of `branches`.
inline std::vector<double> angles(double end, const std::vector<double>& branches = {}) {
  std::vector<double> out{0, 1e-310, 1e-300, 1e-160, 1e-154};
  for (double θ = 1e-20; θ < end; θ *= 1.05) out.push_back(θ);
  for (int i = 1; i < 20000; ++i) out.push_back(end * i / 20000);
  for (const double b : branches) {
    for (double gap = 1e-16; gap < 0.1; gap *= 1.3) {
      out.push_back(b * (1 - gap));
      out.push_back(b * (1 + gap));
    }
    for (double up = b, down = b, i = 0; i < 100; ++i) {
      out.push_back(up = std::nextafter(up, 100.));
      out.push_back(down = std::nextafter(down, 0.));
    }
  }
  return out;
}

}  // namespace pyrod::test
