// SPDX-License-Identifier: BSD-3-Clause
// A clamped rod takes whatever its loads and its stability ask for.
#include "support/cantilever.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int n = 32;
const Placement<Spatial> somewhere{{1, -2, 0.5}, exp(Vec3(0.3, -0.8, 0.4))};

Scene<Spatial> rod_under(const std::function<void(Loads<Spatial>&, const Grid&)>& load) {
  auto scene = uniform_scene<Spatial>(n, Vec3(1, 1, 0.7), Vec3(1e4, 1e4, 1e4));
  load(scene.loads, scene.rod.grid);
  return scene;
}

}  // namespace

TEST_CASE("what follows a clamped rod is solved, in plane and space and by each model") {
  const Vec3 f(3, 0, -1);
  const auto scene =
      rod_under([&](auto& loads, const Grid& grid) { loads.add_follower_force(grid, f, 1); });
  for (const auto dimension : {Dimension::planar, Dimension::spatial})
    for (const auto model : {ModelKind::cosserat, ModelKind::extensible, ModelKind::inextensible}) {
      const auto found = solved(scene.rod, dimension, model, somewhere, scene.loads);
      REQUIRE(found.status == Status::converged);
      CHECK(found.index == -1);  // there is no energy to have one
      const Vec3 F = rotate(found.curve.frames.back(), f);
      CHECK(F.norm() > 0);
      CHECK(distance(found.force[0], F) < 1e-10);
      const Vec3 lever = found.curve.positions.back() - somewhere.position;
      CHECK(distance(found.moment[0], Vec3(lever.cross(F))) < 1e-9);
      CHECK((found.moment[0]).norm() > 1);
      const auto again =
          solved(scene.rod, dimension, model, somewhere, scene.loads, found.curve.frames);
      CHECK(again.status == Status::converged);
      CHECK(again.record.size() <= 2);
      CHECK(distance(again.curve.positions, found.curve.positions) < 1e-10);
    }
}

TEST_CASE("a saddle is left unless it is wanted") {
  const auto scene = rod_under([&](auto& loads, const Grid& grid) {
    loads.add_force(grid, rotate(somewhere.frame, Vec3(0, 0, -10)), 1);
  });
  const auto at = [&](bool stable) {
    return solved(scene.rod, Dimension::spatial, ModelKind::cosserat, somewhere, scene.loads, {},
                  stable);
  };
  const auto saddle = at(false), stable = at(true);
  REQUIRE(saddle.status == Status::converged);
  CHECK(saddle.index == 2);
  REQUIRE(stable.status == Status::converged);
  CHECK(stable.index == 0);
  CHECK(distance(stable.curve.positions.back(), saddle.curve.positions.back()) > 0.5);
  CHECK(distance(stable.vertex_frames[0], somewhere.frame) < 0.2);
  const Vec3 lever = stable.curve.positions.back() - somewhere.position;
  CHECK(distance(stable.moment[0], Vec3(lever.cross(rotate(somewhere.frame, Vec3(0, 0, -10))))) <
        1e-8);
}

TEST_CASE(
    "a rod that is clamped at its end is one clamped at its start, backwards, by each model") {
  const auto scene = rod_under([&](auto& loads, const Grid& grid) {
    loads.add_force(grid, rotate(somewhere.frame, Vec3(2, 0.5, 1)), 1);
  });
  for (const auto model : {ModelKind::cosserat, ModelKind::extensible, ModelKind::inextensible}) {
    const auto expected = solved(scene.rod, Dimension::spatial, model, somewhere, scene.loads);
    const Quaternion back = somewhere.frame * exp(Vec3(std::numbers::pi, 0, 0));
    auto net =
        clamped<Spatial>(in_model(scene.rod, model), {somewhere.position, back}, scene.loads);
    net.attachments[0].vertex = n;
    std::ranges::reverse(net.loads[0].force);
    net.placements[0].position += rotate(somewhere.frame, Vec3::UnitZ());
    auto found = run_in<Spatial>(net);
    REQUIRE(found.status == Status::converged);
    CHECK(found.multipliers == 0);
    std::ranges::reverse(found.rods[0].curve.positions);
    CHECK(distance(found.rods[0].curve.positions, expected.curve.positions) < 1e-11);
  }
}
