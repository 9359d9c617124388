// SPDX-License-Identifier: BSD-3-Clause
// A cantilever to a tolerance from C++ alone, and the levels it is made of.
#include <pyrod/rod/section.hpp>
#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/statics/ladder/cantilever_levels.hpp>

#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

const double x = 0.8106090248802965, z = 0.4450044022462487;  // tip of the elastica, F L²/EI = 10

Rod<Spatial> straight(int edges) {
  return Rod<Spatial>::uniform(Grid::uniform(1, edges), {1, 1, 0.7},
                               Vec3::Constant(Section::rigid));
}

/// `made`: counts how often a level is asked for.
/// Every edge cut in so many.
Rod<Spatial> cut(const Rod<Spatial>& rod, int parts) {
  const auto spec = discrete(rod.grid.edge_lengths(), {rod.bending, rod.stretching, {}, rod.jumps},
                             rod.K0, ModelKind::cosserat);
  return made_on_grid(spec, parts).rod;
}

LoadedRod loaded(int level, int& made) {
  ++made;
  const Rod<Spatial> rod = cut(straight(16), 1 << level);
  Loads<Spatial> loads(rod.edges());
  loads.add_force(rod.grid, {10, 0, 0}, 1);
  return {rod, loads};
}

template <class Space>
Climbed climb(CantileverLevels<Space>& levels, const std::vector<typename Space::Rotation>& start,
              double tolerance, int iterations = 100) {
  const std::vector<Rod<Spatial>> rods{straight(16)};
  Options options;
  const auto solve = [&](int level, bool from_below, double step) {
    options.tolerance = step;
    options.max_iterations = level == 0 ? iterations : 100;
    return levels.solve(level, from_below, start, options, {});
  };
  return Ladder({rods, solve}, tolerance, 1 << 18).climb();
}

}  // namespace

TEST_CASE("levels of a clamped rod refuse loads that follow it") {
  const auto follow = [](int level) {
    int made = 0;
    auto out = loaded(level, made);
    out.loads.add_follower_force(out.rod.grid, {0, 2, 0}, 1);
    return out;
  };
  CantileverLevels<Spatial> levels(follow, Placement<Spatial>{});
  CHECK_REFUSED("loads: some follow the rod", climb<Spatial>(levels, {}, 1e-6));
}

TEST_CASE_TEMPLATE("the elastica to 1e-10, twice from levels made once", Space, Planar, Spatial) {
  int made = 0;
  CantileverLevels<Space> levels([&](int level) { return loaded(level, made); },
                                 Placement<Spatial>{});
  for (int i = 0; i < 2; ++i) {
    const auto climbed = climb<Space>(levels, {}, 1e-10);
    const auto& rod = climbed.solution.rods[0];
    CHECK(climbed.solution.converged());
    CHECK(rod.curve.positions.size() == 17);
    CHECK((rod.curve.positions.back() - Vec3(x, 0, z)).norm() < 1e-10);
    CHECK(climbed.reached.levels == made);
  }
}

TEST_CASE_TEMPLATE("a start goes along where the first level fails", Space, Planar, Spatial) {
  int made = 0;
  CantileverLevels<Space> levels([&](int level) { return loaded(level, made); },
                                 Placement<Spatial>{});
  std::vector<typename Space::Rotation> start;
  const auto frames = climb<Space>(levels, {}, 1e-6).solution.rods[0].curve.frames;
  for (const auto& q : frames) start.push_back(restrict_rotation<Space>(q));
  const auto climbed = climb<Space>(levels, start, 1e-8, 1);  // level 0 ends after one iteration
  CHECK(climbed.solution.converged());
  CHECK((climbed.solution.rods[0].curve.positions.back() - Vec3(x, 0, z)).norm() < 1e-8);
  const auto& record = climbed.solution.record;
  CHECK(record[1].kind == Hessian::exact);  // level 1 trusts the start
  CHECK(record[1].step < 0.02);
}

TEST_CASE("a rod on halved edges keeps its length, compliance and turn") {
  Rod<Spatial> rod{Grid(Vector{{0.2, 0.5, 0.3}}),
                   {{1, 2, 3}, {2, 1, 4}, {3, 3, 1}, {1, 1, 1}},
                   {{5, 6, 7}, {7, 6, 5}, {1, 2, 3}},
                   {{0.1, 0, 1}, {0, 0.4, 0}, {0.3, 0.2, 0.1}, {0, 0, 0}}};
  const auto finer = cut(rod, 2);
  finer.check();
  CHECK(finer.edges() == 6);
  CHECK(finer.grid.length() == doctest::Approx(1).epsilon(1e-15));
  for (int j = 0; j <= 3; ++j) {
    CHECK(finer.bending[2 * j] == rod.bending[j]);
    CHECK(finer.K0[2 * j] == rod.K0[j]);
  }
  for (int j = 0; j < 3; ++j) {
    CHECK(finer.stretching[2 * j] == rod.stretching[j]);
    CHECK(finer.stretching[2 * j + 1] == rod.stretching[j]);
    const Vec3 mean = (rod.bending[j].cwiseInverse() + rod.bending[j + 1].cwiseInverse()) / 2;
    CHECK((finer.bending[2 * j + 1].cwiseInverse() - mean).norm() < 1e-15);
    CHECK((finer.K0[2 * j + 1] - (rod.K0[j] + rod.K0[j + 1]) / 2).norm() < 1e-15);
  }
}
