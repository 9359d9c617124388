// SPDX-License-Identifier: BSD-3-Clause
// What is told at some of the vertices is what is told at all of them, there.
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/recovery.hpp>
#include <pyrod/statics/start/start.hpp>

#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
Solution<Space> told(const NetworkProblem<Space>& problem, const NetworkState<Space>& x,
                     int stride) {
  Solution<Space> out;
  Recovery<Space>(problem, x, stride).fill(out);
  return out;
}

/// Of a clamped rod.
template <class Model>
RodSolution<Spatial> shape(const Scene<Spatial>& scene, int stride) {
  const Vec3 r0(0.3, -0.2, 0.5);
  const Quaternion q0 = exp(Vec3(0.4, -0.1, 0.2));
  const Layout<Spatial> layout(
      clamped<Spatial>(in_model(scene.rod, Model::kind), {r0, q0}, scene.loads));
  const NetworkProblem<Spatial> problem(layout);
  auto x = Start<Spatial>(layout).state();
  x.frames = scene.rod.at_rest(r0, q0).frames;  // no equilibrium, which does not matter
  return told(problem, x, stride).rods[0];
}

/// What is told at all vertices, at every `stride`-th and in the middle between two such.
template <class Space>
RodSolution<Space> seen(const RodSolution<Space>& fine, int stride) {
  RodSolution<Space> out;
  const int n = fine.curve.edges() / stride;
  const auto pick = [&](const auto& from, auto& to) {
    for (int j = 0; j <= n; ++j) to.push_back(from[std::size_t(j * stride)]);
  };
  pick(fine.curve.positions, out.curve.positions);
  pick(fine.vertex_frames, out.vertex_frames);
  pick(fine.strains.K, out.strains.K);
  pick(fine.vertex_force, out.vertex_force);
  pick(fine.moment, out.moment);
  pick(fine.material_moment, out.material_moment);
  for (int j = 0; j < n; ++j) {
    const auto behind = std::size_t(j * stride + stride / 2), before = behind - 1;
    out.curve.frames.push_back(fine.vertex_frames[behind]);
    out.force.push_back((fine.force[before] + fine.force[behind]) / 2);
    out.strains.Γ.push_back((fine.strains.Γ[before] + fine.strains.Γ[behind]) / 2);
  }
  for (auto b : fine.before)
    if (b.vertex % stride == 0) b.vertex /= stride, out.before.push_back(b);
  out.largest = fine.largest;
  out.load = lumped(fine.load, stride);
  out.load_moment = fine.load_moment;  // with that of the forces, about the origin
  for (std::size_t j = 0; j < fine.load.size(); ++j)
    out.load_moment += cross(fine.curve.positions[j], fine.load[j]);
  out.bend_twist_energy = fine.bend_twist_energy;
  out.stretch_shear_energy = fine.stretch_shear_energy;
  return out;
}

template <class Space>
void check_same(const RodSolution<Space>& found, const RodSolution<Space>& expected) {
  CHECK(distance(found.curve.positions, expected.curve.positions) < 1e-15);
  CHECK(distance(found.curve.frames, expected.curve.frames) < 1e-15);
  CHECK(distance(found.vertex_frames, expected.vertex_frames) == 0);
  CHECK(distance(found.vertex_force, expected.vertex_force) < 1e-14);
  CHECK(distance(found.force, expected.force) < 1e-14);
  CHECK(distance(found.strains.Γ, expected.strains.Γ) < 1e-15);
  CHECK(distance(found.strains.K, expected.strains.K) == 0);
  CHECK(distance(found.moment, expected.moment) == 0);
  CHECK(distance(found.material_moment, expected.material_moment) == 0);
  CHECK(distance(found.load, expected.load) < 1e-14);
  CHECK(distance(found.load_moment, expected.load_moment) < 1e-14);
  CHECK(found.bend_twist_energy == expected.bend_twist_energy);
  CHECK(found.stretch_shear_energy == expected.stretch_shear_energy);
}

/// Two rods that are held at vertices 0, 8 and 16 of 16 in several ways; where the second starts,
/// its end tells.
template <class Space>
Network<Space> held(Random& random) {
  Structure<Space> s;
  for (int i = 0; i < 2; ++i) s.add(random.rod<Space>(16), random.vector<Space::dim>());
  s.clamp(0, 0), s.pivot(0, 8), s.hinge(0, 16);
  s.spring(1, 8, 3, 2), s.clamp(1, 16);
  for (auto& loads : s.net.loads) {
    for (auto& F : loads.force) F = random.vector<Space::dim>();
    for (auto& m : loads.moment) m = random.vector<Space::spin>();
    loads.follower_forces = {{1, 2, random.vector<Space::dim>()}};
  }
  return s.net;
}

}  // namespace

TEST_CASE_TEMPLATE("told with a stride", Model, Cosserat, ExtensibleKirchhoff,
                   InextensibleKirchhoff) {
  const auto scene = rich_scene<Spatial>(16);
  const auto all = shape<Model>(scene, 1);
  for (const int stride : {2, 4, 8}) {
    CAPTURE(stride);
    const auto found = shape<Model>(scene, stride);
    CHECK(found.curve.edges() == 16 / stride);
    check_same(found, seen(all, stride));
  }
}

TEST_CASE_TEMPLATE("told with a stride of networks, at whose vertices nodes are", Space,
                   EACH_SPACE) {
  Random random(2);
  const Layout<Space> layout(held<Space>(random));
  const NetworkProblem<Space> problem(layout);
  auto x = Start<Space>(layout).state();
  for (auto& q : x.frames) q = moved(q, Spin<Space>(0.2 * random.vector<Space::spin>()));
  for (std::size_t p = 0; p < x.forces.size(); ++p)
    x.forces[p] = layout.spans()[p].open * random.vector(int(layout.spans()[p].open.cols()));
  const auto all = told(problem, x, 1);
  for (const int stride : {2, 4, 8}) {
    CAPTURE(stride);
    const auto found = told(problem, x, stride);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto &rod = found.rods[i], expected = seen(all.rods[i], stride);
      check_same(rod, expected);
      CHECK(rod.largest.force == doctest::Approx(expected.largest.force).epsilon(1e-14));
      CHECK(rod.largest.moment == doctest::Approx(expected.largest.moment).epsilon(1e-14));
      CHECK(rod.largest.K == doctest::Approx(expected.largest.K).epsilon(1e-14));
      REQUIRE(rod.before.size() == expected.before.size());
      CHECK(!rod.before.empty());
      for (std::size_t k = 0; k < rod.before.size(); ++k) {
        CHECK(rod.before[k].vertex == expected.before[k].vertex);
        CHECK(distance(rod.before[k].force, expected.before[k].force) < 1e-14);
        CHECK(distance(rod.before[k].moment, expected.before[k].moment) == 0);
        CHECK(distance(rod.before[k].K, expected.before[k].K) == 0);
      }
    }
    for (std::size_t v = 0; v < all.nodes.size(); ++v) {
      CHECK(distance(found.nodes[v].position, all.nodes[v].position) < 1e-15);
      CHECK(distance(found.nodes[v].reaction_force, all.nodes[v].reaction_force) < 1e-14);
      CHECK(distance(found.nodes[v].reaction_moment, all.nodes[v].reaction_moment) < 1e-14);
    }
  }
}

TEST_CASE("vertices and centres of the coarse edges are the fine vertices that lie there") {
  const auto scene = rich_scene<Spatial>(16);
  const auto all = shape<Cosserat>(scene, 1), coarse = shape<Cosserat>(scene, 4);
  for (std::size_t j = 0; j < 4; ++j) {
    CHECK(distance(coarse.curve.positions[j], all.curve.positions[4 * j]) < 1e-15);
    CHECK(distance(coarse.moment[j], all.moment[4 * j]) == 0);
    CHECK(distance(coarse.curve.frames[j], all.vertex_frames[4 * j + 2]) < 1e-15);
    CHECK(distance(coarse.force[j], (all.force[4 * j + 1] + all.force[4 * j + 2]) / 2) < 1e-14);
  }
  Vec3 sum = Vec3::Zero(), moment = all.load_moment;
  for (std::size_t j = 0; j < all.load.size(); ++j) {
    sum += all.load[j];
    moment += all.curve.positions[j].cross(all.load[j]);
  }
  Vec3 coarse_sum = Vec3::Zero();
  for (const auto& F : coarse.load) coarse_sum += F;
  CHECK(distance(coarse_sum, sum) < 1e-14);
  CHECK(distance(coarse.load_moment, moment) < 1e-14);
}

TEST_CASE_TEMPLATE("section forces at vertices are exact, also where distributed forces jump",
                   Space, EACH_SPACE) {
  Random random(1);
  const int n = 7;
  const auto rod = random.rod<Space>(n);
  std::vector<Point<Space>> dead, following;
  for (int j = 0; j < n; ++j) {
    dead.push_back(random.vector<Space::dim>());
    following.push_back(random.vector<Space::dim>());
  }
  Loads<Space> loads(n);
  loads.add_force_per_length(rod.grid, dead);
  loads.add_follower_force_per_length(rod.grid, following);
  RodSolution<Space> s;
  s.curve = rod.at_rest(Point<Space>::Zero(), random.rotation<Space>());
  std::vector<Point<Space>> at_vertices(n + 1, Point<Space>::Zero()), on_edges;
  for (int j = n; j-- > 0;) {
    const Point<Space> f = dead[j] + rotate(s.curve.frames[j], following[j]);
    at_vertices[j] = at_vertices[j + 1] + rod.grid.h(j) * f;
  }
  for (int j = 0; j < n; ++j) on_edges.push_back((at_vertices[j] + at_vertices[j + 1]) / 2);
  Vertices<Space>(rod, loads).see(s, on_edges);
  CHECK(distance(s.vertex_force, at_vertices) < 1e-15);
}
