// SPDX-License-Identifier: BSD-3-Clause
// What is told at some of the vertices is what is told at all of them, there.
#include <pyrod/statics/ladder/rung.hpp>
#include <pyrod/statics/solution/cantilever_shape.hpp>

#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Model>
RodSolution<Spatial> shape(const Scene<Spatial>& scene, int stride) {
  const auto rod = in_model(scene.rod, Model::kind);
  const Vec3 r0(0.3, -0.2, 0.5);
  const Quaternion q0 = exp(Vec3(0.4, -0.1, 0.2));
  auto frames = scene.rod.at_rest(r0, q0).frames;  // no equilibrium, which does not matter
  return CantileverShape<Spatial>(rod, scene.loads, stride).solution(r0, q0, std::move(frames));
}

}  // namespace

TEST_CASE_TEMPLATE("told with a stride", Model, Cosserat, ExtensibleKirchhoff,
                   InextensibleKirchhoff) {
  const auto scene = rich_scene<Spatial>(16);
  const auto all = shape<Model>(scene, 1);
  for (const int stride : {2, 4, 8}) {
    CAPTURE(stride);
    const auto told = shape<Model>(scene, stride), expected = seen(all, stride);
    CHECK(told.curve.edges() == 16 / stride);
    CHECK(distance(told.curve.positions, expected.curve.positions) < 1e-15);
    CHECK(distance(told.curve.frames, expected.curve.frames) < 1e-15);
    CHECK(distance(told.vertex_frames, expected.vertex_frames) == 0);
    CHECK(distance(told.vertex_force, expected.vertex_force) < 1e-14);
    CHECK(distance(told.force, expected.force) < 1e-14);
    CHECK(distance(told.strains.Γ, expected.strains.Γ) < 1e-15);
    CHECK(distance(told.strains.K, expected.strains.K) == 0);
    CHECK(distance(told.moment, expected.moment) == 0);
    CHECK(distance(told.material_moment, expected.material_moment) == 0);
    CHECK(distance(told.load, expected.load) < 1e-14);
    CHECK(distance(told.load_moment, expected.load_moment) < 1e-14);
    CHECK(told.bend_twist_energy == all.bend_twist_energy);
    CHECK(told.stretch_shear_energy == all.stretch_shear_energy);
  }
}

TEST_CASE("vertices and centres of the coarse edges are the fine vertices that lie there") {
  const auto scene = rich_scene<Spatial>(16);
  const auto all = shape<Cosserat>(scene, 1), told = shape<Cosserat>(scene, 4);
  for (std::size_t j = 0; j < 4; ++j) {
    CHECK(distance(told.curve.positions[j], all.curve.positions[4 * j]) < 1e-15);
    CHECK(distance(told.moment[j], all.moment[4 * j]) == 0);
    CHECK(distance(told.curve.frames[j], all.vertex_frames[4 * j + 2]) < 1e-15);
    CHECK(distance(told.force[j], (all.force[4 * j + 1] + all.force[4 * j + 2]) / 2) < 1e-14);
  }
  Vec3 sum = Vec3::Zero(), moment = all.load_moment;
  for (std::size_t j = 0; j < all.load.size(); ++j) {
    sum += all.load[j];
    moment += all.curve.positions[j].cross(all.load[j]);
  }
  Vec3 told_sum = Vec3::Zero();
  for (const auto& F : told.load) told_sum += F;
  CHECK(distance(told_sum, sum) < 1e-14);
  CHECK(distance(told.load_moment, moment) < 1e-14);
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
