// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/shifted_factor.hpp>

#include "support/constrained_problem.hpp"
#include "support/near.hpp"

#include <Eigen/Cholesky>
#include <Eigen/QR>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double always = 1e-6;  // share of the stiffness that is added in any case

/// A saddle of six rows and two multipliers, to each of which C A⁻¹ Cᵀ = `give` 1 gives way.
struct Saddle {
  explicit Saddle(Random& random, double give = 1e-8) : unit(std::sqrt(give)) {
    const Dense A = random_positive(random, primal);
    const Dense Q = random_dense(random, primal).householderQr().householderQ();
    const Dense C = unit * Q.topRows(2) * Dense(A.llt().matrixU());
    const auto program = quadratic_program(A, random.vector(primal), C, random.vector(2));
    K = sparse(program.matrix(Vector::Zero(primal), Vector::Zero(2)));
    stiffness = program.stiffness();
    softness = Vector::Zero(K.size());
  }
  Dense kept() const {  // what always stays beside K
    return dense(K) + always * Dense(stiffness.asDiagonal());
  }
  /// (kept + Z) x = b, with multipliers in a unit in which the dense solver finds them exactly.
  Vector solution(const Vector& b, const Dense& Z = Dense::Zero(8, 8)) const {
    Vector scale = Vector::Ones(8);
    scale.tail(2).setConstant(1 / unit);
    const Dense scaled = scale.asDiagonal() * (kept() + Z) * scale.asDiagonal();
    return scale.cwiseProduct(solve_dense(scaled, scale.cwiseProduct(b)));
  }
  ShiftedFactor factor() { return {K, stiffness, Vector::Ones(K.size()), always}; }

  static constexpr int primal = 6;
  double unit;
  SymmetricMatrix K;
  Vector stiffness, softness;
};

/// The larger of the errors of the primal part and of the multipliers, relative.
double error(const Vector& x, const Vector& expected) {
  const auto part = [&](int first, int count) {
    return distance(x.segment(first, count), expected.segment(first, count)) /
           expected.segment(first, count).norm();
  };
  return std::max(part(0, Saddle::primal), part(Saddle::primal, 2));
}

}  // namespace

TEST_CASE("corrected solutions know nothing of the multipliers' shift, whatever its size") {
  Random random(1);
  // shares of what the constraints give by themselves: refinement is fast, slow, hopeless
  for (const double share : {1e-6, 1e-2, 0.1, 0.3, 0.4, 0.45, 1., 10., 1e3}) {
    CAPTURE(share);
    Saddle saddle(random);
    saddle.softness.tail(2).setConstant(share * 1e-8);
    auto factor = saddle.factor();
    factor.renew(saddle.softness, Vector::Ones(8));
    factor.factorise(0);
    REQUIRE_FALSE(factor.broken());
    CHECK(factor.index() == 0);
    const Vector b = random.vector(8), expected = saddle.solution(b);
    Vector x;
    factor.solve(b, x);
    CHECK(error(x, expected) > 1e-3 * std::min(share, 1.));
    factor.correct(b, x);
    CHECK(distance(x, expected) < 1e-12 * expected.norm());
    CHECK(error(x, expected) < 1e-11);  // GMRES looks at all rows together
  }
}

TEST_CASE("without softness there is nothing to correct") {
  Random random(2);
  Saddle saddle(random);
  auto factor = saddle.factor();
  factor.factorise(0);
  const Vector b = random.vector(8);
  Vector x;
  factor.solve(b, x);
  const Vector plain = x;
  CHECK(error(x, saddle.solution(b)) < 1e-12);
  factor.correct(b, x);
  CHECK(error(x, plain) < 1e-13);
}

TEST_CASE("what the shift leaves of a multiplier's row, over the multiplier's size") {
  Random random(3);
  Saddle saddle(random);
  saddle.softness.tail(2) << 3e-9, 4e-9;
  Vector sizes = Vector::Ones(8);
  sizes[7] = 100;
  auto factor = saddle.factor();
  factor.renew(saddle.softness, sizes);
  factor.factorise(0);
  const Vector b = random.vector(8);
  Vector x, Kx;
  factor.solve(b, x);
  saddle.K.multiply(x, Kx);
  for (const int k : {6, 7}) {
    CHECK(factor.left(x, k) == doctest::Approx(b[k] - Kx[k]).epsilon(1e-6));
    CHECK(factor.left(x, k) ==
          doctest::Approx(-saddle.softness[k] / sizes[k] * x[k]).epsilon(1e-14));
  }
}

TEST_CASE("a matrix that is not symmetric is solved without the multipliers' shift, too") {
  Random random(4);
  for (const double share : {1e-2, 1., 1e3}) {
    Saddle saddle(random);
    saddle.softness.tail(2).setConstant(share * 1e-8);
    Dense Z = Dense::Zero(8, 8);
    Z.topLeftCorner(6, 6) = random_skew(random, 6);
    auto factor = saddle.factor();
    factor.renew(saddle.softness, Vector::Ones(8));
    factor.factorise(0);
    const Vector b = random.vector(8), expected = saddle.solution(b, Z);
    Vector x;
    factor.solve(b, x);
    factor.correct_skew([&](const Vector& v, Vector& out) { out = Z * v; }, x);
    CHECK(error(x, expected) < 1e-11);
    CHECK(distance(dense(saddle.K).bottomRows(2) * x, b.tail(2)) < 1e-10 * b.norm());
  }
}

TEST_CASE("pivots that are zero without the shift: a multiplier first, a part that turns freely") {
  Dense A = Dense::Zero(4, 4);  // λ, x, y, z: λ holds x − 2 y, and nothing z
  A.row(0) = A.col(0) = Vec<4>(0, 1, -2, 0);
  A.diagonal() = Vec<4>(0, 3, 4, 0);
  SymmetricMatrix K = sparse(A);
  const Vector stiffness = Vec<4>(0, 1, 1, 1);
  ShiftedFactor factor(K, stiffness, Vector::Ones(4), always);
  factor.factorise(0);
  CHECK(factor.broken());

  factor.renew(Vec<4>(1e-10, 0, 0, 0), Vector::Ones(4));
  factor.factorise(0);
  CHECK_FALSE(factor.broken());
  CHECK(factor.index() == 0);
  const Vector b = Vec<4>(1, 2, -3, 1e-6);
  const Dense kept = A + always * Dense(stiffness.asDiagonal());
  Vector x;
  factor.solve(b, x);
  factor.correct(b, x);
  CHECK(distance(x, solve_dense(kept, b)) < 1e-12 * x.norm());
  CHECK(x[3] == doctest::Approx(1).epsilon(1e-12));
  CHECK(distance(dense(K), A) == 0);  // is left as it was
}

TEST_CASE("a factor is kept until the matrix is said to have changed") {
  Random random(5);
  Saddle saddle(random, 1);
  auto factor = saddle.factor();
  const Vector b = random.vector(8);
  Vector before, after;
  factor.factorise(0);
  factor.solve(b, before);
  for (double& value : saddle.K.values) value *= 2;
  factor.factorise(0);
  factor.solve(b, after);
  CHECK(distance(after, before) == 0);
  factor.renew(saddle.softness, Vector::Ones(8));
  factor.factorise(0);
  factor.solve(b, after);
  CHECK(distance(after, Vector(before / 2)) < 1e-5 * before.norm());
}
