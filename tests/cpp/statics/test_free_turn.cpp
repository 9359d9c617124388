// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/ladder/free_turn.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int edges = 6;

/// A bent rod with a node at its end. Its mode, in the components of the frames, is a turn about
/// `axis`.
Solution<Spatial> bent(const Vec3& axis) {
  Random random(1);
  const auto made = random.rod<Spatial>(edges);
  const auto curve = made.at_rest(random.vector<3>(), random.rotation<Spatial>());
  RodSolution<Spatial> rod;
  rod.curve = curve;
  rod.vertex_frames.assign(edges + 1, curve.frames[0]);
  Solution<Spatial> out;
  for (int j = 0; j <= edges; ++j) {
    rod.vertex_force.push_back(random.vector<3>());
    rod.moment.push_back(random.vector<3>());
    if (j == edges) continue;
    rod.force.push_back(random.vector<3>());
    out.mode.push_back(unrotate(curve.frames[std::size_t(j)], axis));
  }
  out.nodes.push_back(
      {curve.positions.back(), random.vector<3>(), curve.frames.back(), random.vector<3>()});
  out.rods.push_back(std::move(rod));
  return out;
}

void check_same(const Rung& a, const Rung& b) {
  const auto &p = a.rods[0], &q = b.rods[0];
  CHECK(distance(p.curve.positions, q.curve.positions) < 1e-14);
  CHECK(distance(p.curve.frames, q.curve.frames) < 1e-14);
  CHECK(distance(p.vertex_frames, q.vertex_frames) < 1e-14);
  CHECK(distance(p.vertex_force, q.vertex_force) < 1e-14);
  CHECK(distance(p.force, q.force) < 1e-14);
  CHECK(distance(p.moment, q.moment) < 1e-14);
  CHECK(distance(a.nodes[0].position, b.nodes[0].position) < 1e-14);
  CHECK(distance(a.nodes[0].frame, b.nodes[0].frame) < 1e-14);
  CHECK(distance(a.nodes[0].reaction_force, b.nodes[0].reaction_force) < 1e-14);
  CHECK(distance(a.nodes[0].reaction_moment, b.nodes[0].reaction_moment) < 1e-14);
}

}  // namespace

TEST_CASE("a turn about the free axis is undone, however large") {
  const Vec3 axis = Vec3(1, 2, -2) / 3;
  const auto scene = bent(axis);
  const Rung before(Solution<Spatial>(scene), 1, nullptr);
  for (const double angle : {0.1, 1., 3., -2.}) {
    Rung turned = before;
    detail::turn(turned, exp(Vec3(angle * axis)), before.rods[0].curve.positions[0]);
    REQUIRE(distance(turned.rods[0].curve.positions, before.rods[0].curve.positions) > 0.05);
    undo_free_turn(turned, before, scene.mode);
    check_same(turned, before);
  }
}

TEST_CASE("all that is spatial turns") {
  const Rung before(bent(Vec3(1, 0, 0)), 1, nullptr);
  const Vec3 centre(0.1, 0.2, 0.3);
  const Quaternion q = exp(Vec3(0.3, -0.2, 0.5));
  Rung turned = before;
  detail::turn(turned, q, centre);
  const auto &a = before.rods[0], &b = turned.rods[0];
  const auto &u = before.nodes[0], &v = turned.nodes[0];
  const auto placed = [&](const Vec3& r) -> Vec3 { return centre + rotate(q, Vec3(r - centre)); };
  for (std::size_t j = 0; j < edges; ++j) {
    CHECK(distance(b.curve.positions[j], placed(a.curve.positions[j])) < 1e-15);
    CHECK(distance(b.curve.frames[j], q * a.curve.frames[j]) < 1e-15);
    CHECK(distance(b.vertex_frames[j], q * a.vertex_frames[j]) < 1e-15);
    CHECK(distance(b.force[j], rotate(q, a.force[j])) < 1e-15);
    CHECK(distance(b.vertex_force[j], rotate(q, a.vertex_force[j])) < 1e-15);
    CHECK(distance(b.moment[j], rotate(q, a.moment[j])) < 1e-15);
  }
  CHECK(distance(v.position, placed(u.position)) < 1e-15);
  CHECK(distance(v.frame, q * u.frame) < 1e-15);
  CHECK(distance(v.reaction_force, rotate(q, u.reaction_force)) < 1e-15);
  CHECK(distance(v.reaction_moment, rotate(q, u.reaction_moment)) < 1e-15);
}

TEST_CASE("other turns are none of its business") {
  const auto scene = bent(Vec3(1, 0, 0));
  const Rung before(Solution<Spatial>(scene), 1, nullptr);
  Rung turned = before;
  detail::turn(turned, exp(Vec3(0, 0.3, 0)), before.rods[0].curve.positions[0]);
  SUBCASE("there is no mode") {
    const Rung as_it_was = turned;
    undo_free_turn(turned, before, {});
    check_same(turned, as_it_was);
  }
  SUBCASE("the mode bends the rod") {
    auto bending = scene.mode;
    bending[2] *= 1.01;
    const Rung as_it_was = turned;
    undo_free_turn(turned, before, bending);
    check_same(turned, as_it_was);
  }
  SUBCASE("the mode is of another axis: about that it is brought as near as it can be") {
    const auto away = [&] {
      return distance(turned.rods[0].curve.positions, before.rods[0].curve.positions);
    };
    const double first = away();
    undo_free_turn(turned, before, scene.mode);
    CHECK(away() > 0.3 * first);
  }
}
