// SPDX-License-Identifier: BSD-3-Clause
/// \file Differences of products without cancellation, after Kahan (Jeannerod, Louvet and Muller,
/// Math. Comp. 82, 2013): the error is at most 1.5 ulp of the result, however small that is.
#pragma once

#include <pyrod/core/types.hpp>

#include <cmath>

namespace pyrod {

/// a b − c d.
inline double difference_of_products(double a, double b, double c, double d) {
  const double cd = c * d, error = std::fma(-c, d, cd);
  return std::fma(a, b, -cd) + error;
}

/// a × b, each component accurate even where the vectors are nearly parallel.
inline Vec3 accurate_cross(const Vec3& a, const Vec3& b) {
  return {difference_of_products(a.y(), b.z(), a.z(), b.y()),
          difference_of_products(a.z(), b.x(), a.x(), b.z()),
          difference_of_products(a.x(), b.y(), a.y(), b.x())};
}

}  // namespace pyrod
