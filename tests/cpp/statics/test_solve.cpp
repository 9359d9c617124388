// SPDX-License-Identifier: BSD-3-Clause
#include "support/cantilever.hpp"

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int n = 20;

/// The spatial rod and loads that a planar scene stands for, in the frame of a clamp.
Scene<Spatial> in_space(const Scene<Planar>& flat, const Placement<Spatial>& clamp) {
  Scene<Spatial> out{{flat.rod.grid, {}, {}, {}}};
  for (const auto& C : flat.rod.bending) out.rod.bending.push_back(Vec3(1.4, C[0], 0.9));
  for (const auto& C : flat.rod.stretching) out.rod.stretching.push_back(Vec3(C[0], 33, C[1]));
  for (const auto& K : flat.rod.K0) out.rod.K0.push_back(embed_spin(K));
  for (int j = 0; j <= n; ++j) {
    out.loads.force[j] = rotate(clamp.frame, embed(flat.loads.force[j]));
    if (j < n) out.loads.moment[j] = rotate(clamp.frame, embed_spin(flat.loads.moment[j]));
  }
  out.loads.end_moment = rotate(clamp.frame, embed_spin(flat.loads.end_moment));
  return out;
}

Placement<Spatial> any_clamp() {
  Random random(1);
  return {random.vector<3>(), random.rotation<Spatial>()};
}

}  // namespace

TEST_CASE_TEMPLATE("a planar solution is put where the clamp is", Model, Cosserat,
                   ExtensibleKirchhoff, InextensibleKirchhoff) {
  const Placement<Spatial> clamp = any_clamp();
  const auto flat = rich_scene<Planar>(n);
  const auto space = in_space(flat, clamp);
  const auto expected = solved<Planar, Model>(flat);
  const auto found = solved(space.rod, Dimension::planar, Model::kind, clamp, space.loads);
  REQUIRE(found.status == Status::converged);
  CHECK(found.index == expected.index);
  CHECK(found.record.size() == expected.record.size());
  CHECK(found.bend_twist_energy == doctest::Approx(expected.bend_twist_energy).epsilon(1e-13));
  CHECK(found.stretch_shear_energy ==
        doctest::Approx(expected.stretch_shear_energy).epsilon(1e-13));
  CHECK(std::abs(found.residual - expected.residual) < 1e-12);
  const auto frame = [&](Angle a) { return clamp.frame * embed(a); };
  CHECK(distance(found.curve.start_frame, clamp.frame) == 0);
  CHECK(distance(found.curve.end_frame, frame(expected.curve.end_frame)) < 1e-13);
  for (int j = 0; j <= n; ++j) {
    const Vec3 r = clamp.position + rotate(clamp.frame, embed(expected.curve.positions[j]));
    CHECK(distance(found.curve.positions[j], r) < 1e-13);
    CHECK(distance(found.strains.K[j], embed_spin(expected.strains.K[j])) < 1e-11);
    CHECK(distance(found.material_moment[j], embed_spin(expected.material_moment[j])) < 1e-11);
    CHECK(distance(found.moment[j], rotate(clamp.frame, embed_spin(expected.moment[j]))) < 1e-11);
    if (j == n) break;
    CHECK(distance(found.curve.frames[j], frame(expected.curve.frames[j])) < 1e-13);
    CHECK(distance(found.strains.Γ[j], embed(expected.strains.Γ[j])) < 1e-13);
    CHECK(distance(found.force[j], rotate(clamp.frame, embed(expected.force[j]))) < 1e-13);
    CHECK(distance(found.material_force[j], embed(expected.material_force[j])) < 1e-12);
  }
}

TEST_CASE_TEMPLATE("what happens in a plane is the same in space", Model, Cosserat,
                   ExtensibleKirchhoff, InextensibleKirchhoff) {
  const Placement<Spatial> clamp = any_clamp();
  const auto scene = in_space(rich_scene<Planar>(n), clamp);
  const auto plane = solved(scene.rod, Dimension::planar, Model::kind, clamp, scene.loads);
  const auto space = solved(scene.rod, Dimension::spatial, Model::kind, clamp, scene.loads);
  REQUIRE(space.status == Status::converged);
  CHECK(distance(space.curve.positions, plane.curve.positions) < 1e-12);
  CHECK(distance(space.moment, plane.moment) < 1e-11);
  CHECK(distance(space.force, plane.force) < 1e-13);
  CHECK(space.energy() == doctest::Approx(plane.energy()).epsilon(1e-12));
}

TEST_CASE("a start near the solution is trusted") {
  const Placement<Spatial> clamp = any_clamp();
  const auto scene = in_space(rich_scene<Planar>(n), clamp);
  for (const Dimension dimension : {Dimension::planar, Dimension::spatial}) {
    const auto first = solved(scene.rod, dimension, ModelKind::cosserat, clamp, scene.loads);
    const auto again =
        solved(scene.rod, dimension, ModelKind::cosserat, clamp, scene.loads, first.curve.frames);
    CHECK(again.status == Status::converged);
    CHECK(again.record.size() == 1);
    CHECK(distance(again.curve.positions, first.curve.positions) < 1e-12);
  }
}

TEST_CASE("the three models are three") {
  const auto scene = rich_scene<Spatial>(n);
  std::vector<Vec3> tips;
  for (const ModelKind model :
       {ModelKind::cosserat, ModelKind::extensible, ModelKind::inextensible})
    tips.push_back(
        solved(scene.rod, Dimension::spatial, model, {}, scene.loads).curve.positions[n]);
  CHECK(distance(tips[0], solved<Spatial, Cosserat>(scene).curve.positions[n]) < 1e-13);
  CHECK(distance(tips[1], solved<Spatial, ExtensibleKirchhoff>(scene).curve.positions[n]) < 1e-13);
  CHECK(distance(tips[2], solved<Spatial, InextensibleKirchhoff>(scene).curve.positions[n]) <
        1e-13);
  CHECK(distance(tips[0], tips[1]) > 1e-3);
  CHECK(distance(tips[1], tips[2]) > 1e-3);
}

TEST_CASE("what leaves the plane is refused in the plane, and only there") {
  const Placement<Spatial> clamp = any_clamp();
  const auto good = in_space(rich_scene<Planar>(n), clamp);
  const auto attempt = [&](const Scene<Spatial>& scene, Dimension dimension) {
    return refusal(
        [&] { solved(scene.rod, dimension, ModelKind::inextensible, clamp, scene.loads); });
  };
  const auto begins = [](const std::string& text, const char* with) {
    CAPTURE(text);
    CHECK(text.rfind(with, 0) == 0);
  };
  CHECK(attempt(good, Dimension::planar) == "(not refused)");
  auto scene = good;
  scene.rod.K0[3][2] = 1e-9;
  begins(attempt(scene, Dimension::planar), "K0[3]: a planar rod bends about director 2 only");
  CHECK(attempt(scene, Dimension::spatial) == "(not refused)");
  scene = good, scene.loads.force[4] += 1e-9 * rotate(clamp.frame, Vec3::UnitY());
  begins(attempt(scene, Dimension::planar), "loads: a force (");
  CHECK(attempt(scene, Dimension::spatial) == "(not refused)");
  scene = good, scene.loads.end_moment += 1e-9 * rotate(clamp.frame, Vec3::UnitZ());
  begins(attempt(scene, Dimension::planar), "loads: a moment (");
  scene = good, scene.loads.moment[2] += 1e-9 * rotate(clamp.frame, Vec3::UnitX());
  begins(attempt(scene, Dimension::planar), "loads: a moment (");
}
