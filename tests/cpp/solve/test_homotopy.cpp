// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/solve/homotopy.hpp>

#include "support/flat_problem.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A double well that moves with λ: from afar the other well is as near.
struct Moving {
  double λ = 0;
  FlatProblem problem(double reach) {
    FlatProblem wells = double_wells(1);
    return {
        1, [this, wells, reach](const Vector& x) { return wells.f(Vector(x.array() - reach * λ)); },
        [this, wells, reach](const Vector& x) {
          return wells.slope(Vector(x.array() - reach * λ));
        },
        [this, wells, reach](const Vector& x) {
          return wells.curvature(Vector(x.array() - reach * λ));
        }};
  }
};

Options few_iterations() {
  Options options;
  options.max_iterations = 4;
  return options;
}

}  // namespace

TEST_CASE("following keeps to the branch it starts on") {
  Moving moving;
  const auto problem = moving.problem(1.9);
  Newton<FlatProblem> newton(problem, few_iterations());
  const auto path =
      follow(newton, [&](double λ, Vector&) { moving.λ = λ; }, Vector::Constant(1, 1.01));
  CHECK(path.result.converged());
  CHECK(moving.λ == 1);
  CHECK(path.result.state[0] == doctest::Approx(2.9).epsilon(1e-12));  // not 0.9, the other well
  CHECK(path.steps > 3);  // 0, 1/4, 3/4 and 1, and what had to be cut
  CHECK(path.result.iterations() >= path.steps);
}

TEST_CASE("a branch that ends is reported, not jumped over") {
  double λ = 0;  // x³/3 − (1/2 − λ) x has a minimum while λ < 1/2
  const FlatProblem fold{
      1, [&](const Vector& x) { return std::pow(x[0], 3) / 3 - (0.5 - λ) * x[0]; },
      [&](const Vector& x) -> Vector { return Vector::Constant(1, x[0] * x[0] - (0.5 - λ)); },
      [&](const Vector& x) -> Dense { return Dense::Constant(1, 1, 2 * x[0]); }};
  Newton<FlatProblem> newton(fold, few_iterations());
  const auto path =
      follow(newton, [&](double part, Vector&) { λ = part; }, Vector::Constant(1, std::sqrt(0.5)));
  CHECK_FALSE(path.result.converged());
  CHECK(λ > 0.45);
  CHECK(λ < 0.51);
}

TEST_CASE("following can be interrupted") {
  Moving moving;
  const auto problem = moving.problem(1.9);
  int seen = 0;
  Newton<FlatProblem> newton(problem, {}, [&](const Iteration&) { return ++seen < 3; });
  const auto path =
      follow(newton, [&](double λ, Vector&) { moving.λ = λ; }, Vector::Constant(1, 1.2));
  CHECK(path.result.status == Status::interrupted);
  CHECK(seen == 3);
}
