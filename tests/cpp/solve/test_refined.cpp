// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/refined.hpp>

#include "support/matrices.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Solves (K + Z) x = b with a factor to which `share` of the diagonal is always added.
struct Shifted {
  Dense K, Z;
  double share;
  Dense free = {};  ///< what is known of the null space
  int products = 0;

  std::pair<bool, Vector> solved(const Vector& b) {
    auto sparse_K = sparse(K);
    const Vector stiffness = Vector::Ones(K.rows());
    ShiftedFactor factor(sparse_K, stiffness, stiffness, share);
    factor.factorise(0);
    Refined refined(factor);
    refined.set_free(free);
    Vector x;
    const bool done = refined.solve(
        [&](const Vector& v, Vector& out) {
          ++products;
          out = Z * v;
        },
        !Z.isZero(0), b, x);
    return {done, x};
  }
};

}  // namespace

TEST_CASE("what is added to the factor does not show in the solution") {
  Random random(1);
  const Dense K = random_positive(random, 12), none = Dense::Zero(12, 12);
  const Vector b = random.vector(12), expected = solve_dense(K, b);
  for (const double share : {0., 1e-6, 1e-2, 1., 100.}) {  // small: refined; large: by GMRES
    Shifted system{K, none, share};
    const auto [done, x] = system.solved(b);
    CHECK(done);
    CHECK(distance(x, expected) < 1e-12 * expected.norm());
  }
}

TEST_CASE("tangents that are not symmetric, and their transposes") {
  Random random(2);
  const Dense K = random_positive(random, 10), Z = random_dense(random, 10);
  const Vector b = random.vector(10);
  for (const Dense& part : {Z, Dense(Z.transpose())}) {
    Shifted system{K, part, 1e-6};
    const auto [done, x] = system.solved(b);
    CHECK(done);
    CHECK(distance(x, solve_dense(K + part, b)) < 1e-11 * x.norm());
    CHECK(system.products > 0);
    const auto [still, nothing] = system.solved(Vector::Zero(10));
    CHECK(still);
    CHECK(nothing.isZero(0));
  }
}

TEST_CASE("near a critical point digits are found as long as there are any") {
  Random random(3);
  Dense K = random_positive(random, 8);
  const Eigen::SelfAdjointEigenSolver<Dense> of(K);
  const Vector v = of.eigenvectors().col(0);
  const Vector b = random.vector(8);
  for (const double lowest : {1e-3, 1e-6, 1e-8}) {
    const Dense near = K + (lowest - of.eigenvalues()[0]) * v * v.transpose();
    Shifted system{near, Dense::Zero(8, 8), 1e-6};
    const auto [done, x] = system.solved(b);
    CHECK(done);
    CHECK((near * x - b).norm() < 1e-13 * near.norm() * x.norm());
    CHECK(std::abs(v.dot(x) / (v.dot(b) / lowest) - 1) < 1e-13 / lowest);
  }
}

TEST_CASE("a singular matrix is told, unless its null space is known") {
  Random random(4);
  const Dense C = random_positive(random, 8);
  const Eigen::SelfAdjointEigenSolver<Dense> of(C);
  const Vector v = of.eigenvectors().col(0);
  const Dense K = C - of.eigenvalues()[0] * v * v.transpose();
  Vector b = random.vector(8);
  Shifted system{K, Dense::Zero(8, 8), 1e-6};
  CHECK_FALSE(system.solved(b).first);
  system.free = v;
  const auto [done, x] = system.solved(b);
  CHECK(done);
  CHECK(std::abs(v.dot(x)) < 1e-11 * x.norm());
  b -= v.dot(b) * v;
  CHECK((K * x - b).norm() < 1e-11 * b.norm());
}
