// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>
#include <pyrod/scene/scene_breaks.hpp>

#include <doctest/doctest.h>

using namespace pyrod;

namespace {

constexpr double at = 0.4321;  // grids of 16, 32 and 64 edges see what is here at 0.4375
const Section round_one(1, 1, 0.7), thick(2, 3, 1);

Equilibrium bent(const RodSpec& rod, double force, double tol) {
  const Scene scene(rod, {Clamp{}}, {Force{{force, 0, 0}}}, Dimension::planar);
  auto found = solve(scene, {.tol = tol});
  CHECK(found.converged());
  CHECK(found.doubts.empty());
  return found;
}

/// No true error is above the one that is told; the references are good to 1e-12.
void agrees(const Equilibrium& found, const Vec3& tip, double moment, double tol) {
  CHECK(found.accuracy->reached.regular);
  CHECK(found.accuracy->largest() <= tol);
  CHECK((found.tip() - tip).norm() <= found.accuracy->error(Quantity::positions) + 2e-12);
  CHECK(std::abs(found.rod().moment[0].y() - moment) / moment <=
        found.accuracy->error(Quantity::moments) + 2e-12);
}

double off(const Equilibrium& found, double place) {
  double nearest = 1;
  for (const double s : found.shape().made[0].grid.arc_lengths())
    nearest = std::min(nearest, std::abs(s - place));
  return nearest;
}

RodSpec seen(RodSpec rod, const std::vector<Load>& loads = {}) {
  Scene scene(std::move(rod), {Clamp{}}, loads);
  add_vertices_at_breaks(scene, loads);
  return scene.rods[0];
}

}  // namespace

// The numbers are those of tests/python/shared/independent.py: the elastica by DOP853, piece by
// piece.
TEST_CASE("a stiffness from a table, whose kink used to spoil errors of 6e-7 told as 5e-9") {
  const auto section = [](double s) {
    const double EI = s < 0.179 ? 1 + 3 * s / 0.179 : 4 - 3 * (s - 0.179) / (1 - 0.179);
    return Section(1, EI, 1);
  };
  for (const std::optional<int> edges :
       {std::optional<int>(), std::optional(10), std::optional(16)})
    for (const double tol : {1e-6, 1e-9}) {
      const auto found = bent(straight(1.0, edges, section), 10, tol);
      agrees(found, {0.683960079334267, 0, 0.673740642443253}, 6.73740642443252, tol);
      CHECK(off(found, 0.179) < 1e-9);
    }
}

TEST_CASE("a section that jumps, and a curvature at rest that has a kink") {
  const auto section = [](double s) { return s < at ? Section(1, 1, 1) : Section(1, 3, 1); };
  const auto curvature = [](double s) { return Vec3(0, 2 * std::abs(s - at), 0); };
  for (const double tol : {1e-4, 1e-9}) {
    const auto stepped = bent(straight(1.0, automatic, section), 10, tol);
    agrees(stepped, {0.814324071166985, 0, 0.458524084446351}, 4.5852408444635, tol);
    CHECK(off(stepped, at) < 1e-14);
    const auto curved = bent(precurved(1.0, automatic, round_one, curvature), 3, tol);
    agrees(curved, {0.672349673047948, 0, 0.661690966910178}, 1.98507290073053, tol);
    CHECK(off(curved, at) < 1e-9);
  }
}

TEST_CASE("a load with a step: its vertex, and all of its force") {
  const DistributedForce step{[](double s) { return Vec3(s > at ? 5 : 0, 0, 0); }};
  const auto marked = with_vertices(straight(1.0, automatic, round_one), {at});
  const auto exact = solve(Scene(marked, {Clamp{}}, {step}), {.tol = 1e-11});
  for (const std::optional<int> edges : {std::optional<int>(), std::optional(16)})
    for (const double tol : {1e-4, 1e-9}) {
      const auto found =
          solve(Scene(straight(1.0, edges, round_one), {Clamp{}}, {step}), {.tol = tol});
      CHECK(found.doubts.empty());
      CHECK(off(found, at) < 1e-12);
      CHECK((found.tip() - exact.tip()).norm() <= found.accuracy->error(Quantity::positions) +
                                                      exact.accuracy->error(Quantity::positions));
      CHECK((found.reactions()[0].force - Vec3(-5 * (1 - at), 0, 0)).norm() < 1e-9);
    }
}

TEST_CASE("loads on the second rod, and moments along a rod") {
  const auto first = straight(1.0, 8, round_one);
  const auto other = first.placed({{0, 0, 1}, Quaternion::Identity()});
  const DistributedMoment moment{[](double s) { return Vec3(0, s < at ? 1 : 0, 0); }, 1};
  const Scene scene({first, other}, {Clamp{}}, {moment}, Dimension::spatial,
                    {Joint{{Place(0, End::end), Place(1, End::start)}}});
  const auto found = solve(scene, {.tol = 1e-6});
  CHECK(found.doubts.empty());
  CHECK(found.shape().made[0].edges() == 8);
  CHECK(found.shape().made[1].edges() == 9);
  CHECK(found.shape().made[1].grid.s(4) == doctest::Approx(at).epsilon(1e-14));
  CHECK((found.reactions()[0].moment - Vec3(0, -at, 0)).norm() < 1e-9);
}

TEST_CASE("breaks beside vertices that are there are these") {
  const auto stepped = [](double s) { return s < 0.1 * 3 ? round_one : thick; };
  const Along<Vec3> curvature = [](double s) { return Vec3(0, s > 0.3 ? 1 : 0, 0); };
  const DistributedForce load{[](double s) { return Vec3(s > 0.3, 0, 0); }};
  for (const std::optional<int> edges : {std::optional<int>(), std::optional(16)}) {
    const auto rod = with_vertices(precurved(1.0, edges, stepped, curvature), {0.3});
    const auto cut = seen(rod, {load});
    CHECK(cut.edges() == rod.edges());
    CHECK(cut.edge_lengths.minCoeff() > 0.01);
  }
  const auto at_edge =
      seen(straight(1.0, 16, [](double s) { return s < 0.5 ? round_one : thick; }));
  CHECK(at_edge.edges() == 16);
  CHECK(on_grid(at_edge).rod.jumps.size() == 1);
  CHECK(on_grid(at_edge).rod.jumps[0].vertex == 8);
}

TEST_CASE(
    "sections and curvatures that jump have cells of two halves; smooth ones keep their grid") {
  for (const auto& rod :
       {straight(1.0, 16, [](double s) { return s < at ? round_one : thick; }),
        precurved(1.0, 16, round_one, [](double s) { return Vec3(0, s < at ? 1 : 0, 0); })}) {
    const auto made = on_grid(seen(rod)).rod;
    CHECK(made.edges() == 17);
    REQUIRE(made.jumps.size() == 1);
    CHECK(made.grid.s(made.jumps[0].vertex) == doctest::Approx(at).epsilon(1e-14));
  }
  const DistributedForce steep{[](double s) { return Vec3(std::tanh((s - at) / 2e-3), 0, 0); }};
  CHECK(seen(straight(1.0, automatic, round_one), {steep}).edges() == 16);
}

TEST_CASE("what has more breaks than can be told apart is doubted") {
  const auto noisy = [](double amplitude) {
    return DistributedForce{
        [=](double s) { return Vec3(1 + amplitude * std::sin(1e9 * s * s), 0, 0); }};
  };
  const std::string reason =
      "load 0 has more jumps and kinks than can be told apart, or is singular";
  const auto rod = straight(1.0, automatic, round_one);
  const auto slight = solve(Scene(rod, {Clamp{}}, {noisy(1e-5)}), {.tol = 1e-2});
  CHECK(slight.converged());
  CHECK(slight.accuracy->unresolved);
  CHECK(slight.accuracy->reason == reason);
  CHECK(slight.doubts.size() == 1);
  Settings few{.tol = 1e-6};
  few.options.max_edges = 512;
  const auto strong = solve(Scene(rod, {Clamp{}}, {noisy(0.3)}), few);
  CHECK(strong.status() == Status::not_accurate);
  CHECK(strong.accuracy->reason == reason);
  CHECK(solve(Scene(straight(1.0, 16, round_one), {Clamp{}}, {noisy(1e-5)})).doubts.empty());
}

TEST_CASE("why grids may be irregular: by what is known of the functions") {
  Scene scene(straight(1.0, 16, round_one), {Clamp{}});
  CHECK(add_vertices_at_breaks(scene, {}).reason ==
        "something in the scene is smaller than the edges");
  scene.rods[0].curvature = [](double s) { return Vec3(s, 0, 0); };
  CHECK(add_vertices_at_breaks(scene, {}).reason ==
        "a load, a section or the curvature may jump where that was not found; give it a vertex "
        "(Rod.with_vertices)");
  scene.rods[0].section = [](double s) { return Section(1, 1 + std::sqrt(s), 1); };
  const auto singular = add_vertices_at_breaks(scene, {});
  CHECK(singular.unresolved);
  CHECK(singular.reason.starts_with("the section of rod 0 has more jumps and kinks"));
  CHECK(scene.rods[0].edges() == 16);
}
