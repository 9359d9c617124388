// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/mode.hpp>

#include "support/constrained_problem.hpp"
#include "support/near.hpp"

#include <Eigen/QR>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A saddle with two multipliers whose K v = λ diag(stiffness) v on the constraints has these λ.
struct Saddle {
  Saddle(Random& random, const Vector& eigenvalues, double across = 5) {
    const int n = int(eigenvalues.size()) + 2;
    stiffness = Vector::Zero(n + 2);
    stiffness.head(n) = 2 + random.vector(n).array();
    const Vector roots = stiffness.head(n).cwiseSqrt();
    const Dense C = random_dense(random, n).topRows(2);
    // the first two columns are across the constraints, the others on them
    const Dense scaled = (C * roots.cwiseInverse().asDiagonal()).transpose();
    const Dense Q = scaled.householderQr().householderQ();
    Vector all(n);
    all << across, 2 * across, eigenvalues;
    const Dense A = roots.asDiagonal() * Q * all.asDiagonal() * Q.transpose() * roots.asDiagonal();
    const auto program =
        quadratic_program((A + A.transpose()) / 2, Vector::Zero(n), C, Vec<2>(0, 0));
    K = sparse(program.matrix(Vector::Zero(n), Vec<2>(0, 0)));
    softness = Vector::Zero(n + 2);
    softness.tail(2).setConstant(1e-10);
  }
  int index(double zero = 1e-6, double near = 1e-4) {
    ShiftedFactor factor(K, stiffness, Vector::Ones(K.size()));
    factor.renew(softness, Vector::Ones(K.size()));
    return confirmed_index(factor, zero, near);
  }

  SymmetricMatrix K;
  Vector stiffness, softness;
};

}  // namespace

TEST_CASE("an index counts what falls by more than nothing, which is told from the shift") {
  Random random(1);
  Saddle saddle(random, Vec<6>(-1e-5, -1e-8, 1e-8, 0.5, 1, 3));
  CHECK(saddle.index() == 1);
  CHECK(saddle.index(1e-9) == 2);  // although the shift is 1e-6
  CHECK(saddle.index(1e-4 / 2) == 0);
  CHECK(Saddle(random, Vec<6>(-1.1e-6, -0.9e-6, 1e-8, 0.5, 1, 3)).index() == 1);
  CHECK(Saddle(random, Vec<6>(-1e-8, -1e-9, 0, 1e-7, 1, 3)).index() == 0);
}

TEST_CASE("what falls much is counted by pivots, beside soft modes and alone") {
  Random random(2);
  CHECK(Saddle(random, Vec<6>(-2, -1e-3, -1e-5, -1e-8, 1e-8, 1)).index() == 3);
  CHECK(Saddle(random, Vec<6>(-2, -1, -1e-3, 1e-2, 1, 2)).index() == 3);
  CHECK(Saddle(random, Vec<6>(1e-3, 1e-2, 1, 2, 3, 4)).index() == 0);
  CHECK(Saddle(random, Vec<6>(-2, -1, -0.5, -0.1, 1e-5, 1)).index() == 4);
}

TEST_CASE("an index where every direction is soft") {
  Random random(3);
  CHECK(Saddle(random, Vec<3>(-1e-5, -1e-8, 1e-8)).index() == 1);
  CHECK(Saddle(random, Vec<3>(-3e-5, -2e-5, -1e-5)).index() == 3);
  CHECK(Saddle(random, Vec<1>(-1e-5)).index() == 1);
}

TEST_CASE("falling directions across the constraints do not count") {
  Random random(4);
  CHECK(Saddle(random, Vec<6>(-1e-5, -1e-8, 1e-8, 0.5, 1, 3), -5).index() == 1);
}

TEST_CASE("the mode nearest to a shift, exactly or with what the factor always adds") {
  Random random(5);
  Saddle saddle(random, Vec<5>(2e-6, 0.5, 1, 2, 3));
  ShiftedFactor factor(saddle.K, saddle.stiffness, Vector::Ones(saddle.K.size()));
  factor.renew(saddle.softness, Vector::Ones(saddle.K.size()));
  for (const bool exact : {true, false}) {
    factor.factorise(0);
    const Mode mode = inverse_iteration(factor, saddle.stiffness, 0, 20, exact);
    CHECK(mode.eigenvalue == doctest::Approx(2e-6).epsilon(1e-6));
    CHECK(mode.shape.lpNorm<Eigen::Infinity>() == doctest::Approx(1).epsilon(1e-15));
    CHECK(mode.shape.tail(2).norm() == 0);
    CHECK(dense(saddle.K).bottomRows(2).operator*(mode.shape).norm() < (exact ? 1e-12 : 1e-8));
  }
}
