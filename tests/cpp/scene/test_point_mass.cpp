// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>

#include <doctest/doctest.h>

using namespace pyrod;

namespace {

const Section bare(1, 1.5, 0.7);

Scene cantilever(std::vector<Load> loads) {
  return Scene(straight(1.0, 8, bare), {Clamp{}}, std::move(loads));
}

}  // namespace

TEST_CASE("a point mass weighs what gravity says") {
  const Vec3 g(1, -0.5, -2);
  for (const Place& at : {Place(End::end), Place(0.5), Place(0.37)}) {
    for (const double tol : {0.0, 1e-6}) {
      Settings settings;
      if (tol > 0) settings.tol = tol;
      const auto ours = solve(cantilever({Gravity{g}, PointMass{.mass = 0.6, .at = at}}), settings);
      const auto theirs = solve(cantilever({Force{.force = 0.6 * g, .at = at}}), settings);
      REQUIRE(ours.converged());
      CHECK((ours.tip() - theirs.tip()).norm() < 1e-13);
    }
  }
}

TEST_CASE("without gravity a point mass does nothing, and no negative one is") {
  const auto still = solve(cantilever({PointMass{.mass = 0.6}}));
  CHECK((still.tip() - Vec3(0, 0, 1)).norm() < 1e-14);
  CHECK_THROWS_AS(solve(cantilever({PointMass{.mass = -1}})), InvalidArgument);
  CHECK_THROWS_AS(solve(cantilever({Gravity{}})), InvalidArgument);
}

TEST_CASE("a solver takes another gravity, and another mass") {
  Solver solver(cantilever({Gravity{{1, 0, 0}}, PointMass{.mass = 0.6}}));
  Changes changes;
  changes.loads = {{0, Gravity{{2, 0, 0}}}};
  const auto heavier = solver.solve(changes);
  const auto expected = solve(cantilever({Force{.force = {1.2, 0, 0}}}));
  CHECK((heavier.tip() - expected.tip()).norm() < 1e-9);
}
