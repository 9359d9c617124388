// SPDX-License-Identifier: BSD-3-Clause
// A clamped rod to a tolerance from C++ alone, and the levels it is made of.
#include <pyrod/rod/section.hpp>
#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/statics/ladder/compiled.hpp>

#include "support/cantilever.hpp"
#include "support/near.hpp"

#include <functional>
#include <map>
#include <memory>
#include <vector>

using namespace pyrod;
using namespace pyrod::test;

namespace {

const double x = 0.8106090248802965, z = 0.4450044022462487;  // tip of the elastica, F L²/EI = 10

Rod<Spatial> straight(int edges) {
  return Rod<Spatial>::uniform(Grid::uniform(1, edges), {1, 1, 0.7},
                               Vec3::Constant(Section::rigid));
}

/// Every edge cut in so many.
Rod<Spatial> cut(const Rod<Spatial>& rod, int parts) {
  const auto spec = discrete(rod.grid.edge_lengths(), {rod.bending, rod.stretching, {}, rod.jumps},
                             rod.K0, ModelKind::cosserat);
  return made_on_grid(spec, parts).rod;
}

const std::vector<Rod<Spatial>>& coarsest() {
  static const std::vector<Rod<Spatial>> rods{straight(16)};
  return rods;
}

using Load = std::function<void(Loads<Spatial>&, const Grid&)>;

/// Makes each level when it is first asked for, and counts how often one is.
template <class Space>
struct Source {
  Placement<Spatial> clamp;
  Load load;
  std::map<int, std::shared_ptr<const Posed<Space>>> kept = {};
  int asked = 0, made = 0;

  std::shared_ptr<const Posed<Space>> operator()(int level) {
    ++asked;
    auto& posed = kept[level];
    if (posed) return posed;
    ++made;
    const Rod<Spatial> rod = cut(coarsest()[0], 1 << level);
    Loads<Spatial> loads(rod.edges());
    load(loads, rod.grid);
    return posed = std::make_shared<const Posed<Space>>(clamped(rod, clamp, loads), clamp);
  }
};

void side_force(Loads<Spatial>& loads, const Grid& grid) { loads.add_force(grid, {10, 0, 0}, 1); }

template <class Space>
Climbed climb(Source<Space>& source, double tolerance) {
  return pyrod::climb<Space>(std::ref(source), coarsest(), false, {}, {tolerance});
}

}  // namespace

TEST_CASE_TEMPLATE("a force that follows a clamped rod", Space, Planar, Spatial) {
  const Vec3 f(2, 0, 0);
  Source<Space> source{
      {}, [&](auto& loads, const Grid& grid) { loads.add_follower_force(grid, f, 1); }};
  const auto climbed = climb(source, 1e-8);
  REQUIRE(climbed.solution.converged());
  const auto& rod = climbed.solution.rods[0];
  const Vec3 F = rotate(rod.vertex_frames.back(), f);
  CHECK(distance(F, f) > 0.1);
  CHECK(distance(rod.vertex_force[0], F) < 1e-7);
  CHECK(distance(rod.moment[0], Vec3(rod.curve.positions.back().cross(F))) < 1e-7);
}

TEST_CASE_TEMPLATE("the elastica to 1e-10, twice from levels made once", Space, Planar, Spatial) {
  Source<Space> source{{}, side_force};
  for (int i = 0; i < 2; ++i) {
    source.asked = 0;
    const auto climbed = climb(source, 1e-10);
    const auto& rod = climbed.solution.rods[0];
    CHECK(climbed.solution.converged());
    CHECK(rod.curve.positions.size() == 17);
    CHECK((rod.curve.positions.back() - Vec3(x, 0, z)).norm() < 1e-10);
    CHECK(climbed.reached.levels == source.made);
    CHECK(source.asked == source.made);
  }
}

TEST_CASE_TEMPLATE("the elastica where the clamp is, and what holds it there", Space, Planar,
                   Spatial) {
  const Placement<Spatial> clamp{{1, -2, 0.5}, exp(Vec3(0.3, -0.8, 0.4))};
  Source<Space> source{clamp, [&](auto& loads, const Grid& grid) {
                         loads.add_force(grid, rotate(clamp.frame, Vec3(10, 0, 0)), 1);
                       }};
  const auto climbed = climb(source, 1e-10);
  REQUIRE(climbed.solution.converged());
  const auto& rod = climbed.solution.rods[0];
  const auto& held = climbed.solution.nodes[0];
  const Vec3 tip = clamp.position + rotate(clamp.frame, Vec3(x, 0, z));
  CHECK(distance(rod.curve.positions.back(), tip) < 1e-10);
  CHECK(distance(held.position, clamp.position) < 1e-14);
  CHECK(distance(held.reaction_force, rotate(clamp.frame, Vec3(-10, 0, 0))) < 1e-9);
  CHECK(distance(held.reaction_moment, Vec3((tip - clamp.position).cross(held.reaction_force))) <
        1e-8);
  CHECK(rod.load_moment.norm() < 1e-8);  // without that of the force
}

TEST_CASE_TEMPLATE("a start goes along where the first level fails", Space, Planar, Spatial) {
  Source<Space> source{{}, side_force};
  const NetworkStart start{climb(source, 1e-6).solution.rods[0].curve.frames, {}, {}};
  Levels<Space> levels(std::ref(source));
  Options options;
  const auto solve = [&](int level, bool from_below, double step) {
    options.tolerance = step;
    options.max_iterations = level == 0 ? 1 : 100;  // level 0 ends after one iteration
    return levels.solve(level, from_below, start, options, {}, {});
  };
  const auto climbed = Ladder({coarsest(), solve}, 1e-8, 1 << 18).climb();
  CHECK(climbed.solution.converged());
  CHECK((climbed.solution.rods[0].curve.positions.back() - Vec3(x, 0, z)).norm() < 1e-8);
  const auto& record = climbed.solution.record;
  CHECK(record[1].kind == Hessian::exact);  // level 1 trusts the start
  CHECK(record[1].step < 0.02);
}

TEST_CASE("levels that are not those of level 0 on finer grids are refused") {
  const auto wrong = [](int level) {
    const auto rod = cut(coarsest()[0], level == 0 ? 1 : 3);
    return std::make_shared<const Posed<Spatial>>(
        clamped<Spatial>(rod, {}, Loads<Spatial>(rod.edges())));
  };
  CHECK_REFUSED("level 1", pyrod::climb<Spatial>(wrong, coarsest(), false, {}, {1e-6}));
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
