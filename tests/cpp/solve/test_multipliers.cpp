// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/multipliers.hpp>

#include "support/matrices.hpp"
#include "support/near.hpp"

#include <pyrod/sparse/block_symmetric.hpp>

using namespace pyrod;
using namespace pyrod::test;

TEST_CASE("multipliers: their rows, their part of vectors, and the matrix times it") {
  Random random(1);
  BlockSymmetric K(pattern_of({2, 1, 2, 3, 1}, {{}, {0}, {0}, {1}, {2, 3}}));
  for (double& value : K.values) value = random.number();
  Vector weights = Vector::Ones(K.size());
  const std::vector<int> rows{2, 5, 6, 7};
  for (const int k : rows) weights[k] = 0;
  const Vector units = 1 + random.vector(K.size()).array().abs();
  const Multipliers multipliers(K, weights, units);
  CHECK(multipliers.count() == 4);
  CHECK(multipliers.rows() == rows);

  const Vector a = random.vector(K.size());
  Vector f = Vector::Zero(K.size()), rest = a;
  multipliers.copy(a, f);
  multipliers.set(0, rest);
  CHECK(distance(f, a.cwiseProduct(Vector::Ones(K.size()) - weights)) == 0);
  CHECK(distance(rest, a.cwiseProduct(weights)) == 0);
  CHECK(multipliers.squared_norm(a) ==
        doctest::Approx(f.cwiseProduct(f).cwiseQuotient(units).sum()).epsilon(1e-15));
  CHECK(multipliers.largest(a) == f.cwiseQuotient(units).lpNorm<Eigen::Infinity>());

  Vector out(2), expected;
  multipliers.multiply(K, f, out);
  K.multiply(f, expected);
  CHECK(distance(out, expected) == 0);
  CHECK(distance(expected, dense(K) * f) < 1e-15 * dense(K).norm());
}

TEST_CASE("no multipliers") {
  const BlockSymmetric K = chain_of(1, 3);
  const Multipliers multipliers(K, Vector::Ones(3), Vector::Ones(3));
  Vector v = Vector::Ones(3), out;
  multipliers.set(7, v);
  CHECK(v == Vector::Ones(3));
  CHECK(multipliers.count() == 0);
  CHECK(multipliers.largest(v) == 0);
  multipliers.multiply(K, Vector::Zero(3), out);
  CHECK(out == Vector::Zero(3));
}
