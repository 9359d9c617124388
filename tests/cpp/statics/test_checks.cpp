// SPDX-License-Identifier: BSD-3-Clause
// What a caller from C++ may get wrong: it is refused by name, and nothing is read out of bounds.
#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <functional>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int n = 16;

Scene<Spatial> bent() {
  auto scene = uniform_scene<Spatial>(n, Vec3(1, 1, 0.7), Vec3(100, 100, 100));
  scene.loads.add_force(scene.rod.grid, Vec3(1, 0.2, 0), 1);
  return scene;
}

/// The same rod as a network that may turn at its far end, where it is held.
Network<Spatial> hinged() {
  Structure<Spatial> s;
  const auto scene = bent();
  s.add(scene.rod);
  s.net.loads[0].add_force(scene.rod.grid, Vec3(1, 0, 0.2), 0.5);
  s.clamp(0, 0);
  s.pivot(0, n);
  return s.net;
}

std::string clamped_with(const std::function<void(Scene<Spatial>&)>& change) {
  auto scene = bent();
  change(scene);
  return refusal([&] { solved<Spatial, Cosserat>(scene); });
}

std::string network_with(const std::function<void(Network<Spatial>&)>& change,
                         const std::optional<NetworkStart>& start = {}) {
  auto net = hinged();
  change(net);
  const auto planar = refusal([&] { run_in<Planar>(net, {}, start); });
  const auto spatial = refusal([&] { run_in<Spatial>(net, {}, start); });
  CHECK(planar != "(not refused)");
  return spatial;
}

void begins(const std::string& text, const std::string& with) {
  CAPTURE(text);
  CAPTURE(with);
  CHECK(text.starts_with(with));
}

const double nan_ = std::nan("");

}  // namespace

TEST_CASE("rods and loads that do not fit are refused on either path") {
  CHECK(clamped_with([](auto&) {}) == "(not refused)");
  CHECK(refusal([] { run_in<Spatial>(hinged()); }) == "(not refused)");
  using Change = std::function<void(Rod<Spatial>&, Loads<Spatial>&)>;
  const std::vector<std::pair<Change, std::string>> wrong{
      {[](auto&, auto& l) { l = Loads<Spatial>(8); },
       "loads: made for 8 edges, on a rod that has 16"},
      {[](auto&, auto& l) { l = Loads<Spatial>(32); }, "loads: made for 32 edges"},
      {[](auto&, auto& l) { l.force.pop_back(); }, "loads.force: expected 17 rows"},
      {[](auto&, auto& l) { l.force.emplace_back(0, 0, 0); }, "loads.force: expected 17 rows"},
      {[](auto&, auto& l) { l.shares.resize(3, Vec3::Zero()); }, "loads.shares: expected 16 rows"},
      {[](auto&, auto& l) { l.force[3][1] = nan_; }, "loads: the section force is not finite"},
      {[](auto&, auto& l) { l.force[0][1] = nan_; }, "loads: the section force is not finite"},
      {[](auto&, auto& l) { l.moment[3][1] = nan_; }, "loads: the moments add up to what is not"},
      {[](auto&, auto& l) { l.follower_forces = {{n, n, Vec3::Ones()}}; },
       "loads: a following force on edge 16 and vertex 16 of 16 edges"},
      {[](auto&, auto& l) { l.follower_forces = {{2, 7, Vec3::Ones()}}; },
       "loads: a following force on edge 2 and vertex 7"},
      {[](auto&, auto& l) { l.follower_moments = {{-1, Vec3::Ones()}}; },
       "loads: a following moment on edge -1"},
      {[](auto& r, auto&) { r.bending.pop_back(); }, "bending: expected 17 rows (one per vertex)"},
      {[](auto& r, auto&) { r.stretching.resize(3); }, "stretching: expected 16 rows"},
      {[](auto& r, auto&) { r.K0.clear(); }, "K0: expected 17 rows"},
      {[](auto& r, auto&) { r.bending[3][1] = -1; }, "bending[3]: stiffnesses must be positive"},
  };
  for (const auto& [change, text] : wrong) {
    begins(clamped_with([&](auto& s) { change(s.rod, s.loads); }), text);
    begins(network_with([&](auto& net) { change(net.rods[0], net.loads[0]); }), text);
  }
}

TEST_CASE("loads along a rod have one entry per edge, and belong to its grid") {
  const auto grid = Grid::uniform(1, n);
  const std::vector<Vec3> three(3, Vec3::Ones());
  Loads<Spatial> loads(n), others(8);
  CHECK_REFUSED("force_per_length: expected 16 rows", loads.add_force_per_length(grid, three));
  CHECK_REFUSED("force_per_length: expected", loads.add_follower_force_per_length(grid, three));
  CHECK_REFUSED("moment_per_length: expected", loads.add_moment_per_length(grid, three));
  CHECK_REFUSED("moment_per_length: expected", loads.add_follower_moment_per_length(grid, three));
  CHECK_REFUSED("loads: made for 8 edges", others.add_force(grid, Vec3::Ones(), 1));
  CHECK_REFUSED("loads: made for 8 edges", others.add_moment(grid, Vec3::Ones(), 1));
  CHECK_REFUSED("loads: made for 8 edges", others.add_follower_force(grid, Vec3::Ones(), 1));
  CHECK_REFUSED("loads: made for 8 edges", others.add_follower_moment(grid, Vec3::Ones(), 1));
}

TEST_CASE("a clamped rod is held somewhere, and starts from frames of its edges") {
  begins(clamped_with([](auto& s) { s.q0 = Quaternion(2, 0, 0, 0); }),
         "placements[0].frame: expected a unit");
  begins(clamped_with([](auto& s) { s.r0[1] = nan_; }), "placements[0].position: expected finite");
  begins(network_with([](auto& net) { net.nodes[0].position[1] = nan_; }),
         "nodes[0].position: expected finite");
  const auto from = [](std::vector<Quaternion> frames) {
    auto scene = bent();
    scene.loads = Loads<Spatial>(n);  // the plane has been looked at before
    const auto run_time = refusal([&] {
      solved(scene.rod, Dimension::planar, ModelKind::cosserat, {}, scene.loads, frames);
    });
    const auto text = refusal([&] { solved<Spatial, Cosserat>(scene, frames); });
    CHECK(run_time == text);
    return text;
  };
  const auto unit = Quaternion::Identity();
  begins(from(std::vector(3, unit)), "start: expected 16 rows (one frame per edge), got 3");
  begins(from(std::vector(n, Quaternion(0, 0, 0, 0))), "start[0]: expected a unit quaternion");
  begins(from(std::vector(n, Quaternion(nan_, 0, 0, 0))), "start[0]: expected a unit quaternion");
}

TEST_CASE("networks that are none are refused by name") {
  const auto refused = [](const auto& change, const std::string& text) {
    begins(network_with(change), text);
  };
  refused([](auto& net) { net.placements.clear(); }, "placements: expected 1 rows (one per rod)");
  refused([](auto& net) { net.loads.clear(); }, "loads: expected 1 rows (one per rod), got 0");
  refused([](auto& net) { net = {}; }, "rods: expected at least one");
  refused([](auto& net) { net.attachments[0].rod = 1; }, "attachment: no rod 1");
  refused([](auto& net) { net.attachments[0].node = 2; }, "attachment: no node 2");
  refused([](auto& net) { net.attachments[0].vertex = n + 1; },
          "attachment: rod 0 has no vertex 17");
  refused([](auto& net) { net.attachments[1].vertex = 0; },
          "supports: vertex 0 of rod 0 is held twice");
  refused([](auto& net) { net.nodes[1].spring = -1; },
          "nodes[1].spring: a stiffness must be finite and not negative, got -1");
  refused([](auto& net) { net.nodes[1].torsion_spring = nan_; },
          "nodes[1].torsion_spring: a stiff");
  refused([](auto& net) { net.nodes[0].frame = Quaternion(0, 0, 2, 0); },
          "nodes[0].frame: expected a unit quaternion, got (0, 0 2 0) of length 2");
  refused([](auto& net) { net.placements[0].frame = Quaternion(0, 0, 0, 0); },
          "placements[0].frame: expected a unit quaternion");
  refused([](auto& net) { net.placements[0].position[2] = nan_; },
          "placements[0].position: expected");
  refused([](auto& net) { net.attachments[0].relative = Quaternion(0, 0, 2, 0); },
          "attachment of vertex 0 of rod 0: relative: expected a unit quaternion");
  refused([](auto& net) { net.attachments[1].hinge = Vec3(0, 2, 0); },
          "attachment of vertex 16 of rod 0: hinge: expected an axis of length 1");
  refused([](auto& net) { net.nodes[1].free = 2 * Mat3::Identity(); },
          "nodes[1].free: expected columns of length 1 at right angles, got columns 0 and 0");
  refused([](auto& net) { net.nodes[1].turns.setConstant(3, 2, std::sqrt(1. / 3)); },
          "nodes[1].turns: expected columns of length 1 at right angles, got columns 0 and 1");
  refused([](auto& net) { net.nodes[1].position[0] = nan_; }, "nodes[1].position: expected finite");
  refused([](auto& net) { net.nodes[1].force[0] = nan_; }, "nodes[1].force: expected finite");
}

TEST_CASE("attachments may be listed in any order") {
  auto net = hinged();
  const auto one = run_in<Spatial>(net);
  std::swap(net.attachments[0], net.attachments[1]);
  const auto other = run_in<Spatial>(net);
  CHECK(one.status == Status::converged);
  CHECK(distance(one.rods[0].curve.positions, other.rods[0].curve.positions) < 1e-13);
}

TEST_CASE("starts of a network that do not fit are refused") {
  const auto found = run_in<Spatial>(hinged());
  const std::vector<Quaternion> frames = found.rods[0].curve.frames,
                                unit(2, Quaternion::Identity());
  const std::vector<Vec3> places(2, Vec3::Zero());
  const auto from = [](const NetworkStart& start) { return network_with([](auto&) {}, start); };
  begins(from({std::vector(3, Quaternion::Identity()), {}, {}}), "start: expected 16 rows");
  begins(from({std::vector(n, Quaternion(0, 0, 0, 0)), {}, {}}), "start[0]: expected a unit");
  const std::string nodes = "start: expected a position and a frame for each of the network's 2";
  begins(from({frames, {Vec3::Zero()}, {}}), nodes);
  begins(from({frames, places, {}}), nodes);
  begins(from({frames, std::vector<Vec3>(200), std::vector(200, unit[0])}), nodes);
  begins(from({frames, {Vec3::Zero()}, {unit[0]}}), nodes);
  begins(from({frames, {Vec3::Zero(), {0, nan_, 0}}, unit}), "start.positions[1]: expected finite");
  begins(from({frames, places, {unit[0], {0, 0, 0, 0}}}), "start.node_frames[1]: expected a unit");
}
