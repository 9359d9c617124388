// SPDX-License-Identifier: BSD-3-Clause
// Starts from a network whose supports and joints were others.
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int n = 64;

/// A rod that is pushed together and held at both ends; `props` are springs at inner vertices.
Network<Spatial> arch(const std::vector<int>& props, bool backwards = false) {
  Structure<Spatial> s;
  s.add(n);
  s.net.loads[0].add_force(s.net.rods[0].grid, Vec3(1, 0, 0), 0.3);
  const auto add_ends = [&] {
    s.clamp(0, 0);
    s.net.nodes[s.hinge(0, n)].position = Vec3(0, 0, 0.95);
  };
  if (!backwards) add_ends();
  for (const int vertex : props) s.spring(0, vertex, 5, 1);
  if (backwards) add_ends();
  return s.net;
}

std::vector<int> inner_vertices() {
  std::vector<int> out;
  for (int j = 1; j < n; ++j) out.push_back(j);
  return out;
}

/// Two rods, joined rigidly, and a brace on ball joints; supports in either order.
Network<Spatial> frame(bool backwards) {
  Structure<Spatial> s;
  s.add(20), s.add(24, Vec3(0, 0, 1), exp(Vec3(0, 1.2, 0)));
  const auto clamp = [&] { s.clamp(0, 0); };
  const auto joint = [&] { s.joint(0, 20, 1, 0, true); };
  const auto hinge = [&] { s.hinge(1, 24); };
  if (backwards)
    hinge(), joint(), clamp();
  else
    clamp(), joint(), hinge();
  s.net.loads[0].add_force(s.net.rods[0].grid, Vec3(2, 1, -1), 0.5);
  s.net.loads[1].add_force(s.net.rods[1].grid, Vec3(0, -1, 2), 0.4);
  return s.net;
}

void same(const Solution<Spatial>& a, const Solution<Spatial>& b) {
  REQUIRE(a.status == Status::converged);
  REQUIRE(b.status == Status::converged);
  for (std::size_t i = 0; i < a.rods.size(); ++i)
    CHECK(distance(a.rods[i].curve.positions, b.rods[i].curve.positions) < 1e-9);
}

std::vector<Quaternion> frames_of(const std::vector<RodSolution<Spatial>>& rods) {
  std::vector<Quaternion> out;
  for (const auto& rod : rods)
    out.insert(out.end(), rod.curve.frames.begin(), rod.curve.frames.end());
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("more, fewer and permuted supports start from what the rods tell", Space,
                   EACH_SPACE) {
  const auto propped = arch(inner_vertices()), bare = arch({}), some = arch({20, 9, 41}, true);
  const auto with = run_in<Space>(propped), without = run_in<Space>(bare);
  REQUIRE(with.status == Status::converged);
  same(run_in<Space>(bare, {}, start_from(with.rods, bare)), without);
  same(run_in<Space>(propped, {}, start_from(without.rods, propped)), with);
  same(run_in<Space>(some, {}, start_from(with.rods, some)), run_in<Space>(some));
  std::vector<Vec3> positions;
  std::vector<Quaternion> frames;
  for (const auto& node : with.nodes)
    positions.push_back(node.position), frames.push_back(node.frame);
  CHECK(refusal([&] {
          run_in<Space>(bare, {}, NetworkStart{with.rods[0].curve.frames, positions, frames});
        }).starts_with("start: expected a position and a frame for each of the network's 2 nodes"));
}

TEST_CASE("joined rods start from a solution with the same nodes in another order") {
  const auto net = frame(false), other = frame(true);
  const auto found = run_in<Spatial>(net);
  same(found, run_in<Spatial>(other));
  const auto again = run_in<Spatial>(other, {}, start_from(found.rods, other));
  same(found, again);
  CHECK(again.record.size() <= 4);
}

TEST_CASE("frames alone place the nodes, and a solution starts itself") {
  for (const auto& net : {frame(false), arch({20, 9, 41}), arch(inner_vertices())}) {
    const auto found = run_in<Spatial>(net);
    for (const auto& start :
         {NetworkStart{frames_of(found.rods), {}, {}}, start_from(found.rods, net)}) {
      const auto again = run_in<Spatial>(net, {}, start);
      same(found, again);
      CHECK(again.record.size() <= 4);
    }
  }
}

TEST_CASE_TEMPLATE("a support that has moved holds where it is now, whatever it starts from", Space,
                   EACH_SPACE) {
  const auto slider = [](double x) {
    Structure<Spatial> s;
    s.add(32);
    s.net.loads[0].add_force(s.net.rods[0].grid, Vec3(1, 0, 0), 0.5);
    s.clamp(0, 0);
    s.net.nodes[s.roller(0, 32, 2)].position = Vec3(x, 0, 0.9);
    return s.net;
  };
  const auto before = run_in<Space>(slider(0)), expected = run_in<Space>(slider(0.1));
  for (const auto& start :
       {start_from(before.rods, slider(0.1)), NetworkStart{before.rods[0].curve.frames, {}, {}}}) {
    const auto found = run_in<Space>(slider(0.1), {}, start);
    same(found, expected);
    CHECK(std::abs(found.nodes[1].position.x() - 0.1) < 1e-14);
    CHECK(std::abs(found.rods[0].curve.positions.back().x() - 0.1) < 1e-9);
  }
}

TEST_CASE("a pin that has been turned lets rods turn about its axis only") {
  const auto pinned = [](const Vec3& axis) {
    Structure<Spatial> s;
    s.add(32);
    s.net.loads[0].add_force(s.net.rods[0].grid, Vec3(1, 0.4, 0), 0.5);
    s.clamp(0, 0);
    s.net.nodes[s.pivot(0, 32)].turns = axis;
    s.net.nodes[1].position = Vec3(0, 0, 0.9);
    return s.net;
  };
  const Vec3 axis = exp(Vec3(0, 0, 0.5)).toRotationMatrix().col(1);
  const auto before = run_in<Spatial>(pinned(Vec3::UnitY())),
             expected = run_in<Spatial>(pinned(axis));
  const auto found = run_in<Spatial>(pinned(axis), {}, start_from(before.rods, pinned(axis)));
  REQUIRE(found.status == Status::converged);
  const Vec3 turn = log(principal(found.nodes[1].frame));
  CHECK(turn.norm() > 0.05);
  CHECK(turn.cross(axis).norm() < 1e-9);
  same(found, expected);
}
