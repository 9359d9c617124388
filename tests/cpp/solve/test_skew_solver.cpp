// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/skew_solver.hpp>
#include <pyrod/sparse/ldlt.hpp>

#include "support/matrices.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Solves (H + Z) x = b as the solver does; counts the products with Z.
Vector corrected(const Dense& H, const Dense& Z, const Vector& b, int& products) {
  const SymmetricMatrix A = sparse(H);
  Ldlt factor(A);
  factor.factorise();
  Vector x;
  factor.solve(b, x);
  SkewCorrected([&](const Vector& right, Vector& out) { factor.solve(right, out); },
                [&](const Vector& v, Vector& w) {
                  ++products;
                  w = Z * v;
                },
                b.size())
      .correct(x);
  return x;
}

}  // namespace

TEST_CASE("a full skew part, against a dense solve") {
  Random random(1);
  for (const int size : {1, 2, 5, 30}) {
    const Dense H = random_positive(random, size);
    const Dense Z = 3 * random_skew(random, size);
    const Vector b = random.vector(size), expected = solve_dense(H + Z, b);
    int products = 0;
    CHECK(distance(corrected(H, Z, b, products), expected) < 1e-11 * expected.norm());
  }
}

TEST_CASE("one moment is a skew part of rank two: a handful of products, for any size") {
  Random random(2);
  for (const int size : {6, 60, 200}) {
    const Dense H = random_positive(random, size);
    Dense Z = Dense::Zero(size, size);
    Z.block<3, 3>(size - 3, size - 3) = skew(Vec3(3, -4, 5));
    const Vector b = random.vector(size), expected = solve_dense(H + Z, b);
    int products = 0;
    CHECK(distance(corrected(H, Z, b, products), expected) < 1e-11 * expected.norm());
    CHECK(products <= 5);
  }
}

TEST_CASE("without a skew part nothing changes") {
  Random random(3);
  const Dense H = random_positive(random, 6);
  const Vector b = random.vector(6), expected = solve_dense(H, b);
  int products = 0;
  CHECK(distance(corrected(H, Dense::Zero(6, 6), b, products), expected) < 1e-14);
}

TEST_CASE("an indefinite symmetric part") {
  Random random(4);
  const Dense H = Vec<4>(1, -2, 3, -0.5).asDiagonal();
  const Dense Z = random_skew(random, 4);
  const Vector b = random.vector(4), expected = solve_dense(H + Z, b);
  int products = 0;
  CHECK(distance(corrected(H, Z, b, products), expected) < 1e-12 * expected.norm());
}
