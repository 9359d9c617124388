// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>
#include <pyrod/scene/rod_on_grid.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace pyrod;

namespace {

const Section soft(1, 1.5, 0.7);

bool same(const Equilibrium& a, const Equilibrium& b) {
  return a.rod().curve.positions == b.rod().curve.positions && a.rod().moment == b.rod().moment;
}

Scene held() {
  return Scene(precurved(1.0, automatic, soft, [](double s) { return Vec3(0, s, 0); }),
               {Clamp{}, Hinge{.position = Vec3(0.2, 0, 0.8), .at = End::end}},
               {Force{.force = {0, 1, 0}, .at = 0.37}});
}

}  // namespace

TEST_CASE("a solver gives the same bits again, alone, copied and on several threads") {
  const Solver solver(held());
  const auto first = solver.solve({.tol = 1e-7});
  REQUIRE(first.converged());
  CHECK(same(first, solve(held(), {.tol = 1e-7})));
  CHECK(same(first, Solver(solver).solve({.tol = 1e-7})));
  std::vector<Equilibrium> found(3);
  std::vector<std::thread> threads;
  for (auto& one : found) threads.emplace_back([&] { one = solver.solve({.tol = 1e-7}); });
  for (auto& thread : threads) thread.join();
  for (const auto& one : found) CHECK(same(first, one));
}

TEST_CASE("functions are searched once for all solves of a solver, and of scenes that share them") {
  int asked = 0;
  const auto stiffness = [&asked](double s) {
    ++asked;
    return Section(1, 1 + std::abs(s - 0.377), 1);
  };
  const auto rod = straight(1.0, automatic, stiffness);
  std::array<int, 2> counts{};
  for (int& count : counts) {
    asked = 0;
    solve(Scene(rod, {Clamp{}}, {Force{.force = {1, 0, 0}}}), {.tol = 1e-3});
    count = asked;
  }
  CHECK(counts[1] < counts[0] - 256);
}

TEST_CASE("a climb tells its grids") {
  std::vector<SoFar> told;
  Settings settings{.tol = 1e-7};
  settings.progress = [&](const SoFar& so_far) { told.push_back(so_far); };
  const auto found = solve(held(), settings);
  REQUIRE(found.converged());
  REQUIRE(told.size() + 1 >= std::size_t(found.accuracy->reached.levels));
  for (std::size_t i = 1; i < told.size(); ++i) {
    CHECK(told[i].grids == told[i - 1].grids + 1);
    CHECK(told[i].edges == 2 * told[i - 1].edges);
  }
}

TEST_CASE("a rod by arrays is the rod that has them, on every grid") {
  const auto spec = straight(1.0, 4, std::vector{soft, soft, Section(4, 4, 4), Section(4, 4, 4)});
  const auto made = made_on_grid(spec);
  RodArrays arrays{made.rod.bending, made.rod.stretching, made.mass, made.rod.jumps};
  const auto given = discrete(spec.edge_lengths, arrays, made.rod.K0, ModelKind::inextensible);
  for (const int parts : {1, 2, 8}) {
    const auto one = on_grid(spec, parts).rod, other = on_grid(given, parts).rod;
    REQUIRE(other.jumps.size() == 1);
    CHECK(other.jumps[0].vertex == 2 * parts);
    for (int j = 0; j <= one.edges(); ++j)
      CHECK((one.bending[std::size_t(j)] - other.bending[std::size_t(j)]).norm() < 1e-14);
  }
  const Force tip{.force = {0.5, 0, 0}};
  const auto a = solve(Scene(spec, {Clamp{}}, {tip}), {.tol = 1e-9});
  const auto b = solve(Scene(given, {Clamp{}}, {tip}), {.tol = 1e-9});
  CHECK((a.tip() - b.tip()).norm() < 1e-9);
  arrays.bending.pop_back();
  CHECK_THROWS_WITH_AS(discrete(spec.edge_lengths, arrays, made.rod.K0, ModelKind::inextensible),
                       "bending: expected 5 rows (one per vertex), got 4", InvalidArgument);
}

TEST_CASE("lists of loads belong to the rod as it was given, or to that with its vertices") {
  const auto rod = straight(1.0, 10, soft);
  const std::vector<Support> supports{Clamp{}, Spring{.stiffness = 3, .at = 0.55}};
  std::vector<Vec3> given, cut;
  for (int j = 0; j < 10; ++j) given.emplace_back(0.1 * j, 0, 0);
  for (int j = 0; j < 11; ++j) cut.push_back(given[std::size_t(j <= 5 ? j : j - 1)]);
  const auto tip = [&](const std::vector<Vec3>& list) {
    return solve(Scene(rod, supports, {DistributedForce{list}})).tip();
  };
  CHECK((tip(given) - tip(cut)).norm() < 1e-14);
  CHECK_THROWS_AS(tip(std::vector<Vec3>(9, Vec3::Zero())), InvalidArgument);
}

namespace {

/// A clamped, precurved rod under its weight and a force at its end.
Scene catheter(const Vec3& force, const Vec3& base = Vec3::Zero(), bool follower = false) {
  const Section heavy(1, 1.5, 0.7, Section::rigid, Section::rigid, Section::rigid, 0.1);
  return Scene(precurved(1.0, 24, heavy, Vec3(0.5, 1, 0)), {Clamp{.position = base}},
               {Gravity{}, Force{.force = force, .follower = follower}});
}

/// The same, and held at its end.
Scene held_at_both_ends(double height, const Vec3& K0 = Vec3(0, 1, 0)) {
  return Scene(precurved(1.0, 24, soft, K0),
               {Clamp{.position = Vec3(0, 0, 0)},
                Hinge{.position = Vec3(0.1, 0.05, height), .at = End::end}},
               {Force{.force = {0, 1, 0}, .at = 0.5}});
}

double apart(const Equilibrium& a, const Equilibrium& b) {
  double most = 0;
  for (std::size_t j = 0; j < a.rod().curve.positions.size(); ++j)
    most = std::max(most, (a.rod().curve.positions[j] - b.rod().curve.positions[j]).norm());
  return most;
}

}  // namespace

TEST_CASE("a solver goes on with other numbers, in fewer iterations, to the same shape") {
  Solver solver(catheter({0, 0, 0}));
  for (const bool follower : {false, true})
    for (int k = 1; k <= 4; ++k) {
      const double F = 3 + 0.01 * k;
      const auto scene = catheter({F, -F, 0.5 * F}, {0, 0, 0.1 * k}, follower);
      const auto afresh = solve(scene), again = solver.solve(scene);
      REQUIRE(again.converged());
      CHECK(apart(afresh, again) < 1e-11);
      CHECK((afresh.reactions()[0].moment - again.reactions()[0].moment).norm() < 1e-9);
      if (k > 1) CHECK(again.course.record.size() < afresh.course.record.size());
    }
}

TEST_CASE("supports, curvature at rest and stiffness may change between solves") {
  Solver solver(held_at_both_ends(0.9));
  for (const double height : {0.9, 0.88, 0.86})
    for (const double K : {1., 1.1}) {
      const auto scene = held_at_both_ends(height, Vec3(0, K, 0));
      const auto again = solver.solve(scene);
      REQUIRE(again.converged());
      CHECK((again.tip() - Vec3(0.1, 0.05, height)).norm() < 1e-12);
      CHECK(apart(solve(scene), again) < 1e-9);
    }
  auto stiffer = held_at_both_ends(0.86);
  stiffer.rods[0].section = Section(2, 3, 1.4);
  CHECK(apart(solve(stiffer), solver.solve(stiffer)) < 1e-9);
}

TEST_CASE("a solver takes scenes of another shape, too, and starts those afresh") {
  Solver solver(catheter({0, 0, 0}));
  CHECK(solver.solve(catheter({1, 0, 0})).converged());
  CHECK(apart(solver.solve(held_at_both_ends(0.9)), solve(held_at_both_ends(0.9))) < 1e-9);
  const Scene finer(straight(1.0, 40, soft), {Clamp{}}, {Force{.force = {1, 0, 0}}});
  CHECK(apart(solver.solve(finer), solve(finer)) < 1e-12);
  const Scene flat(straight(1.0, 40, soft), {Clamp{}}, {Force{.force = {1.1, 0, 0}}},
                   Dimension::planar);
  CHECK(apart(solver.solve(flat), solve(flat)) < 1e-11);
  const auto climbed = solver.solve(flat, {.tol = 1e-6});
  CHECK(climbed.accuracy.has_value());
  CHECK(apart(climbed, solve(flat, {.tol = 1e-6})) < 1e-9);
}

TEST_CASE("also one that is refused only when it is solved") {
  const Scene flat(straight(1.0, 12, soft), {Clamp{}}, {Force{.force = {1, 0, 0}}},
                   Dimension::planar);
  auto leaving = flat;
  std::get<Force>(leaving.loads[0]).force.y() = 1;
  Solver solver(flat);
  const Solver copy = solver;
  for (int time = 0; time < 2; ++time) {
    CHECK_THROWS_AS(solver.solve(leaving), InvalidArgument);
    CHECK(apart(solver.solve(solver.scene()), copy.solve()) < 1e-13);
  }
}

TEST_CASE("full turns that are put in are no matter of the last shape") {
  const auto twisted = [](int turns) {
    return Scene(straight(1.0, 24, soft),
                 {Clamp{.position = Vec3(0, 0, 0)}, Clamp{.position = Vec3(0, 0, 0.9),
                                                          .frame = Quaternion::Identity(),
                                                          .at = End::end,
                                                          .turns = turns}},
                 {Force{.force = {0.3, 0.1, 0}, .at = 0.5}});
  };
  Solver solver(twisted(0));
  for (const int turns : {0, 1, 2, 0}) {
    const auto found = solver.solve(twisted(turns));
    REQUIRE(found.converged());
    CHECK(found.energy() == doctest::Approx(solve(twisted(turns)).energy()));
  }
}

TEST_CASE("the space of a scene may change") {
  const auto pulled = [](double across, Dimension space) {
    return Scene(straight(1.0, 12, soft), {Clamp{}}, {Force{.force = {1, across, 0}}}, space);
  };
  const auto flat = pulled(0, Dimension::planar), out_of_plane = pulled(1, Dimension::spatial);
  Solver solver(flat);
  for (const auto& scene : {flat, flat, out_of_plane, out_of_plane, flat, flat, out_of_plane})
    CHECK(apart(solver.solve(scene), solve(scene)) < 1e-11);
}

TEST_CASE("what a function throws changes nothing") {
  int calls = 0;
  auto scene = catheter({1, 0, 0});
  Solver solver(scene);
  const auto before = solver.solve(scene, {.tol = 1e-6});
  auto failing = catheter({2, 0, 0});
  failing.loads.push_back(DistributedForce{[&](double) {
    if (++calls > 30) throw std::runtime_error("no more");
    return Vec3(1, 0, 0);
  }});
  CHECK_THROWS_AS(solver.solve(failing, {.tol = 1e-6}), std::runtime_error);
  CHECK(apart(before, solver.solve({.tol = 1e-6})) < 1e-9);
}

TEST_CASE("also where the scene of before could not be made again") {
  bool broken = false;
  auto scene = catheter({1, 0, 0});
  scene.loads.push_back(DistributedForce{[&](double) {
    if (broken) throw std::runtime_error("no more");
    return Vec3(1, 0, 0);
  }});
  Solver solver(scene);
  const auto before = solver.solve(scene);
  broken = true;
  CHECK_THROWS_AS(solver.solve(scene), std::runtime_error);
  CHECK(apart(before, solver.solve()) < 1e-12);  // what it has of it is there
  CHECK(solver.solve(catheter({2, 0, 0})).converged());
}

TEST_CASE("followers are refused where nothing holds against them, however small they are") {
  const auto held_across = [](double F) {
    return Scene(
        precurved(1.0, 12, soft, Vec3(0, 1, 0)),
        {Clamp{.at = 0.4}, Slider{.along = Vec3(0, 0, 1), .clamped = true, .at = End::end}},
        {Force{.force = {F, 0, 0}, .at = End::start, .follower = true}});
  };
  CHECK(solve(held_across(0)).converged());
  Scene drifting(straight(1.0, 12, soft),
                 {Slider{.along = Vec3(0, 0, 1), .clamped = true, .at = End::start}},
                 {Force{.force = {0, 0, 1e-8}, .follower = true}});
  CHECK_THROWS_AS(solve(drifting), InvalidArgument);
}

TEST_CASE("a solver with a tolerance goes on from its own grid") {
  Solver solver(held());
  const auto first = solver.solve(held(), {.tol = 1e-6}),
             again = solver.solve(held(), {.tol = 1e-6});
  REQUIRE(again.converged());
  CHECK(apart(first, again) < 1e-7);
  CHECK(again.course.record.size() < first.course.record.size());
}

TEST_CASE("a scene that is refused changes nothing, and copies of a solver keep what they have") {
  Solver solver(catheter({1, 0, 0}));
  const auto before = solver.solve(catheter({1, 0, 0}));
  const Solver copy = solver;
  auto bad = catheter({2, 0, 0});
  bad.loads.push_back(Force{.force = {1, 0, 0}, .at = 1.5});
  CHECK_THROWS_AS(solver.solve(bad), InvalidArgument);
  CHECK(apart(before, solver.solve()) < 1e-12);
  for (const double F : {2, 3, 2})  // it changes by turns what it has of two scenes
    CHECK(solver.solve(catheter({F, 0, 0})).converged());
  CHECK(apart(before, copy.solve()) < 1e-12);
  CHECK(apart(before, solver.solve()) > 1e-2);
}
