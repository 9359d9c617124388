// SPDX-License-Identifier: BSD-3-Clause
// Whole solves: against the clamped rod, plane against space, moved, in other units.
#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <pyrod/rod/section.hpp>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A portal in the plane of x and z: two legs, clamped and hinged, and a beam on rigid corners.
/// Lengths in units of `L`, stiffness of `EI`. It leans under its loads and does not buckle.
Structure<Spatial> portal(double L = 1, double EI = 1) {
  const double F = EI / (L * L);
  const auto rod = [&](int edges) {
    return Rod<Spatial>::uniform(Grid::uniform(L, edges), EI * Vec3(3, 1, 2),
                                 F * Vec3(300, 300, 1000), Vec3(0, 0.2, 0) / L);
  };
  Structure<Spatial> s;
  s.add(rod(40));
  const auto leg = s.at_rest(0);
  const Quaternion corner = leg.end_frame * exp(Vec3(0, 1.5, 0));
  s.add(rod(30), leg.positions.back(), corner);
  const auto beam = s.at_rest(1);
  s.add(rod(35), beam.positions.back(), beam.end_frame * exp(Vec3(0, 1.6, 0)));
  s.clamp(0, 0);
  s.joint(0, 40, 1, 0, true);
  const int other = s.joint(1, 30, 2, 0, true);
  s.hinge(2, 35);
  s.net.loads[1].force[15] = F * Vec3(0.3, 0, -1.5);
  s.net.nodes[other].force = F * Vec3(0.4, 0, 0.1);
  s.net.loads[2].moment[10] = F * L * Vec3(0, 0.3, 0);
  return s;
}

/// Everything carried by a rigid motion.
Network<Spatial> carried(Network<Spatial> net, const Vec3& shift, const Quaternion& turn) {
  const auto point = [&](Vec3& r) { r = shift + rotate(turn, r); };
  const auto vector = [&](Vec3& v) { v = rotate(turn, v); };
  const auto frame = [&](Quaternion& q) { q = turn * q; };
  for (auto& p : net.placements) point(p.position), frame(p.frame);
  for (auto& loads : net.loads) {
    for (auto& F : loads.force) vector(F);
    for (auto& m : loads.moment) vector(m);
    vector(loads.start_moment), vector(loads.end_moment);
  }
  for (auto& v : net.nodes) {
    point(v.position), frame(v.frame), vector(v.force), vector(v.moment);
    for (Eigen::Index i = 0; i < v.free.cols(); ++i)
      v.free.col(i) = rotate(turn, Vec3(v.free.col(i)));
  }
  return net;
}

}  // namespace

TEST_CASE_TEMPLATE("a clamped rod as a network is the clamped rod", Space, EACH_SPACE) {
  auto scene = rich_scene<Space>(48);
  scene.r0 = Point<Space>::Constant(0.3);
  scene.q0 = exp(Spin<Space>(Spin<Space>::Constant(0.4)));
  const auto expected = solved<Space, Cosserat>(scene);
  REQUIRE(expected.status == Status::converged);
  Structure<Space> s;
  s.add(scene.rod, scene.r0, scene.q0);
  s.clamp(0, 0);
  const auto aside = exp(Spin<Space>(Spin<Space>::Constant(-0.7)));  // of the node
  s.net.nodes[0].frame = scene.q0 * aside;
  s.net.attachments[0].relative = aside.conjugate();
  s.net.loads[0] = scene.loads;
  const auto result = solved(s.net);
  REQUIRE(result.status == Status::converged);
  CHECK(result.index == expected.index);
  CHECK(result.multipliers == 0);
  CHECK(result.unknowns == 48 * Space::spin);
  CHECK(result.fill == 1);
  const auto& rod = result.rods[0];
  constexpr double rounding = 1e-12;
  CHECK(distance(rod.curve.frames, expected.curve.frames) < rounding);
  CHECK(distance(rod.curve.positions, expected.curve.positions) < rounding);
  CHECK(distance(rod.curve.end_frame, expected.curve.end_frame) < rounding);
  CHECK(distance(rod.force, expected.force) < rounding);
  CHECK(distance(rod.material_force, expected.material_force) < 10 * rounding);
  CHECK(distance(rod.moment, expected.moment) < 1e3 * rounding);  // EI/Δs times the frames'
  CHECK(distance(rod.strains.K, expected.strains.K) < 1e3 * rounding);
  CHECK(distance(rod.load_moment, expected.load_moment) < rounding);
  CHECK(rod.bend_twist_energy == doctest::Approx(expected.bend_twist_energy).epsilon(rounding));
  CHECK(rod.stretch_shear_energy ==
        doctest::Approx(expected.stretch_shear_energy).epsilon(rounding));
  const auto& reaction = result.nodes[0];
  const Point<Space> total = expected.force[0] + scene.loads.force[0];
  CHECK(distance(reaction.reaction_force, Point<Space>(-total)) < rounding);
}

TEST_CASE("a plane network is a spatial one, wherever the plane lies") {
  const auto s = portal();
  const auto space = run_in<Spatial>(s.net);
  REQUIRE(space.status == Status::converged);
  CHECK(space.index == -1);  // a moment fixed in space has a potential in the plane only
  CHECK(space.multipliers == 9);
  const auto compare = [&](const Solution<Spatial>& plane, const Placement<Spatial>& at) {
    REQUIRE(plane.status == Status::converged);
    CHECK(plane.index == 0);
    CHECK(plane.multipliers == 6);
    for (std::size_t i = 0; i < space.rods.size(); ++i) {
      const auto &a = plane.rods[i], &b = space.rods[i];
      for (std::size_t j = 0; j < b.curve.positions.size(); ++j) {
        const Vec3 r = at.position + rotate(at.frame, b.curve.positions[j]);
        CHECK(distance(a.curve.positions[j], r) < 1e-11);
        CHECK(distance(a.moment[j], rotate(at.frame, b.moment[j])) < 1e-9);
      }
      for (std::size_t j = 0; j < b.force.size(); ++j)
        CHECK(distance(a.force[j], rotate(at.frame, b.force[j])) < 1e-9);
      CHECK(a.bend_twist_energy == doctest::Approx(b.bend_twist_energy).epsilon(1e-9));
    }
    for (std::size_t v = 0; v < s.net.nodes.size(); ++v) {
      const auto &a = plane.nodes[v], &b = space.nodes[v];
      CHECK(distance(a.reaction_force, rotate(at.frame, b.reaction_force)) < 1e-9);
      CHECK(distance(a.reaction_moment, rotate(at.frame, b.reaction_moment)) < 1e-9);
    }
  };
  compare(run_in<Planar>(s.net), {});
  Random random(1);
  const Placement<Spatial> at{random.vector<3>(), random.rotation<Spatial>()};
  compare(run_in<Planar>(carried(s.net, at.position, at.frame), at), at);
}

TEST_CASE("what leaves the plane is refused, with what to do") {
  const auto with = [](const auto& change) {
    auto net = portal().net;
    change(net);
    return refusal([&] { run_in<Planar>(net); });
  };
  CHECK(with([](auto& n) {
          n.nodes[0].position.y() = 0.1;
        }).starts_with("supports: a point leaves the plane"));
  CHECK(with([](auto& n) {
          n.nodes[0].frame = exp(Vec3(0.1, 0, 0));
        }).starts_with("supports: a frame leaves the plane"));
  CHECK(with([](auto& n) {
          n.placements[1].position.y() = 0.1;
        }).starts_with("rod: a point leaves the plane"));
  CHECK(with([](auto& n) { n.loads[0].force[3].y() = 1; }).starts_with("loads: a force ("));
}

TEST_CASE("a rigid motion of everything moves the solution, and nothing else") {
  Random random(2);
  const Vec3 shift = 3 * random.vector<3>();
  const Quaternion turn = random.rotation<Spatial>();
  for (const bool moments : {false, true}) {
    CAPTURE(moments);
    const auto net = random_network<Spatial>(random, {.moments = moments});
    const auto a = solved(net), b = solved(carried(net, shift, turn));
    REQUIRE(a.status == Status::converged);
    REQUIRE(b.status == Status::converged);
    CHECK(a.index == b.index);
    CHECK(a.record.size() == b.record.size());
    for (std::size_t i = 0; i < a.rods.size(); ++i) {
      const auto &p = a.rods[i], &q = b.rods[i];
      for (std::size_t j = 0; j < p.curve.positions.size(); ++j)
        CHECK(distance(q.curve.positions[j], Vec3(shift + rotate(turn, p.curve.positions[j]))) <
              1e-10);
      CHECK(distance(q.material_force, p.material_force) < 1e-9);
      CHECK(distance(q.strains.K, p.strains.K) < 1e-9);
    }
    for (std::size_t v = 0; v < net.nodes.size(); ++v)
      CHECK(distance(b.nodes[v].reaction_moment, rotate(turn, a.nodes[v].reaction_moment)) < 1e-9);
  }
}

TEST_CASE("a strand of DNA in metres and a cable of kilometres take the same steps") {
  const auto one = solved(portal().net);
  REQUIRE(one.status == Status::converged);
  for (const auto& [L, EI] : {std::pair{1e-7, 2e-28}, {1e4, 1e6}}) {
    CAPTURE(L);
    const auto other = solved(portal(L, EI).net);
    REQUIRE(other.status == Status::converged);
    CHECK(other.index == one.index);
    REQUIRE(other.record.size() == one.record.size());
    for (std::size_t i = 0; i + 1 < one.record.size(); ++i)
      CHECK(other.record[i].fraction == doctest::Approx(one.record[i].fraction).epsilon(1e-9));
    for (std::size_t i = 0; i < one.rods.size(); ++i) {
      const auto &a = one.rods[i], &b = other.rods[i];
      for (std::size_t j = 0; j < a.curve.positions.size(); ++j)
        CHECK(distance(Vec3(b.curve.positions[j] / L), a.curve.positions[j]) < 1e-11);
      for (std::size_t j = 0; j < a.force.size(); ++j)
        CHECK(distance(Vec3(b.force[j] * (L * L / EI)), a.force[j]) < 1e-9);
      CHECK(b.bend_twist_energy * L / EI == doctest::Approx(a.bend_twist_energy).epsilon(1e-9));
    }
  }
}

TEST_CASE_TEMPLATE("rods that cannot reach their supports end with a status", Space, EACH_SPACE) {
  Structure<Space> s;
  const auto rigid = Rod<Space>::uniform(Grid::uniform(1, 20), Spin<Space>::Ones(),
                                         Point<Space>::Constant(Section::rigid));
  s.add(rigid), s.add(rigid, axis<Space>());
  s.hinge(0, 0);
  s.joint(0, 20, 1, 0, false);
  s.net.nodes[s.hinge(1, 20)].position = 2.3 * axis<Space>();
  const auto result = solved(s.net);
  CHECK(result.status != Status::converged);
  CHECK(result.index == -1);
}
