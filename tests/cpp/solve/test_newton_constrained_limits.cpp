// SPDX-License-Identifier: BSD-3-Clause
// Modes, multipliers that are not known, circles of solutions, no solution, no potential.
#include <pyrod/solve/newton.hpp>

#include "support/constrained_problem.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

using Solver = Newton<ConstrainedProblem>;

Options patient() {
  Options options;
  options.trust = 1e3;
  return options;
}

/// (|x|² − 1)²/4 in the plane of x1 and x2, and x3 = (x1² + x2²)/2: the solutions are the circle of
/// radius 1 at height ½. It pulls with `force` along x1.
ConstrainedProblem hat(double force = 0) {
  const auto square = [](const Vector& x) { return x.head<2>().squaredNorm(); };
  return {3,
          1,
          [=](const Vector& x) { return std::pow(square(x) - 1, 2) / 4 - force * x[0]; },
          [=](const Vector& x) -> Vector {
            const double d = square(x) - 1;
            return Vec3(d * x[0] - force, d * x[1], 0);
          },
          [=](const Vector& x) -> Dense {
            Dense H = Dense::Zero(3, 3);
            H.topLeftCorner(2, 2) =
                2 * x.head<2>() * x.head<2>().transpose() + (square(x) - 1) * Mat<2>::Identity();
            return H;
          },
          [=](const Vector& x) -> Vector { return Vector::Constant(1, x[2] - square(x) / 2); },
          [](const Vector& x) -> Dense { return Vec3(-x[0], -x[1], 1).transpose(); },
          [](const Vector&, const Vector& λ) -> Dense {
            return -λ[0] * Vec3(1, 1, 0).asDiagonal().toDenseMatrix();
          }};
}

}  // namespace

TEST_CASE("the lowest mode is that of the dense eigenvalue problem on the constraints") {
  Random random(1);
  int falling = 0, rising = 0;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    const int n = 4 + i % 5, constraints = i % 3;
    const Dense A = i % 2 == 0 ? random_symmetric(random, n) : random_positive(random, n);
    const Dense C = random_dense(random, n).topRows(constraints);
    auto problem = quadratic_program(A, random.vector(n), C, random.vector(constraints));
    problem.mass = (2 + random.vector(n).array()) / n;
    const auto modes = projected_modes(A, problem.mass, C);
    if (modes.eigenvalues[1] - modes.eigenvalues[0] < 0.3) continue;  // not one mode
    Solver solver(problem, patient(), {}, false);
    if (!solver.solve(Vector::Zero(n + constraints), Hessian::exact).converged()) continue;
    const Mode mode = solver.lowest_mode();
    CHECK(std::abs(mode.eigenvalue - modes.eigenvalues[0]) < 1e-8 * (1 + A.norm()));
    CHECK(mode.shape.cwiseAbs().maxCoeff() == doctest::Approx(1).epsilon(1e-15));
    CHECK(mode.shape.tail(constraints).norm() == 0);
    const Vector shape = mode.shape.head(n), expected = modes.shapes.col(0);
    CHECK((C * shape).norm() < 1e-8);
    const double along = shape.dot(problem.mass.cwiseProduct(expected));  // expected has length 1
    CHECK(distance(shape, Vector(along * expected)) < 1e-4);  // the square of it in the eigenvalue
    (mode.eigenvalue < 0 ? falling : rising) += 1;
  }
  CHECK(falling > 8);
  CHECK(rising > 8);
}

TEST_CASE("multipliers that mean nothing are estimated: at a solution exactly") {
  Random random(2);
  const int n = 6, constraints = 2;
  const Dense A = random_positive(random, n), C = random_dense(random, n).topRows(constraints);
  const Vector b = random.vector(n);
  const auto problem = quadratic_program(A, b, C, random.vector(constraints));
  const auto found = Solver(problem, patient()).solve(Vector::Zero(8), Hessian::exact);
  REQUIRE(found.converged());
  Vector start = found.state;
  start.tail(constraints) += 1e3 * random.vector(constraints);
  const auto again = Solver(problem).solve(start, Hessian::exact, true);
  CHECK(again.converged());
  CHECK(again.record[0].residual < 1e-6);  // 10⁻¹⁰ of 10³, over the smallest pivot
  CHECK(distance(again.state, found.state) < 1e-10);
}

TEST_CASE("elsewhere the estimate comes nearest to balance, and moves nothing else") {
  Random random(3);
  const int n = 6, constraints = 2;
  const Dense A = random_positive(random, n), C = random_dense(random, n).topRows(constraints);
  const auto problem = quadratic_program(A, random.vector(n), C, random.vector(constraints));
  const Vector start = random.vector(n + constraints);
  Options one;
  one.max_iterations = 1;
  const auto result = Solver(problem, one).solve(start, Hessian::exact, true);
  // the least of |∇f + Cᵀλ| in the norm of the shifted matrix
  const Dense inverse = (A + (1 + 1e-6) * Dense(problem.mass.asDiagonal())).inverse();
  const Vector slope = problem.slope(start.head(n));
  const Vector λ = -(C * inverse * C.transpose()).inverse() * C * inverse * slope;
  Vector gradient(n + constraints);
  gradient << slope + C.transpose() * λ, problem.c(start.head(n));
  CHECK(result.record[0].residual ==
        doctest::Approx(gradient.lpNorm<Eigen::Infinity>()).epsilon(1e-8));
  CHECK(result.record[0].energy ==
        doctest::Approx(problem.f(start.head(n)) + λ.dot(problem.c(start.head(n)))).epsilon(1e-8));
}

TEST_CASE("a circle of solutions: the way to it does not creep along it") {
  for (const Vec<4>& start : {Vec<4>(0.9, 0.3, 0.4, 0), Vec<4>(-1.4, 1, 0, 0.2)}) {
    const auto result = Solver(hat()).solve(start, Hessian::exact);
    CHECK(result.converged());
    CHECK(result.index == 0);
    CHECK(result.iterations() < 12);
    CHECK(distance(result.state.head(2).norm(), 1) < 1e-10);
    CHECK(distance(result.state[2], 0.5) < 1e-10);
    CHECK(distance(result.state[3], 0) < 1e-10);
    // and stays at the angle where it started, since nothing pulls along the circle
    CHECK(std::atan2(result.state[1], result.state[0]) ==
          doctest::Approx(std::atan2(start[1], start[0])).epsilon(1e-6));
  }
}

TEST_CASE("on the circle the matrix is singular, but for the shift there always is") {
  const Vector start = Vec<4>(1, 0, 0.5, 0);
  const auto result = Solver(hat()).solve(start, Hessian::exact);
  CHECK(result.converged());
  CHECK(result.index == 0);
  CHECK(result.iterations() == 1);
  CHECK(result.record[0].shift == 0);
  CHECK(result.record[0].factorisations == 1);
  CHECK(distance(result.state, start) == 0);
}

TEST_CASE("a force picks one point of the circle, and the top of the hat is left") {
  const auto result = Solver(hat(1e-3)).solve(Vec<4>(-1e-3, 1e-3, 0, 0), Hessian::exact);
  CHECK(result.converged());
  CHECK(result.index == 0);
  CHECK(result.state[0] > 1);  // x (x² − 1) = force
  CHECK(std::abs(result.state[0] * (std::pow(result.state[0], 2) - 1) - 1e-3) < 1e-12);
  CHECK(std::abs(result.state[1]) < 1e-7);
}

TEST_CASE("constraints that cannot be met end with a status, in finite time") {
  Dense C(2, 2);
  C << 1, 0, 1, 0;  // x1 = 0 and x1 = 1
  const auto linear = quadratic_program(Dense::Identity(2, 2), Vec<2>(0, 0), C, Vec<2>(0, 1));
  auto curved =
      quadratic_program(Dense::Identity(2, 2), Vec<2>(1, 2), Dense::Zero(1, 2), Vector::Zero(1));
  curved.c = [](const Vector& x) -> Vector { return Vector::Constant(1, x[0] * x[0] + 1); };
  curved.slopes = [](const Vector& x) -> Dense { return Vec<2>(2 * x[0], 0).transpose(); };
  curved.bent = [](const Vector&, const Vector& λ) -> Dense {
    return Vec<2>(2 * λ[0], 0).asDiagonal().toDenseMatrix();
  };
  for (const bool minimum : {true, false})
    for (const ConstrainedProblem* problem :
         std::initializer_list<const ConstrainedProblem*>{&linear, &curved}) {
      const Vector start = Vector::Constant(problem->size + problem->constraints, 0.3);
      const auto result = Solver(*problem, {}, {}, minimum).solve(start, Hessian::exact);
      CHECK_FALSE(result.converged());
      CHECK(result.index == -1);
      CHECK(result.iterations() <= Options().max_iterations);
    }
}

TEST_CASE("numbers that are not finite, and a trace that says stop") {
  auto problem =
      quadratic_program(Dense::Identity(2, 2), Vec<2>(1, 2), Dense::Ones(1, 2), Vector::Zero(1));
  const auto stopped = Solver(problem, {}, [](const Iteration&) {
                         return false;
                       }).solve(Vector::Ones(3), Hessian::exact);
  CHECK(stopped.status == Status::interrupted);
  CHECK(stopped.iterations() == 1);
  problem.f = [](const Vector&) { return std::nan(""); };
  CHECK(Solver(problem).solve(Vector::Ones(3), Hessian::exact).status == Status::not_finite);
}

TEST_CASE("forces without a potential on constraints: against the dense solution, no index") {
  Random random(4);
  for (const int n : {2, 5, 9}) {
    const Dense A = random_positive(random, n), Z = random_skew(random, n);
    const Dense C = random_dense(random, n).topRows(1);
    const Vector b = random.vector(n), d = random.vector(1);
    auto problem = quadratic_program(A, b, C, d);
    problem.skew = [Z](const Vector&) { return Z; };
    Dense K = problem.matrix(b, d);
    K.topLeftCorner(n, n) += Z;
    Vector right(n + 1);
    right << b, d;
    const Vector expected = solve_dense(K, right);
    const auto result = Solver(problem, patient()).solve(Vector::Zero(n + 1), Hessian::exact);
    CHECK(result.converged());
    CHECK(result.iterations() <= 5);
    CHECK(distance(result.state, expected) < 1e-11 * (1 + expected.norm()));
    CHECK(result.index == -1);
  }
}
