// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/bordered.hpp>

#include "support/matrices.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// [K + Z, b; cᵀ, d] by a factor of K to which `shift` of the identity is added.
struct System {
  Dense K, Z;
  Vector b, c;
  double d, shift;

  Dense matrix() const {
    const auto n = K.rows();
    Dense M(n + 1, n + 1);
    M << K + Z, b, c.transpose(), d;
    return M;
  }

  /// exactly, or refined once, or as the factor tells.
  Vector solved(const Vector& f, double h, int how) const {
    auto A = sparse(K);
    const Vector ones = Vector::Ones(K.rows());
    ShiftedFactor factor(A, ones, ones, shift);
    factor.factorise(0);
    const Neutral none;
    Bordered bordered(factor, none);
    bordered.set(b, c, d);
    Vector x, out(K.rows() + 1);
    double y = 0;
    if (how == 2) {
      y = bordered.solve_exactly([&](const Vector& v, Vector& to) { to = Z * v; }, f, h, x);
    } else {
      y = bordered.solve(f, h, x);
      if (how == 1) bordered.refine(x, y);
    }
    out << x, y;
    return out;
  }
};

/// With an eigenvalue of zero, to rounding.
Dense singular(Random& random, int size, Vector& mode) {
  const Dense C = random_symmetric(random, size);
  const Eigen::SelfAdjointEigenSolver<Dense> of(C);
  mode = of.eigenvectors().col(size / 2);
  return C - of.eigenvalues()[size / 2] * mode * mode.transpose();
}

}  // namespace

TEST_CASE("bordered systems where the matrix is singular, against a dense solve") {
  Random random(1);
  for (const int size : {1, 2, 7, 40}) {
    Vector mode;
    const Dense K = singular(random, size, mode), none = Dense::Zero(size, size);
    const Vector f = random.vector(size), b = random.vector(size) + mode,
                 c = random.vector(size) + mode;
    const double h = random.number();
    for (const auto& [column, row, d] :
         {std::tuple(b, c, 0.7), std::tuple(mode, mode, 0.), std::tuple(b, b, 0.)}) {
      System system{K, none, column, row, d, 1e-2};
      Vector right(size + 1);
      right << f, h;
      const Vector expected = solve_dense(system.matrix(), right);
      const double scale = expected.norm() * std::max(1., system.matrix().norm());
      CHECK(distance(system.solved(f, h, 2), expected) < 1e-11 * scale);
      // a small shift alone costs digits, of which one refinement gets back most
      system.shift = 1e-6;
      const double plain = distance(system.solved(f, h, 0), expected),
                   refined = distance(system.solved(f, h, 1), expected);
      CHECK(plain > 1e-12 * scale);
      CHECK(plain < 1e-3 * scale);
      CHECK(refined < std::max(0.1 * plain, 1e-8 * scale));
    }
  }
}

TEST_CASE("bordered systems that are not symmetric") {
  Random random(2);
  for (const int size : {2, 7, 30}) {
    const Dense K = random_symmetric(random, size), Z = random_skew(random, size);
    const System system{K, Z, random.vector(size), random.vector(size), 0.3, 1e-2};
    Vector right = random.vector(size + 1);
    const Vector f = right.head(size), expected = solve_dense(system.matrix(), right);
    CHECK(distance(system.solved(f, right[size], 2), expected) <
          1e-10 * expected.norm() * system.matrix().norm());
  }
}

TEST_CASE("without anything added two back-substitutions are exact") {
  Random random(3);
  const Dense K = random_positive(random, 9);
  const System system{K, Dense::Zero(9, 9), random.vector(9), random.vector(9), 1., 0.};
  const Vector right = random.vector(10), f = right.head(9);
  CHECK(distance(system.solved(f, right[9], 0), solve_dense(system.matrix(), right)) < 1e-12);
}
