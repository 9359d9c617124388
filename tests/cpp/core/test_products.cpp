// SPDX-License-Identifier: BSD-3-Clause
// The exact values are products of whole numbers: those of two doubles fit into 128 bits.
#include <pyrod/core/products.hpp>

#include "support/random.hpp"
#include "support/ulp.hpp"

#include <doctest/doctest.h>

#include <cstdint>

using namespace pyrod;
using namespace pyrod::test;

namespace {

__extension__ typedef __int128 Wide;
using Whole = std::int64_t;

long double exact(Whole a, Whole b, Whole c, Whole d) {
  return static_cast<long double>(Wide(a) * b - Wide(c) * d);
}

/// A whole number with all 53 bits of a double, also after a small step.
Whole whole(Random& random) { return Whole(std::ldexp(random.number(0.52, 0.98), 53)); }

/// Up to `size`, of either sign.
Whole step(Random& random, double size) { return Whole(random.number(-size, size)); }

double error(Whole a, Whole b, Whole c, Whole d) {
  return ulps(difference_of_products(double(a), double(b), double(c), double(d)),
              exact(a, b, c, d));
}

}  // namespace

TEST_CASE("a b - c d has no more than 1.5 ulp of error, however much cancels") {
  Random random(1);
  double worst = 0;
  for (double size = 1; size < 1e14; size *= 30)
    for (int i = 0; i < 20000; ++i) {
      const Whole a = whole(random), b = whole(random);
      // c d differs from a b in its last digits only: for size 1 nearly all of them cancel
      worst = std::max(worst, error(a, b, a + step(random, size), b + step(random, size)));
      worst = std::max(worst, error(a, b, b - step(random, size), a));
      worst = std::max(worst, error(a, b, -whole(random), whole(random)));
    }
  CHECK(worst <= 1.5);
  CHECK(worst > 1);  // the bound is sharp enough to be worth a test
}

TEST_CASE("equal products differ by nothing") {
  Random random(2);
  for (int i = 0; i < 1000; ++i) {
    const double a = random.number(), b = random.number();
    CHECK(difference_of_products(a, b, a, b) == 0);
    CHECK(difference_of_products(a, b, b, a) == 0);
    CHECK(difference_of_products(a, b, -a, b) == 2 * (a * b));
  }
}

TEST_CASE("what two roundings leave of a product is found") {
  const double ε = 0x1p-52;
  CHECK(difference_of_products(1 + ε, 1 - ε, 1, 1) == -ε * ε);
  CHECK(difference_of_products(1, 1, 1 + ε, 1 - ε) == ε * ε);
}

TEST_CASE("the cross product of nearly parallel vectors keeps its digits") {
  Random random(3);
  double worst = 0;
  for (double size = 1; size < 1e14; size *= 30)
    for (int i = 0; i < 5000; ++i) {
      const Whole a[] = {whole(random), -whole(random), whole(random)};
      Whole b[3];
      for (int k = 0; k < 3; ++k) b[k] = a[k] + step(random, size);
      const Vec3 c = accurate_cross(Vec3(double(a[0]), double(a[1]), double(a[2])),
                                    Vec3(double(b[0]), double(b[1]), double(b[2])));
      for (int k = 0; k < 3; ++k) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        worst = std::max(worst, ulps(c[k], exact(a[l], b[m], a[m], b[l])));
      }
    }
  CHECK(worst <= 1.5);
}

TEST_CASE("the cross product is right-handed, and zero for parallel vectors") {
  CHECK(accurate_cross(Vec3::UnitX(), Vec3::UnitY()) == Vec3::UnitZ());
  CHECK(accurate_cross(Vec3::UnitY(), Vec3::UnitZ()) == Vec3::UnitX());
  CHECK(accurate_cross(Vec3::UnitZ(), Vec3::UnitX()) == Vec3::UnitY());
  Random random(4);
  const Vec3 a = random.vector<3>();
  CHECK(accurate_cross(a, -4 * a) == Vec3::Zero());
}
