// SPDX-License-Identifier: BSD-3-Clause
// A solver whose scene gets other parts, and shapes that are told when they are asked for.
#include <doctest/doctest.h>

#include <pyrod/scene.hpp>

#include <algorithm>
#include <cmath>
#include <thread>
#include <vector>

using namespace pyrod;

namespace {

const Section soft(1, 1.5, 0.7);

Force tip_force(double x, bool follower = false) {
  return {.force = {x, 0.5, 0}, .follower = follower};
}

/// Clamped at its start; `held`: and pinned at its end.
Scene rod(double force, bool held = false, Dimension space = Dimension::spatial) {
  std::vector<Support> supports{Clamp{}};
  if (held) supports.push_back(Hinge{.position = Vec3(0.2, 0, 0.85), .at = End::end});
  Force load{.force = {force, space == Dimension::spatial ? 0.5 : 0, 0}, .at = held ? 0.5 : 1.0};
  return Scene(precurved(1.0, 20, soft, Vec3(0, 0.7, 0)), std::move(supports), {load}, space);
}

double apart(const Equilibrium& a, const Equilibrium& b) {
  double most = (a.reactions()[0].force - b.reactions()[0].force).norm();
  for (std::size_t i = 0; i < a.rods().size(); ++i)
    for (std::size_t j = 0; j < a.rod(int(i)).curve.positions.size(); ++j)
      most = std::max(most,
                      (a.rod(int(i)).curve.positions[j] - b.rod(int(i)).curve.positions[j]).norm());
  return most;
}

Changes with_load(std::size_t i, Load load) { return {.loads = {{i, std::move(load)}}}; }

}  // namespace

TEST_CASE("other loads lead to the shape that they have in a new scene") {
  for (const auto space : {Dimension::planar, Dimension::spatial})
    for (const bool held : {false, true}) {
      Solver solver(rod(1, held, space));
      for (int k = 0; k < 5; ++k) {
        const auto scene = rod(1 + 0.2 * k, held, space);
        const auto found = solver.solve(with_load(0, scene.loads[0]));
        REQUIRE(found.converged());
        CHECK(apart(found, solve(scene)) < 1e-9);
        CHECK(std::get<Force>(solver.scene().loads[0]).force ==
              std::get<Force>(scene.loads[0]).force);
      }
    }
}

TEST_CASE("parts of all kinds may change by turns, and together") {
  Solver solver(rod(1, true));
  auto scene = rod(1, true);
  const Support higher = Hinge{.position = Vec3(0.2, 0.1, 0.8), .at = End::end};
  const auto stiffer = precurved(1.0, 20, Section(2, 2, 1), Vec3(0, 0.6, 0));
  const Load along = DistributedForce{Vec3(0, 0.3, 0)}, moved = Force{{2, 0, 0}, 0.25},
             pushed = Moment{{0, 0, 0.1}, 0.5};
  const std::vector<Changes> all{{.supports = {{1, higher}}},
                                 with_load(0, along),
                                 {.rods = {{0, stiffer}}, .loads = {{0, moved}}},
                                 with_load(0, pushed),
                                 with_load(0, Moment{{0, 0, 0.2}, 0.5}),
                                 with_load(0, scene.loads[0]),
                                 {}};
  for (const auto& changes : all) {
    changes.apply(scene);
    CHECK(apart(solver.solve(changes), solve(scene)) < 1e-9);
  }
}

TEST_CASE("supports that move hold what they hold where they are now") {
  const auto scene = [](double t) {
    const Quaternion turned(std::cos(t / 2), std::sin(t / 2), 0, 0);
    return Scene(precurved(1.0, 20, soft, Vec3(0, 0.7, 0)),
                 {Clamp{.position = Vec3(t, 0, 0), .frame = turned},
                  Sleeve{.position = Vec3(0.2, 0.1 * t, 0.8), .frame = turned, .at = 0.8},
                  Spring{.stiffness = 2, .position = Vec3(0.3, t, 0.9), .at = End::end}},
                 {Force{{0, 1, 0}, 0.5}});
  };
  Solver solver(scene(0));
  for (const double t : {0., 0.05, 0.1, 0.15}) {
    const auto now = scene(t);
    const auto only_clamp = solver.solve({.supports = {{0, now.supports[0]}}});
    auto half = solver.scene();
    CHECK(apart(only_clamp, solve(half)) < 1e-9);
    const auto found = solver.solve({.supports = {{1, now.supports[1]}, {2, now.supports[2]}}});
    CHECK(apart(found, solve(now)) < 1e-9);
  }
  const Support far = Clamp{.position = Vec3(0, 0, -1), .at = End::start};
  Solver taut(
      Scene(straight(1.0, 8, soft), {Clamp{}, Hinge{.position = Vec3(0, 0, 0.9), .at = End::end}}));
  CHECK_THROWS_AS(taut.solve({.supports = {{0, far}}}), InvalidArgument);
  CHECK_THROWS_AS(
      taut.solve({.supports = {{1, Hinge{.position = Vec3(0, NAN, 0.9), .at = End::end}}}}),
      InvalidArgument);
  CHECK(taut.solve(Changes{}).converged());
}

TEST_CASE("whatever holds after whatever, forces that the loads tell are not those of before") {
  const Quaternion turned(std::cos(0.2), 0, std::sin(0.2), 0);
  const Vec3 at(0.1, 0, 0.9);
  const std::vector<Support> kinds{
      Hinge{.position = at, .at = End::end},
      Slider{.along = Vec3(0, 0, 1), .position = at, .at = End::end},
      Slider{.along = Vec3(1, 0, 0), .position = at, .at = End::end},
      Slider{.normal = Vec3(1, 0, 1), .position = at, .at = End::end},
      Sleeve{.position = at, .frame = turned, .at = End::end},
      Sleeve{.position = at, .frame = Quaternion::Identity(), .at = End::end},
      Spring{.stiffness = 5, .position = at, .at = End::end},
      Spring{.stiffness = 0, .torsion = 1, .position = at, .at = End::end},
      Clamp{.position = at, .frame = turned, .at = End::end}};
  const auto scene = [&](const Support& end, Dimension space) {
    return Scene(precurved(1.0, 12, Section(1, 1.2, 0.8), Vec3(0, 0.5, 0)),
                 {Clamp{.position = Vec3(0, 0, 0), .frame = Quaternion::Identity()}, end},
                 {Force{{0.3, space == Dimension::spatial ? 0.2 : 0, -0.5}, 0.5}}, space);
  };
  for (const auto space : {Dimension::planar, Dimension::spatial})
    for (const auto& before : kinds)
      for (const auto& after : kinds) {
        Solver solver(scene(before, space));
        solver.solve(Changes{});
        const auto found = solver.solve({.supports = {{1, after}}});
        REQUIRE(found.converged());
        CHECK(found.balance().first < 1e-9);
        CHECK(found.balance().second < 1e-9);
        CHECK(found.stable());
        // which of several shapes is found depends on what was before
        CHECK(apart(found, solve(scene(after, space), {.start = &found})) < 1e-7);
      }
}

TEST_CASE("supports that hold a rod only together hold it") {
  const auto bent = precurved(1.0, 12, soft, Vec3(0, 1, 0));
  for (const auto space : {Dimension::planar, Dimension::spatial}) {
    const auto found =
        solve(Scene(bent, {Sleeve{}, Sleeve{.at = End::end}}, {Force{{0.5, 0, 0.1}, 0.6}}, space));
    REQUIRE(found.converged());
    CHECK(found.balance().first < 1e-9);
    CHECK(found.balance().second < 1e-9);
    const auto rest = solve(Scene(bent, {Clamp{}}, {}, space));
    const Vec3 axis = rotate(rest.tip_frame(), Vec3::UnitZ());
    CHECK(found.rod().curve.positions[0].head<2>().norm() < 1e-9);
    CHECK((found.tip() - rest.tip()).cross(axis).norm() < 1e-9);
    CHECK((found.tip() - found.rod().curve.positions[0]).norm() > 0.5);
  }
}

TEST_CASE("loads that are refused change nothing, nor does a part that there is not") {
  Solver solver(rod(1));
  const auto before = solver.solve(Changes{});
  CHECK_THROWS_AS(solver.solve(with_load(0, Force{{1, NAN, 0}})), InvalidArgument);
  CHECK_THROWS_AS(solver.solve(with_load(1, Force{{1, 0, 0}})), InvalidArgument);
  CHECK_THROWS_AS(solver.solve(with_load(0, Gravity{})), InvalidArgument);  // nothing is heavy
  CHECK(apart(before, solver.solve(Changes{})) < 1e-12);
  CHECK(apart(before, solver.solve(with_load(0, Force{{1, 0.5, 0}}))) < 1e-12);
  Solver flat(rod(1, false, Dimension::planar));
  for (int time = 0; time < 2; ++time) {
    CHECK_THROWS_AS(flat.solve(with_load(0, Force{{1, 1, 0}})), InvalidArgument);
    CHECK(flat.solve(with_load(0, Force{{1, 0, 0}})).converged());
  }
}

TEST_CASE("parts that nothing holds along some direction feel what their loads add up to") {
  const Scene sliding(straight(1.0, 12, soft), {Slider{.along = Vec3(0, 0, 1), .clamped = true}},
                      {Force{{1, 0, 0}, 0.5}});
  Solver solver(sliding);
  CHECK(solver.solve(with_load(0, Force{{2, 0, 0}, 0.5})).converged());
  CHECK_THROWS_AS(solver.solve(with_load(0, Force{{2, 0, 1}, 0.5})), InvalidArgument);
  CHECK(solver.solve(with_load(0, Force{{1, 0, 0}, 0.5})).converged());
}

TEST_CASE("a network goes on from its own solution without a step to find its forces") {
  const auto second =
      straight(1.0, 10, Section(1, 1, 0.7, 1e3, 1e3, 1e3))
          .placed({Vec3(0, 0, 1), Quaternion(std::sqrt(0.5), 0, std::sqrt(0.5), 0)});
  Scene frame({straight(1.0, 10, Section(1, 1, 0.7, 1e3, 1e3, 1e3)), second},
              {Clamp{}, Clamp{.at = {1, End::end}}}, {Force{{0, 1, -3}, {1, 0.5}}},
              Dimension::spatial, {{{{0, End::end}, {1, End::start}}, JointKind::rigid}});
  Solver solver(frame);
  const auto first = solver.solve(Changes{});
  const auto again = solver.solve(Changes{});
  CHECK(first.course.record.size() > 2);
  CHECK(again.course.record.size() == 1);
  CHECK(apart(first, again) < 1e-12);
}

TEST_CASE("shapes that were not asked for yet are those of their own solves") {
  Solver solver(rod(0));
  std::vector<Equilibrium> found;
  for (int k = 0; k < 4; ++k) found.push_back(solver.solve(with_load(0, tip_force(k))));
  for (int k = 0; k < 4; ++k) found.push_back(solver.solve(rod(k, true)));
  for (int k = 0; k < 4; ++k) {
    auto scene = rod(0);
    scene.loads[0] = tip_force(k);
    CHECK(apart(found[std::size_t(k)], solve(scene)) < 1e-9);
    CHECK(apart(found[std::size_t(4 + k)], solve(rod(k, true))) < 1e-9);
  }
}

TEST_CASE("a shape is told to several threads, and outlives its solver") {
  std::vector<double> tips(4);
  const auto found = [] {
    Solver solver(rod(2));
    return solver.solve(with_load(0, tip_force(1)));
  }();
  std::vector<std::thread> threads;
  for (auto& tip : tips) threads.emplace_back([&] { tip = found.tip().x(); });
  for (auto& thread : threads) thread.join();
  for (const double tip : tips) CHECK(tip == tips[0]);
  CHECK_THROWS_AS(Equilibrium().tip(), InvalidArgument);
}

TEST_CASE("strains beyond what they mean are told without the shape being asked for") {
  const Section rubber(1, 1, 1, 10, 10, 10);
  const auto doubts = [](const RodSpec& rod, const Vec3& F, const Vec3& M = Vec3::Zero()) {
    return solve(Scene(rod, {Clamp{}}, {Force{F}, Moment{M}})).doubts;
  };
  CHECK(doubts(straight(1.0, 8, rubber), {0, 0, 29}).empty());
  CHECK(doubts(straight(1.0, 8, rubber), {0, 0, 31}).size() == 1);  // stretched to four times
  CHECK(doubts(straight(1.0, 8, soft), {0, 0, 0}, {0, 24, 0}).empty());
  CHECK(doubts(straight(1.0, 8, soft), {0, 0, 0}, {0, 40, 0}).size() == 1);  // over π a cell
}
