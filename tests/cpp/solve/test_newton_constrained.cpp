// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/newton.hpp>

#include "support/constrained_problem.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double always = 1e-6;  // share of the unit that is always added to the primal rows

Result<Vector> solved(const ConstrainedProblem& problem, const Vector& start, bool minimum = true,
                      const Options& options = {}, bool estimate = false) {
  return Newton<ConstrainedProblem>(problem, options, {}, minimum)
      .solve(start, Hessian::exact, estimate);
}

Options patient() {
  Options options;
  options.trust = 1e3;
  return options;
}

/// Symmetric, with these eigenvalues.
Dense with_eigenvalues(Random& random, const Vector& values) {
  const int n = int(values.size());
  const Dense Q = random_dense(random, n).householderQr().householderQ();
  return Q * values.asDiagonal() * Q.transpose();
}

Vector sphere_state(const Dense& A, int k, double away = 0) {
  const auto modes = projected_modes(A, Vector::Ones(A.rows()), Dense(0, A.rows()));
  Vector x = modes.shapes.col(k);
  for (int i = 0; i < x.size(); ++i) x += away * modes.shapes.col(i) / (i + 1);
  Vector out(x.size() + 1);
  out << x.normalized(), -modes.eigenvalues[k];
  return out;
}

}  // namespace

TEST_CASE("a quadratic on linear constraints takes one step, but for the shift there always is") {
  Random random(1);
  for (const int constraints : {0, 1, 3}) {
    CAPTURE(constraints);
    const int n = 6, all = n + constraints;
    const Dense A = random_positive(random, n), C = random_dense(random, n).topRows(constraints);
    const Vector b = random.vector(n), d = random.vector(constraints);
    const auto problem = quadratic_program(A, b, C, d);
    Vector right(all);
    right << b, d;
    const Vector expected = solve_dense(problem.matrix(b, d), right);
    const auto result = solved(problem, random.vector(all), true, patient());
    CHECK(result.converged());
    CHECK(result.index == 0);
    CHECK(distance(result.state, expected) < 1e-12 * (1 + expected.norm()));
    CHECK(result.iterations() <= 4);
    // (A + ε M)⁻¹ A leaves ε M/λ of the error, λ ≥ 1
    CHECK(result.record[1].step < 10 * always / n * result.record[0].step);
    CHECK(result.record[0].fraction == 1);
    CHECK(result.record[0].factorisations == 1);
  }
}

TEST_CASE("near a solution on a curved constraint each step is the square of the one before") {
  Random random(2);
  const Dense A = with_eigenvalues(random, Vec<5>(1, 2, 3, 4, 5));
  for (const bool minimum : {true, false})
    for (int k = 0; k < (minimum ? 1 : 5); ++k) {
      CAPTURE(k);
      const auto result = solved(on_sphere(A), sphere_state(A, k, 0.05), minimum);
      REQUIRE(result.converged());
      CHECK(distance(result.state.head(5).norm(), 1) < 1e-12);
      CHECK(result.state[5] == doctest::Approx(-(k + 1)).epsilon(1e-10));
      CHECK(result.index == k);
      CHECK(result.energy == doctest::Approx((k + 1) / 2.).epsilon(1e-12));
      const auto& r = result.record;
      CHECK(r.size() >= 3);
      for (std::size_t i = 1; i < r.size(); ++i)  // 5: the eigenvalues' spread over their gap
        CHECK(r[i].step < 5 * r[i - 1].step * r[i - 1].step + 2 * always * r[i - 1].step);
    }
}

TEST_CASE("of equilibria that go over into each other the one nearest to the anchor is found") {
  // an ellipse of minima: g = x²/4 + y² − 1 vanishes there, the energy is g²/2
  const auto g = [](const Vector& x) { return x[0] * x[0] / 4 + x[1] * x[1] - 1; };
  const auto normal = [](const Vector& x) -> Vector { return Vec2(x[0] / 2, 2 * x[1]); };
  const ConstrainedProblem valley = {2,
                                     0,
                                     [=](const Vector& x) { return g(x) * g(x) / 2; },
                                     [=](const Vector& x) -> Vector { return g(x) * normal(x); },
                                     [=](const Vector& x) -> Dense {
                                       const Vector n = normal(x);
                                       return Dense(n * n.transpose()) +
                                              g(x) * Dense(Vec2(0.5, 2).asDiagonal());
                                     },
                                     [](const Vector&) -> Vector { return Vector::Zero(0); },
                                     [](const Vector&) -> Dense { return Dense::Zero(0, 2); }};
  for (const double turn : {0.3, 0.9, 1.4, 2.5, 4.0})
    for (const double away : {0.95, 1.1}) {
      CAPTURE(turn);
      CAPTURE(away);
      const Vector start = away * Vec2(2 * std::cos(turn), std::sin(turn));
      const auto aside = [&](bool anchored) {
        const auto result =
            Newton<ConstrainedProblem>(valley).solve(start, Hessian::exact, false, anchored);
        REQUIRE(result.converged());
        const Vector moved = result.state - start, n = normal(result.state);
        return std::abs(moved[0] * n[1] - moved[1] * n[0]);
      };
      CHECK(aside(true) < 1e-5);
      CHECK(aside(false) > 1e-4);  // by chance
    }
}

TEST_CASE("the index counts the falling directions on the constraints, not those of the matrix") {
  Random random(3);
  int saddles = 0, hidden = 0;
  for (int i = 0; i < 60; ++i) {
    const int n = 3 + i % 6, constraints = i % 3;
    const Dense A = random_symmetric(random, n), C = random_dense(random, n).topRows(constraints);
    const Vector b = random.vector(n);
    const auto problem = quadratic_program(A, b, C, random.vector(constraints));
    const auto result = solved(problem, Vector::Zero(n + constraints), false, patient());
    if (!result.converged()) continue;  // far away
    const auto modes = projected_modes(A, problem.mass, C);
    const int expected = int((modes.eigenvalues.array() < 0).count());
    CHECK(result.index == expected);
    saddles += expected > 0;
    hidden += expected != negative_eigenvalues(A);
  }
  CHECK(saddles > 30);
  CHECK(hidden > 20);
}

TEST_CASE("a start near a saddle leaves it if a minimum is asked for, else ends there") {
  Random random(4);
  const Dense A = with_eigenvalues(random, Vec<4>(-1, 0.5, 2, 3));
  for (int k = 1; k < 4; ++k) {
    const Vector near = sphere_state(A, k, 0.02), exact = sphere_state(A, k);
    const auto down = solved(on_sphere(A), near);
    CHECK(down.converged());
    CHECK(down.index == 0);
    CHECK(down.energy == doctest::Approx(-0.5).epsilon(1e-12));
    CHECK(down.record[0].shift > 0);
    const auto stay = solved(on_sphere(A), near, false);
    CHECK(stay.converged());
    CHECK(stay.index == k);
    CHECK(distance(stay.state, exact) < 1e-10);
    for (const auto& i : stay.record) CHECK(i.shift == 0);
    // what is an equilibrium already is kept in any case, and the index tells
    const auto kept = solved(on_sphere(A), exact);
    CHECK(kept.converged());
    CHECK(kept.index == k);
    CHECK(distance(kept.state, exact) < 1e-10);
  }
}

TEST_CASE("the steps towards a minimum lower the energy once the constraint holds") {
  Random random(5);
  const Dense A = with_eigenvalues(random, Vec<6>(-3, -2, 0, 1, 4, 9));
  const auto result = solved(on_sphere(A), sphere_state(A, 5, 0.01));
  REQUIRE(result.converged());
  CHECK(result.index == 0);
  CHECK(result.energy == doctest::Approx(-1.5).epsilon(1e-12));
  CHECK(result.iterations() < 30);
}

TEST_CASE("units do not matter: the energy's scale, a power of two, changes no step") {
  Random random(6);
  const Dense A = with_eigenvalues(random, Vec<4>(-1, 1, 2, 3));
  const Vector start = sphere_state(A, 2, 0.05);
  const auto base = solved(on_sphere(A), start);
  for (const double scale : {0x1p-60, 0x1p40}) {
    auto problem = on_sphere(scale * A);
    problem.unit = scale;
    problem.c = [scale](const Vector& x) -> Vector {
      return Vector::Constant(1, scale * (x.squaredNorm() - 1) / 2);
    };
    problem.slopes = [scale](const Vector& x) -> Dense { return scale * x.transpose(); };
    problem.bent = [scale](const Vector&, const Vector& λ) -> Dense {
      return scale * λ[0] * Dense::Identity(4, 4);
    };
    const auto scaled = solved(problem, start);
    REQUIRE(scaled.iterations() == base.iterations());
    CHECK(distance(scaled.state, base.state) == 0);
    CHECK(scaled.energy == scale * base.energy);
    for (int i = 0; i < base.iterations(); ++i) {
      CHECK(scaled.record[i].step == base.record[i].step);
      CHECK(scaled.record[i].shift == scale * base.record[i].shift);
    }
  }
}
