// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/ladder/rung.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class T, class Make>
std::vector<T> some(int count, const Make& make) {
  std::vector<T> out;
  for (int i = 0; i < count; ++i) out.push_back(make());
  return out;
}

RodSolution<Spatial> random_rod(Random& random, int n) {
  const auto vector = [&] { return random.vector<3>(); };
  const auto frame = [&] { return random.rotation<Spatial>(); };
  RodSolution<Spatial> out;
  out.curve.positions = some<Vec3>(n + 1, vector);
  out.curve.frames = some<Quaternion>(n, frame);
  out.strains.K = some<Vec3>(n + 1, vector);
  out.strains.Γ = some<Vec3>(n, vector);
  out.force = some<Vec3>(n, vector);
  out.moment = some<Vec3>(n + 1, vector);
  out.material_moment = some<Vec3>(n + 1, vector);
  out.vertex_frames = some<Quaternion>(n + 1, frame);
  out.vertex_force = some<Vec3>(n + 1, vector);
  out.load = some<Vec3>(n + 1, vector);
  out.load_moment = vector();
  out.bend_twist_energy = random.number(0, 1);
  out.stretch_shear_energy = random.number(0, 1);
  return out;
}

/// Two rods and two nodes of which all is random.
Solution<Spatial> random_scene(int seed = 1) {
  Random random(seed);
  Solution<Spatial> out;
  out.rods = {random_rod(random, 4), random_rod(random, 2)};
  for (int v = 0; v < 2; ++v)
    out.nodes.push_back(
        {random.vector<3>(), random.vector<3>(), random.rotation<Spatial>(), random.vector<3>()});
  return out;
}

void negate(Quaternion& q) { q.coeffs() *= -1; }

/// Rows follow each other; only the three numbers of each load moment have none.
void check_tiling(const std::vector<Row>& rows, Eigen::Index size, int left_out, int kinds) {
  int end = 0, covered = 0;
  std::vector<bool> named(std::size_t(kinds), false);
  for (const auto& row : rows) {
    CHECK(row.first >= end);
    end = row.first + row.width;
    covered += row.width;
    REQUIRE(row.quantity >= 0);
    REQUIRE(row.quantity < kinds);
    named[std::size_t(row.quantity)] = true;
  }
  CHECK(end == size);
  CHECK(covered + left_out == size);
  CHECK(std::ranges::count(named, true) == kinds);
}

}  // namespace

TEST_CASE("every number has its row, and every quantity numbers") {
  const Rung rung(random_scene(), 2, nullptr);
  check_tiling(rung.vertex_rows(), rung.vertices().size(), 2 * 3, vertex_quantities);
  check_tiling(rung.edge_rows(), rung.edges().size(), 0, edge_quantities);
}

TEST_CASE("the energy of all rods is judged as well") {
  const Rung rung(random_scene(), 2, nullptr);
  const auto &a = rung.rods[0], &b = rung.rods[1];
  const double energy =
      a.bend_twist_energy + a.stretch_shear_energy + b.bend_twist_energy + b.stretch_shear_energy;
  const Row row = rung.vertex_rows().back();
  CHECK(row.quantity == int(Quantity::energy));
  CHECK(row.width == 1);
  CHECK(rung.vertices()[row.first] == doctest::Approx(energy).epsilon(1e-15));
}

TEST_CASE("numbers go back to where they came from") {
  const Rung from(random_scene(1), 2, nullptr);
  Rung to(random_scene(2), 2, nullptr);
  REQUIRE((to.vertices() - from.vertices()).norm() > 1);
  to.set(from.vertices(), from.edges());
  CHECK((to.vertices() - from.vertices()).lpNorm<Eigen::Infinity>() < 1e-15);
  CHECK((to.edges() - from.edges()).lpNorm<Eigen::Infinity>() < 1e-15);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(distance(to.rods[i].moment, from.rods[i].moment) == 0);
    CHECK(distance(to.rods[i].strains.Γ, from.rods[i].strains.Γ) == 0);
    CHECK(to.rods[i].bend_twist_energy == from.rods[i].bend_twist_energy);
    CHECK(distance(to.nodes[i].reaction_moment, from.nodes[i].reaction_moment) == 0);
  }
}

TEST_CASE("frames come back as such") {
  const Rung from(random_scene(), 2, nullptr);
  Rung to = from;
  to.set(1.25 * from.vertices(), 0.75 * from.edges());
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(distance(to.rods[i].vertex_frames, from.rods[i].vertex_frames) < 1e-15);
    CHECK(distance(to.rods[i].curve.frames, from.rods[i].curve.frames) < 1e-15);
    CHECK(distance(to.nodes[i].frame, from.nodes[i].frame) < 1e-15);
    CHECK(distance(to.nodes[i].position, Vec3(1.25 * from.nodes[i].position)) < 1e-15);
    CHECK(distance(to.rods[i].force[0], Vec3(0.75 * from.rods[i].force[0])) < 1e-15);
  }
}

TEST_CASE("without numbers of edges these stay") {
  const Rung from(random_scene(1), 2, nullptr);
  Rung to(random_scene(2), 2, nullptr);
  const Vector edges = to.edges();
  to.set(from.vertices(), Vector());
  CHECK((to.edges() - edges).lpNorm<Eigen::Infinity>() < 1e-15);
}

TEST_CASE("frames take the signs of the rung before") {
  const auto scene = random_scene();
  const Rung before(Solution<Spatial>(scene), 1, nullptr);
  auto turned = scene;
  negate(turned.rods[0].vertex_frames[2]);
  negate(turned.rods[1].curve.frames[1]);
  negate(turned.nodes[1].frame);
  const Rung now(Solution<Spatial>(turned), 2, &before);
  CHECK((now.vertices() - before.vertices()).norm() == 0);
  CHECK((now.edges() - before.edges()).norm() == 0);
  CHECK((Rung(std::move(turned), 2, nullptr).vertices() - before.vertices()).norm() > 1);
}

TEST_CASE("the expansion is even where every cell bends about its moment") {
  auto scene = random_scene();
  for (auto& rod : scene.rods)
    for (std::size_t j = 0; j < rod.strains.K.size(); ++j)
      rod.material_moment[j] = 3 * rod.strains.K[j];
  CHECK(Rung(Solution<Spatial>(scene), 1, nullptr).one_axis);
  scene.rods[1].material_moment[1] += Vec3(1e-6, 0, 0);
  CHECK_FALSE(Rung(std::move(scene), 1, nullptr).one_axis);
}
