// SPDX-License-Identifier: BSD-3-Clause
// Tendons of scenes: an own integration of the equations of tendon robots, and closed forms.
#include <pyrod/scene.hpp>
#include <pyrod/scene/plane.hpp>

#include "support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double length = 0.242, distance_of_tendon = 8e-3;

Section wire() { return Section::circle(0.4e-3, Material(210e9, 0.3125)); }
RodSpec backbone(int edges) { return straight(length, edges, wire(), ModelKind::inextensible); }

FunctionAlong<Vec2> helix() {
  return {[](double s) {
    const double turn = 2 * std::numbers::pi * s / length;
    return Vec2(distance_of_tendon * std::cos(turn), distance_of_tendon * std::sin(turn));
  }};
}

Scene robot(Tendon tendon, std::vector<Load> loads = {}, int edges = 8,
            Dimension space = Dimension::spatial) {
  Scene out(backbone(edges), {Clamp()}, std::move(loads), space);
  out.actuators = {std::move(tendon)};
  return out;
}

}  // namespace

TEST_CASE("tendon robots against their equations, integrated (DOP853, 1e-13)") {
  struct Case {
    Scene scene;
    Vec3 tip;
    double tendon;
  };
  const Force force{Vec3(0.05, 0.1, -0.05)};
  const std::vector<Case> cases{
      {robot({Vec2(distance_of_tendon, 0), 5}),
       {0.7243912255169, 0, 0.3274125453937},
       0.924211931861},
      {robot({helix(), 5}), {0.0008741297130, 0.3513398148400, 0.8611368176250}, 0.944607820516},
      {robot({helix(), 5}, {force}),
       {0.1913552159261, 0.6616541617645, 0.5988276280723},
       0.938550618126}};
  for (const auto& [scene, tip, tendon] : cases) {
    const auto found = solve(scene, {.tol = 1e-10});
    REQUIRE(found.converged());
    CHECK(found.stable());
    CHECK(distance(Vec3(found.tip() / length), tip) < 3e-11);
    CHECK(std::abs(found.tendons()[0].length / length - tendon) < 1e-11);
    CHECK(found.accuracy->reached.regular);
    const auto [forces, moments] = found.balance();
    CHECK(forces < 1e-12);
    CHECK(moments < 1e-9);
  }
}

TEST_CASE("a parallel tendon makes an exact arc, whatever the grid") {
  const double curvature = 5 * distance_of_tendon / wire().EI2;
  for (const int edges : {1, 5, 32})
    for (const auto space : {Dimension::planar, Dimension::spatial}) {
      const auto found = solve(robot({Vec2(distance_of_tendon, 0), 5}, {}, edges, space));
      for (const auto& K : found.rod().strains.K)
        CHECK(distance(K, Vec3(0, curvature, 0)) < 1e-12 * curvature);
      const double arc = length * (1 - curvature * distance_of_tendon);
      CHECK(found.tendons()[0].length == doctest::Approx(arc).epsilon(1e-14));
    }
}

TEST_CASE("given length and given tension are two sides of one shape") {
  const Force force{Vec3(0.05, 0.1, -0.05)};
  const auto pulled = solve(robot({helix(), 5}, {force}));
  Tendon held{helix()};
  held.length = pulled.tendons()[0].length;
  const auto found = solve(robot(held, {force}));
  CHECK(found.converged());
  CHECK(found.index() == 0);
  CHECK(found.course.multipliers == 1);
  CHECK(found.tendons()[0].tension == doctest::Approx(5).epsilon(1e-11));
  CHECK(distance(found.tip(), pulled.tip()) < 1e-13);
  held.length = 1.1 * length;
  const auto slack = solve(robot(held, {force}));
  CHECK(slack.tendons()[0].slack);
  CHECK(slack.tendons()[0].tension == 0);
  CHECK(distance(slack.tip(), solve(Scene(backbone(8), {Clamp()}, {force})).tip()) < 1e-13);
}

TEST_CASE("tendons change like other parts of a scene") {
  Solver solver(robot({Vec2(distance_of_tendon, 0), 1}));
  solver.solve();
  Changes changes;
  changes.actuators.emplace_back(0, Tendon{Vec2(distance_of_tendon, 0), 5});
  const auto found = solver.solve(changes);
  CHECK(distance(found.tip(), solve(robot({Vec2(distance_of_tendon, 0), 5})).tip()) < 1e-13);
  Changes supports;
  supports.supports.emplace_back(0, Clamp{Vec3(1, 2, 3)});
  CHECK(distance(solver.solve(supports).tip(), Vec3(found.tip() + Vec3(1, 2, 3))) < 1e-12);
}

TEST_CASE("what is no tendon is refused") {
  const auto refused = [](Tendon tendon) {
    CHECK_THROWS_AS(solve(robot(std::move(tendon))), InvalidArgument);
  };
  refused({Vec2(0.1, 0), 0.});
  refused({Vec2(0.1, 0), -1.});
  refused({Vec2(0.1, 0)});
  refused({.offset = Vec2(0.1, 0), .tension = 1, .length = 1});
  refused({.offset = Vec2(0.1, 0), .tension = 1, .start = 0.2, .end = 0.1});
  refused({.offset = Vec2(0.1, 0), .tension = 1, .end = 0.3});
  refused({.offset = Vec2(0.1, 0), .tension = 1, .rod = 1});
  refused({std::vector<Vec2>(3, Vec2(0.1, 0)), 1});
  Scene stretching(straight(length, 8, wire()), {Clamp()});
  stretching.actuators = {Tendon{Vec2(0.1, 0), 1}};
  CHECK_THROWS_AS(solve(stretching), InvalidArgument);
  CHECK_THROWS_AS(solve(robot({Vec2(0, 0.1), 1}, {}, 8, Dimension::planar)), InvalidArgument);
}
