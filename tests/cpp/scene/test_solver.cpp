// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>

#include <doctest/doctest.h>

#include <thread>

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
