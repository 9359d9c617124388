// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/sparse/ldlt.hpp>

#include "support/failing_memory.hpp"
#include "support/matrices.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

TEST_CASE("solve, against a dense solve") {
  Random random(1);
  for (const int blocks : {1, 2, 40}) {
    auto A = random_chain<3>(random, blocks);
    Ldlt factor(A);
    for (const double shift : {10., 0.}) {
      factor.factorise(shift);
      const Dense D = dense(A) + shift * Dense::Identity(A.size(), A.size());
      const Vector b = random.vector(A.size()), expected = solve_dense(D, b);
      Vector x;
      factor.solve(b, x);
      const double tolerance = shift > 0 ? 1e-14 : 1e-10;  // not pivoted
      CHECK(distance(x, expected) < tolerance * expected.norm());
      x = b;
      factor.solve(x, x);
      CHECK(distance(x, expected) < tolerance * expected.norm());
    }
  }
}

TEST_CASE("a chain's factor has no fill") {
  Random random(2);
  for (const int blocks : {1, 2, 50}) {
    const auto A = random_chain<3>(random, blocks);
    CHECK(Ldlt(A).factor_entries() == A.values.size());
    const auto B = random_chain<1>(random, blocks);
    CHECK(Ldlt(B).factor_entries() == B.values.size());
  }
}

TEST_CASE("the numbering is kept: a first unknown that couples to all others fills the factor") {
  SymmetricMatrix arrow;
  for (int k = 0; k < 10; ++k) {
    arrow.rows.push_back(0);
    if (k > 0) arrow.rows.push_back(k);
    arrow.starts.push_back(int(arrow.rows.size()));
  }
  arrow.values.assign(arrow.rows.size(), 1);
  CHECK(Ldlt(arrow).factor_entries() == 55);
}

TEST_CASE("the inertia is that of the eigenvalues, with and without a shift") {
  Random random(3);
  int indefinite = 0;
  for (int i = 0; i < 100; ++i) {
    const Dense D = random_symmetric(random, 2 + i % 9);
    const SymmetricMatrix A = sparse(D);
    Ldlt factor(A);
    for (const double shift : {0., 0.7, -0.7, 100.}) {
      const Inertia inertia = factor.factorise(shift);
      const int negative = negative_eigenvalues(D + shift * Dense::Identity(D.rows(), D.cols()));
      CHECK(inertia.negative == negative);
      CHECK(inertia.broken == 0);
      if (negative > 0 && negative < D.rows()) ++indefinite;
    }
  }
  CHECK(indefinite > 100);
}

TEST_CASE("what is added to the diagonal is factorised, and the matrix is left as it was") {
  Random random(8);
  for (int i = 0; i < 30; ++i) {
    const int size = 1 + i % 10;
    const Dense D = random_symmetric(random, size);
    SymmetricMatrix A = sparse(D);
    const auto values = A.values;
    Ldlt factor(A);
    const Vector added = 8 * random.vector(size);
    const Dense expected = D + Dense(added.asDiagonal());
    const Inertia inertia = factor.factorise(A, added);
    CHECK(inertia.negative == negative_eigenvalues(expected));
    CHECK(inertia.broken == 0);
    CHECK(A.values == values);  // to the bit
    const Vector b = random.vector(size), x_expected = solve_dense(expected, b);
    Vector x;
    factor.solve(b, x);
    CHECK(distance(x, x_expected) < 1e-11 * x_expected.norm());  // not pivoted
    CHECK(factor.factorise(A, Vector::Zero(size)).negative == negative_eigenvalues(D));
    CHECK(factor.factorise(A, Vector(-D.diagonal())).broken > 0);  // the first pivot is zero
    CHECK(A.values == values);
  }
}

TEST_CASE("changed values are seen by the next factorisation, not before") {
  Random random(4);
  auto A = random_chain<3>(random, 5);
  Ldlt factor(A);
  const Vector b = random.vector(A.size());
  factor.factorise(10);
  const Dense first = dense(A);
  for (auto& value : A.values) value = random.number();
  const auto shifted = [&](const Dense& D) { return (D + 10 * Dense::Identity(15, 15)).eval(); };
  Vector x;
  factor.solve(b, x);
  CHECK(distance(x, solve_dense(shifted(first), b)) < 1e-14);
  factor.factorise(10);
  factor.solve(b, x);
  CHECK(distance(x, solve_dense(shifted(dense(A)), b)) < 1e-14);
}

TEST_CASE("pivots that are zero or not finite are reported") {
  SymmetricMatrix A = sparse(Vec3(2, -1, 3).asDiagonal().toDenseMatrix());
  Ldlt factor(A);
  Inertia inertia = factor.factorise();
  CHECK(inertia.negative == 1);
  CHECK(inertia.broken == 0);

  A = sparse(Vec3(2, 0, 3).asDiagonal().toDenseMatrix());
  CHECK(factor.factorise().broken > 0);
  inertia = factor.factorise(1);  // the object survives
  CHECK(inertia.broken == 0);
  CHECK(inertia.negative == 0);

  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    A = sparse(Vec3(2, 1, 3).asDiagonal().toDenseMatrix());
    A.values[2] = wrong;
    CHECK(factor.factorise().broken > 0);
    A = sparse(Vec3(2, 1, 3).asDiagonal().toDenseMatrix());
    CHECK(factor.factorise().broken == 0);
  }
}

TEST_CASE("the condition estimate is the ratio of the pivots") {
  const SymmetricMatrix A = sparse(Vec3(2, 8, 4).asDiagonal().toDenseMatrix());
  Ldlt factor(A);
  factor.factorise();
  CHECK(factor.reciprocal_condition() == doctest::Approx(0.25));
}

TEST_CASE("two objects do not know of each other") {
  Random random(5);
  const auto A = random_chain<3>(random, 4), B = random_chain<3>(random, 7);
  Ldlt a(A), b(B);
  a.factorise(10);
  b.factorise(20);
  const Vector u = random.vector(A.size()), v = random.vector(B.size());
  Vector x, y;
  b.solve(v, y);
  a.solve(u, x);
  CHECK(distance(x, solve_dense(dense(A) + 10 * Dense::Identity(12, 12), u)) < 1e-14);
  CHECK(distance(y, solve_dense(dense(B) + 20 * Dense::Identity(21, 21), v)) < 1e-14);
}

TEST_CASE("when memory runs out, at any point, there is an exception and nothing else") {
  Random random(6);
  const auto A = random_chain<3>(random, 50);
  const Vector b = random.vector(A.size());
  const auto run = [&] {
    Ldlt factor(A);
    factor.factorise(10);
    Vector x;
    factor.solve(b, x);
  };
  int needed = 0;
  {
    const FailingMemory all;
    run();
    needed = all.used();
  }
  REQUIRE(needed > 5);
  int failures = 0;
  for (int allowed = 0; allowed < needed; ++allowed) {
    const FailingMemory some(allowed);
    try {
      run();
    } catch (const std::bad_alloc&) {
      ++failures;
    }
  }
  CHECK(failures == needed);
  CHECK_NOTHROW(run());
}

TEST_CASE("a factor survives a shortage of memory") {
  Random random(7);
  const auto A = random_chain<3>(random, 50);
  Ldlt factor(A);
  {
    const FailingMemory none(0);
    CHECK_THROWS_AS(factor.factorise(10), std::bad_alloc);
  }
  factor.factorise(10);
  const Vector b = random.vector(A.size());
  Vector x;
  {
    const FailingMemory none(0);
    CHECK_THROWS_AS(factor.solve(b, x), std::bad_alloc);
  }
  factor.solve(b, x);
  CHECK(distance(x, solve_dense(dense(A) + 10 * Dense::Identity(150, 150), b)) < 1e-13);
}
