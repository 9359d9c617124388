// SPDX-License-Identifier: BSD-3-Clause
// Shapes are found on few edges: what is left to do on the finest grid, and what if that fails.
#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
Scene<Space> bent(int n, double F, double weight, double curvature, double M = 0) {
  auto scene = uniform_scene<Space>(n, restrict_spin<Space>({1, 1.5, 0.7}),
                                    restrict_point<Space>({4e3, 4e3, 1e4}),
                                    restrict_spin<Space>({0.3 * curvature, curvature, curvature}));
  const Grid& grid = scene.rod.grid;
  scene.loads.add_force(grid, restrict_point<Space>({F, 0.3 * F, -0.1 * F}), 1);
  scene.loads.add_force_per_length(
      grid, std::vector(std::size_t(n), restrict_point<Space>({weight, 0, -weight})));
  if (M != 0) scene.loads.add_moment(grid, restrict_spin<Space>({0.2 * M, M, M}), 1);
  return scene;
}

/// Iterations on all edges.
template <class Space>
int finest(const Solved<Space>& found, int edges) {
  return int(std::ranges::count(found.record, Space::spin * edges, &Iteration::unknowns));
}

}  // namespace

TEST_CASE_TEMPLATE("on many edges one step and its check are left to do", Space, EACH_SPACE) {
  for (const int n : {1024, 1500, 5000})
    for (const auto& scene :
         {bent<Space>(n, 1, 0, 0), bent<Space>(n, 10, 0, 0), bent<Space>(n, 100, 0, 2),
          bent<Space>(n, 10, 20, 1), bent<Space>(n, 0, 30, 0), bent<Space>(n, 10, 0, 0, 2)}) {
      const auto found = solved<Space>(scene);
      CAPTURE(n);
      REQUIRE(found.status == Status::converged);
      CHECK(finest(found, n) <= 2);
      CHECK(found.record.size() > 5);  // the shape was found before
    }
}

TEST_CASE_TEMPLATE("what is found is what a solve on all edges finds", Space, EACH_SPACE) {
  for (const auto& scene :
       {bent<Space>(1024, 10, 0, 0), bent<Space>(1024, 10, 20, 1), bent<Space>(1024, 300, 0, 2)}) {
    const auto found = solved<Space>(scene);
    const auto rest = scene.rod.frames_at_rest(scene.q0);
    const auto direct = solved<Space>(scene, rest);
    REQUIRE(found.status == Status::converged);
    REQUIRE(direct.status == Status::converged);
    CHECK(finest(direct, 1024) == int(direct.record.size()));
    CHECK(distance(found.curve.frames, direct.curve.frames) < 1e-11);
    CHECK(distance(found.curve.positions, direct.curve.positions) < 1e-11);
    CHECK(found.index == direct.index);
    CHECK(found.residual < 1e-10);
  }
}

TEST_CASE_TEMPLATE("short rods, and those whose shape is known, are solved on all edges at once",
                   Space, EACH_SPACE) {
  for (const int n : {64, 256, 600}) {
    const auto found = solved<Space>(bent<Space>(n, 10, 0, 1));
    CHECK(finest(found, n) == int(found.record.size()));
  }
  const auto rest = solved<Space>(bent<Space>(2000, 0, 0, 2)),
             rolled = solved<Space>(bent<Space>(2000, 0, 0, 2, 3));
  for (const auto* found : {&rest, &rolled}) {
    CHECK(found->status == Status::converged);
    CHECK(found->record.size() <= 2);
    CHECK(finest(*found, 2000) == int(found->record.size()));
  }
}

TEST_CASE("a saddle is left on the coarsest grid") {
  auto scene = uniform_scene<Planar>(2048, Vec1(1), Vec2(1e4, 1e4));
  scene.loads.add_force(scene.rod.grid, Vec2(0, -1.5 * 2.4674), 1);
  const auto buckled = solved<Planar>(scene);
  REQUIRE(buckled.status == Status::converged);
  CHECK(buckled.index == 0);
  CHECK(std::abs(buckled.curve.positions.back()[0]) > 0.3);
  CHECK(finest(buckled, 2048) <= 2);
  const auto straight = solved<Planar>(scene, {}, {}, false);
  CHECK(straight.index == 1);
  CHECK(std::abs(straight.curve.positions.back()[0]) < 1e-12);
}

TEST_CASE_TEMPLATE("where few edges fail, all are taken at once", Space, EACH_SPACE) {
  Options options;
  options.max_iterations = 4;  // which do on no grid from rest, but for a small force
  const auto scene = bent<Space>(1024, 100, 0, 2);
  const auto failed = solved<Space>(scene, options);
  CHECK(failed.status == Status::out_of_iterations);
  CHECK(finest(failed, 1024) == 4);
  CHECK(failed.record.size() == 8);
}

TEST_CASE_TEMPLATE("a rod that is held at both ends needs as few iterations", Space, EACH_SPACE) {
  for (const int n : {1024, 3000}) {
    Structure<Space> s;
    auto rod = Rod<Space>::uniform(Grid::uniform(1, n), Spin<Space>::Ones(),
                                   1e4 * Point<Space>::Ones(), 0.5 * Spin<Space>::Ones());
    s.clamp(s.add(rod), 0);
    s.clamp(0, n);
    s.net.nodes[1].position *= 0.9;
    const auto found = solved(s.net);
    REQUIRE(found.converged());
    CHECK(std::ranges::count(found.record, found.unknowns, &Iteration::unknowns) <= 2);
    CHECK(found.index == 0);
  }
}
