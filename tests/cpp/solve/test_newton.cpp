// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/newton.hpp>

#include "support/flat_problem.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

Result<Vector> solved(const FlatProblem& problem, const Vector& start,
                      Hessian first = Hessian::exact, const Options& options = {},
                      const Trace& trace = {}) {
  return Newton<FlatProblem>(problem, options, trace).solve(start, first);
}

/// Forces A x + Z x + x³ − b, whose symmetric part has the Hessian A + 3 x².
FlatProblem circulating(const Dense& A, const Dense& Z, const Vector& b, double cubic) {
  return {int(b.size()),
          [](const Vector&) { return 0.; },
          [=](const Vector& x) -> Vector {
            return (A + Z) * x + cubic * x.array().cube().matrix() - b;
          },
          [=](const Vector& x) -> Dense {
            return A + Dense((3 * cubic * x.array().square()).matrix().asDiagonal());
          },
          {},
          [=](const Vector&) { return Z; }};
}

}  // namespace

TEST_CASE("a convex quadratic takes one step, and one that finds nothing left to do") {
  Random random(1);
  const Dense A = random_positive(random, 6);
  const Vector minimum = random.vector(6), b = A * minimum;
  const auto result = solved(quadratic(A, b), minimum + 0.3 * random.vector(6));
  CHECK(result.converged());
  CHECK(result.iterations() == 2);
  CHECK(distance(result.state, minimum) < 1e-13);
  CHECK(result.index == 0);
  CHECK(result.energy == doctest::Approx(-minimum.dot(b) / 2).epsilon(1e-14));
  CHECK(result.residual < 1e-13);
  const Iteration& first = result.record[0];
  CHECK(first.kind == Hessian::exact);
  CHECK(first.fraction == 1);
  CHECK(first.shift == 0);
  CHECK(first.factorisations == 1);
  CHECK(first.step > 0.01);
  CHECK(first.residual > 0.01);
  CHECK(first.energy > result.energy);
  CHECK(result.record[1].step < 1e-12);
  CHECK(solved(quadratic(A, b), minimum).iterations() == 1);
}

TEST_CASE("from between the wells: the Hessian is shifted, and a minimum is found") {
  Vector start = Vec<4>(0.1, -0.2, 0.3, 0.05);
  const auto result = solved(double_wells(4), start);
  CHECK(result.converged());
  CHECK(distance(result.state, Vec<4>(1, -1, 1, 1)) < 1e-8);
  CHECK(result.index == 0);
  CHECK(result.record[0].shift > 0);
  CHECK(result.record[0].factorisations > 1);
  CHECK(result.record.back().shift == 0);
  for (std::size_t i = 1; i < result.record.size(); ++i)
    CHECK(result.record[i].energy < result.record[i - 1].energy);
}

TEST_CASE("along a curved valley") {
  const auto result = solved(rosenbrock(), Vec<2>(-1.2, 1));
  CHECK(result.converged());
  CHECK(distance(result.state, Vec<2>(1, 1)) < 1e-10);
  CHECK(result.iterations() < 40);
  const auto has_cut = [](const Iteration& i) { return i.fraction < 1; };
  CHECK(std::any_of(result.record.begin(), result.record.end(), has_cut));
}

TEST_CASE("a start at an equilibrium stays there, and its index is reported") {
  for (const auto& [start, index] : {std::pair{Vec3(0, 1, -1), 1}, {Vec3(0, 0, 0), 3}}) {
    const auto result = solved(double_wells(3), start);
    CHECK(result.converged());
    CHECK(result.iterations() == 1);
    CHECK(result.index == index);
    CHECK(distance(result.state, start) == 0);
  }
}

TEST_CASE("near the solution every step is the square of the one before") {
  const auto result = solved(double_wells(1), Vector::Constant(1, 1.3));
  REQUIRE(result.converged());
  const auto& r = result.record;
  for (std::size_t i = 1; i < r.size(); ++i)
    CHECK(r[i].step <= 1.7 * r[i - 1].step * r[i - 1].step);
}

TEST_CASE("far away the convex Hessian makes the steps, near the exact one") {
  auto problem = double_wells(2);
  problem.convex = [](const Vector& x) -> Dense {
    return (3 * x.array().square() + 2).matrix().asDiagonal();
  };
  const auto result = solved(problem, Vec<2>(4, -5), Hessian::convex);
  CHECK(result.converged());
  CHECK(distance(result.state, Vec<2>(1, -1)) < 1e-8);
  CHECK(result.record.front().kind == Hessian::convex);
  CHECK(result.record.back().kind == Hessian::exact);
  const double near = Options().near;
  for (std::size_t i = 1; i < result.record.size(); ++i)
    if (result.record[i - 1].step < near) CHECK(result.record[i].kind == Hessian::exact);
  // An exact step longer than `trust` is not trusted.
  for (const auto& i : solved(problem, Vec<2>(0.6, -0.6)).record) CHECK(i.step <= Options().trust);
}

TEST_CASE("at a minimum of rounding size nothing stalls, whichever Hessian comes first") {
  // ½ (x − 1)², with noise that the energy's magnitude does not own up to
  auto noisy = quadratic(Dense::Identity(1, 1), Vector::Ones(1));
  double noise = 0;
  noisy.f = [&](const Vector&) { return noise += 1e-30; };
  for (const Hessian first : {Hessian::convex, Hessian::exact})
    for (const double start : {1., 1 + 1e-15, 1 - 1e-12}) {
      const auto result = solved(noisy, Vector::Constant(1, start), first);
      CHECK(result.converged());
      CHECK(result.index == 0);
      CHECK(result.iterations() <= 2);
    }
}

TEST_CASE("the solve ends with the exact Hessian even if no step is near enough for it") {
  Options options;
  options.near = 0;
  auto problem = double_wells(1);
  problem.convex = [](const Vector& x) -> Dense { return Dense::Constant(1, 1, 3 * x[0] * x[0]); };
  const auto result = solved(problem, Vector::Constant(1, 2), Hessian::convex, options);
  CHECK(result.converged());
  CHECK(result.record.back().kind == Hessian::exact);
}

TEST_CASE("forces without a potential: linear ones take one step") {
  Random random(2);
  for (const int size : {1, 4, 12}) {
    const Dense A = random_positive(random, size), Z = random_skew(random, size);
    const Vector solution = random.vector(size), b = (A + Z) * solution;
    const auto result = solved(circulating(A, Z, b, 0), solution + 0.3 * random.vector(size));
    CHECK(result.converged());
    CHECK(result.iterations() == 2);
    CHECK(distance(result.state, solution) < 1e-12);
    CHECK(result.index == -1);
  }
}

TEST_CASE("forces without a potential: quadratic convergence") {
  Random random(3);
  const int size = 5;
  const Dense A = random_positive(random, size), Z = 2 * random_skew(random, size);
  const Vector solution = random.vector(size);
  const Vector b = (A + Z) * solution + solution.array().cube().matrix();
  const auto result = solved(circulating(A, Z, b, 1), solution + 0.1 * random.vector(size));
  CHECK(result.converged());
  CHECK(result.iterations() <= 5);
  CHECK(distance(result.state, solution) < 1e-13);
  const auto& r = result.record;
  for (std::size_t i = 1; i < r.size(); ++i)
    CHECK(r[i].step <= 3 * r[i - 1].step * r[i - 1].step + 1e-14);
}

TEST_CASE("out of iterations: the last state is kept") {
  Options options;
  options.max_iterations = 3;
  const auto result = solved(rosenbrock(), Vec<2>(-1.2, 1), Hessian::exact, options);
  CHECK(result.status == Status::out_of_iterations);
  CHECK_FALSE(result.converged());
  CHECK(result.iterations() == 3);
  CHECK(result.index == -1);
  CHECK(result.energy == doctest::Approx(rosenbrock().f(result.state)).epsilon(1e-15));
  CHECK(result.energy < rosenbrock().f(Vec<2>(-1.2, 1)));
}

TEST_CASE("a step that does not solve its system does not end a solve") {
  // The pivot 1e-20 loses the second equation: the first step comes out as (0, 1e-9), as small as
  // the last step of a solve, where (−1e-9, 1e-9) is right.
  const Dense A = (Dense(2, 2) << 1e-20, 1, 1, 1).finished();
  const auto result = solved(quadratic(A, Vec<2>(1e-9, 0)), Vec<2>::Zero(), Hessian::exact);
  CHECK(result.converged());
  CHECK(result.iterations() > 1);
  CHECK(result.state[0] == doctest::Approx(-1e-9).epsilon(1e-12));
  CHECK(result.state[1] == doctest::Approx(1e-9).epsilon(1e-12));
}

TEST_CASE("along a direction without stiffness rounding leads nowhere") {
  // ½ x², and a y that nothing holds: what rounding pushes it by is divided by as little.
  double push = 1e-16;
  FlatProblem problem{2, [](const Vector& x) { return 1 + x[0] * x[0] / 2; },
                      [&](const Vector& x) -> Vector { return Vec<2>(x[0], push = -push); },
                      [](const Vector&) -> Dense { return Vec<2>(1, 1e-14).asDiagonal(); }};
  const auto result = solved(problem, Vec<2>(0.3, 0));
  CHECK(result.converged());
  CHECK(result.iterations() <= 5);
  CHECK(std::abs(result.state[0]) < 1e-15);
  CHECK(std::abs(result.state[1]) < 0.02);
}

TEST_CASE("the trace sees every iteration and may stop the solve") {
  int seen = 0;
  const auto stop_at = [&](int limit) {
    return [&seen, limit](const Iteration& i) {
      CHECK(i.step > 0);
      return ++seen < limit;
    };
  };
  const auto full = solved(rosenbrock(), Vec<2>(-1.2, 1), Hessian::exact, {}, stop_at(1000));
  CHECK(full.converged());
  CHECK(seen == full.iterations());

  seen = 0;
  const auto result = solved(rosenbrock(), Vec<2>(-1.2, 1), Hessian::exact, {}, stop_at(2));
  CHECK(result.status == Status::interrupted);
  CHECK(result.iterations() == 2);
  CHECK(result.energy == doctest::Approx(full.record[2].energy).epsilon(1e-15));
  CHECK(result.energy == doctest::Approx(rosenbrock().f(result.state)).epsilon(1e-15));
}

TEST_CASE("numbers that fail") {
  auto broken = quadratic(Dense::Identity(2, 2), Vec<2>(1, 1));
  broken.slope = [](const Vector&) -> Vector { return Vec<2>(std::nan(""), 1); };
  CHECK(solved(broken, Vec<2>(0, 0)).status == Status::not_finite);

  auto undefined = quadratic(Dense::Identity(2, 2), Vec<2>(1, 1));
  undefined.curvature = [](const Vector&) -> Dense { return Dense::Constant(2, 2, std::nan("")); };
  CHECK(solved(undefined, Vec<2>(0, 0)).status == Status::not_finite);

  auto endless = quadratic(Dense::Identity(2, 2), Vec<2>(1, 1));
  endless.f = [](const Vector&) { return std::nan(""); };
  const auto result = solved(endless, Vec<2>(0, 0));
  CHECK_FALSE(result.converged());
  CHECK(distance(result.state, Vec<2>(0, 0)) == 0);
}

TEST_CASE("a step into the undefined is cut") {  // x − log x, from beyond the pole of Newton's map
  const FlatProblem barrier{
      1, [](const Vector& x) { return x[0] - std::log(x[0]); },
      [](const Vector& x) -> Vector { return Vector::Constant(1, 1 - 1 / x[0]); },
      [](const Vector& x) -> Dense { return Dense::Constant(1, 1, 1 / (x[0] * x[0])); }};
  const auto result = solved(barrier, Vector::Constant(1, 2.5), Hessian::convex);
  CHECK(result.converged());
  CHECK(result.state[0] == doctest::Approx(1).epsilon(1e-14));
  CHECK(result.record[0].fraction < 1);
}

TEST_CASE("a slope that lies: the solve stalls and the state stays") {
  auto lying = quadratic(Dense::Identity(2, 2), Vec<2>(1, 1));
  lying.slope = [](const Vector& x) -> Vector { return Vec<2>(1, 1) - x; };
  const auto result = solved(lying, Vec<2>(0.2, 0.3));
  CHECK(result.status == Status::stalled);
  CHECK(distance(result.state, Vec<2>(0.2, 0.3)) == 0);
  CHECK(result.energy == lying.f(result.state));
}

TEST_CASE("one object solves again and again") {
  const auto problem = double_wells(2);
  Newton<FlatProblem> newton(problem);
  CHECK(distance(newton.solve(Vec<2>(0.9, -0.9)).state, Vec<2>(1, -1)) < 1e-8);
  CHECK(distance(newton.solve(Vec<2>(-0.9, -1.2)).state, Vec<2>(-1, -1)) < 1e-8);
}

TEST_CASE("options that make no sense are refused by name") {
  const auto refused = [](int Options::* member, auto value) {
    Options options;
    options.*member = value;
    return refusal([&] { solved(double_wells(1), Vector::Ones(1), Hessian::exact, options); });
  };
  CHECK(refused(&Options::max_iterations, 0) == "max_iterations: must be at least 1, got 0");
  const auto with = [](double Options::* member, double value) {
    Options options;
    options.*member = value;
    return refusal([&] { options.check(); });
  };
  CHECK(with(&Options::tolerance, 0).rfind("tolerance: must lie in (0, 1e-3] rad, got 0") == 0);
  CHECK(with(&Options::tolerance, 0.01).rfind("tolerance:") == 0);
  CHECK(with(&Options::tolerance, std::nan("")).rfind("tolerance:") == 0);
  CHECK(with(&Options::trust, 0).rfind("trust:") == 0);
  CHECK(with(&Options::near, -1).rfind("near:") == 0);
  CHECK(with(&Options::near, 0) == "(not refused)");
  CHECK_NOTHROW(Options().check());
}

TEST_CASE("the list of options is complete and names each by its member") {
  constexpr auto fields = Options::fields();
  CHECK(std::tuple_size_v<decltype(fields)> * sizeof(double) == sizeof(Options));
  CHECK(std::string(std::get<0>(fields).name) == "max_iterations");
  CHECK(std::get<1>(fields).member == &Options::tolerance);
  CHECK(std::string(std::get<1>(fields).name) == "tolerance");
  CHECK(std::get<2>(fields).member == &Options::trust);
  CHECK(std::get<3>(fields).member == &Options::near);
}

TEST_CASE("every status has a name and advice of its own") {
  const Status all[] = {Status::converged, Status::out_of_iterations, Status::stalled,
                        Status::not_finite, Status::interrupted};
  for (const Status a : all) {
    CHECK(name(a) != "unknown");
    CHECK_FALSE(advice(a).empty());
    for (const Status b : all)
      if (a != b) {
        CHECK(name(a) != name(b));
        CHECK(advice(a) != advice(b));
      }
  }
}

TEST_CASE("the last step is taken with the factor of the step before, and is as good") {
  for (const double away : {5e-5, 1e-5, 1e-6, 1e-7}) {
    CAPTURE(away);
    const auto result = solved(double_wells(3), Vec3(1 + away, -1 + away / 2, 1 - away));
    REQUIRE(result.converged());
    REQUIRE(result.iterations() == 2);
    CHECK(result.record[0].factorisations == 1);
    CHECK(result.record[0].step == doctest::Approx(away).epsilon(1e-3));
    CHECK(result.record[1].factorisations == 0);
    CHECK(result.record[1].fraction == 1);
    CHECK(result.record[1].unknowns == 3);
    CHECK(distance(result.state, Vec3(1, -1, 1)) < 1e-15);
    CHECK(result.index == 0);
  }
  // farther away the factor would leave too much
  const auto result = solved(double_wells(1), Vector::Constant(1, 1.01));
  for (const auto& i : result.record)
    if (i.step > Options().tolerance) CHECK(i.factorisations == 1);
  CHECK(distance(result.state, Vector::Ones(1)) < 1e-15);
}

TEST_CASE("what the factor before leaves is made up for, or the step is found anew") {
  // ½ x² + b x³/6: within a short step K changes by much
  for (const double b : {1e2, 1e3, 3e4}) {
    CAPTURE(b);
    const FlatProblem problem{
        1, [=](const Vector& x) { return x[0] * x[0] / 2 + b * x[0] * x[0] * x[0] / 6; },
        [=](const Vector& x) -> Vector { return Vector::Constant(1, x[0] + b * x[0] * x[0] / 2); },
        [=](const Vector& x) -> Dense { return Dense::Constant(1, 1, 1 + b * x[0]); }};
    const auto result = solved(problem, Vector::Constant(1, 1e-5));
    REQUIRE(result.converged());
    const double tolerance = Options().tolerance;  // of whose square the error is to be
    CHECK(std::abs(result.state[0]) <= b * tolerance * tolerance);
  }
}

TEST_CASE("a mode that changes sides within the last steps is counted where the solve ends") {
  // ½ (x − 1)² + ½ (c − x) y²: beyond x = c the stiffness of y is negative
  const auto problem = [](double c) {
    return FlatProblem{
        2,
        [=](const Vector& v) { return (v[0] - 1) * (v[0] - 1) / 2 + (c - v[0]) * v[1] * v[1] / 2; },
        [=](const Vector& v) -> Vector {
          return Vec<2>(v[0] - 1 - v[1] * v[1] / 2, (c - v[0]) * v[1]);
        },
        [=](const Vector& v) -> Dense {
          Mat<2> H;
          H << 1, -v[1], -v[1], c - v[0];
          return H;
        }};
  };
  for (const double c : {1 - 5e-6, 1 + 5e-6}) {  // between the start and the solution, or behind
    const auto result = solved(problem(c), Vec<2>(1 - 1e-5, 0));
    REQUIRE(result.converged());
    CHECK(result.iterations() == 2);
    CHECK(result.index == (c < 1 ? 1 : 0));
  }
}
