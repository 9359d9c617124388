// SPDX-License-Identifier: BSD-3-Clause
// Closed forms, balance, invariance.
#include "support/cantilever.hpp"

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <cmath>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;

template <class Space>
Spin<Space> bending() {
  if constexpr (Space::spin == 1)
    return Vec1(1.);
  else
    return Vec3(1.3, 1, 0.7);
}

template <class Space>
Point<Space> stretching(double size = 50) {
  return size * Point<Space>::Ones();
}

/// Section moments in balance with what acts on the edges between them.
template <class Space>
double imbalance(const Scene<Space>& scene, const Solved<Space>& solution) {
  double worst = 0, scale = 0;
  for (int j = 0; j < scene.rod.edges(); ++j) {
    const Point<Space> edge = solution.curve.positions[j + 1] - solution.curve.positions[j];
    const Spin<Space> change = solution.moment[j] - solution.moment[j + 1];
    const Spin<Space> load = cross(edge, solution.force[j]) + scene.loads.moment[j];
    worst = std::max(worst, distance(change, load));
    scale = std::max(scale, solution.moment[j].norm());
  }
  return worst / scale;
}

}  // namespace

TEST_CASE("a pure moment in the plane is exact on any grid") {
  for (const int n : {2, 3, 10, 64})
    for (const double turns : {0.1, 1., 10.}) {
      if (2 * π * turns / n > 6) continue;
      CAPTURE(n);
      CAPTURE(turns);
      auto scene = uniform_scene<Planar>(n, Vec1(3.), stretching<Planar>());
      scene.loads.add_moment(scene.rod.grid, Vec1(3 * 2 * π * turns), 1);
      const auto solution = solved<Planar, Cosserat>(scene);
      CHECK(solution.status == Status::converged);
      CHECK(solution.record.size() <= 2);
      for (const auto& K : solution.strains.K) CHECK(std::abs(K[0] / (2 * π * turns) - 1) < 1e-12);
      CHECK(solution.curve.end_frame.radians == doctest::Approx(2 * π * turns).epsilon(1e-12));
      CHECK(solution.energy() ==
            doctest::Approx(3 * std::pow(2 * π * turns, 2) / 2).epsilon(1e-12));
      CHECK(solution.index == 0);
      if (turns >= 1) CHECK(solution.curve.positions[n].norm() < 1e-12);  // closed
    }
}

TEST_CASE_TEMPLATE("without loads a rod keeps its shape", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(1);
  const int n = 40;
  const Spin<Space> helix = random.turn<Space>(8);
  auto scene = uniform_scene<Space>(n, bending<Space>(), stretching<Space>(), helix);
  scene.r0 = random.vector<Space::dim>();
  scene.q0 = random.rotation<Space>();
  for (const bool varying : {false, true}) {
    if (varying) scene.rod = random.rod<Space>(n);
    const auto solution = solved<Space, typename Case::Model>(scene);
    const auto rest = scene.rod.at_rest(scene.r0, scene.q0);
    CHECK(solution.status == Status::converged);
    CHECK(solution.index == 0);
    CHECK(distance(solution.curve.positions, rest.positions) < 1e-12);
    CHECK(distance(solution.curve.frames, rest.frames) < 1e-12);
    CHECK(distance(solution.curve.end_frame, rest.end_frame) < 1e-12);
    CHECK(solution.energy() < 1e-22);
    for (int j = 0; j <= n; ++j) CHECK(solution.moment[j].norm() < 1e-11);
  }
}

TEST_CASE_TEMPLATE("a load may be as small as it likes", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(5);
  const int n = 40;
  const Point<Space> F = random.vector<Space::dim>();
  auto scene =
      uniform_scene<Space>(n, bending<Space>(), stretching<Space>(), random.turn<Space>(8));
  const auto rest = scene.rod.at_rest(scene.r0, scene.q0);
  Point<Space> unit = Point<Space>::Zero();  // tip's way under a unit load
  for (const double size : {1e-4, 1e-6, 1e-8, 1e-10, 1e-12, 1e-16, 1e-30, 1e-300}) {
    CAPTURE(size);
    scene.loads = Loads<Space>(n);
    scene.loads.add_force(scene.rod.grid, size * F, 1);
    const auto solution = solved<Space, typename Case::Model>(scene);
    CHECK(solution.status == Status::converged);
    CHECK(solution.index == 0);
    CHECK(solution.record.size() <= 4);
    const Point<Space> way = solution.curve.positions[n] - rest.positions[n];
    if (size == 1e-4)
      unit = way / size;
    else
      CHECK(distance(way, size * unit) < 1e-3 * size * unit.norm() + 1e-13);
  }
  CHECK(unit.norm() > 1e-3);
}

TEST_CASE_TEMPLATE("a straight rod under nothing is done at once", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  const auto scene = uniform_scene<Space>(10, bending<Space>(), stretching<Space>());
  const auto solution = solved<Space, typename Case::Model>(scene);
  CHECK(solution.status == Status::converged);
  CHECK(solution.record.size() <= 2);
  CHECK(distance(solution.curve.positions[10], axis<Space>()) < 1e-15);
  CHECK(solution.energy() == 0);
  CHECK(solution.residual == 0);
}

TEST_CASE("a dead moment on an isotropic rod in space makes a helix, exactly") {
  Random random(2);
  for (const double size : {0.5, 5., 30.}) {
    CAPTURE(size);
    const int n = 30;
    auto scene = uniform_scene<Spatial>(n, Vec3::Constant(2), stretching<Spatial>());
    scene.q0 = random.rotation<Spatial>();
    const Vec3 m = random.turn<Spatial>(size);
    scene.loads.add_moment(scene.rod.grid, m, 1);
    const auto solution = solved<Spatial, InextensibleKirchhoff>(scene);
    CHECK(solution.status == Status::converged);
    CHECK(solution.index == -1);  // no potential, no index
    const Vec3 K = unrotate(scene.q0, m) / 2;
    for (const auto& found : solution.strains.K) CHECK(distance(found, K) < 1e-12 * (1 + K.norm()));
    for (const auto& found : solution.moment) CHECK(distance(found, m) < 1e-12 * m.norm());
    CHECK(distance(solution.curve.end_frame, scene.q0 * exp(K)) < 1e-12);
  }
}

TEST_CASE_TEMPLATE("a pull along the axis stretches", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  const double strain = Case::Model::extensible ? 5. / 50 : 0;
  auto scene = uniform_scene<Space>(8, bending<Space>(), stretching<Space>());
  scene.loads.add_force(scene.rod.grid, 5 * axis<Space>(), 1);
  const auto solution = solved<Space, typename Case::Model>(scene);
  CHECK(distance(solution.curve.positions[8], (1 + strain) * axis<Space>()) < 1e-14);
  CHECK(solution.stretch_shear_energy == doctest::Approx(50 * strain * strain / 2).epsilon(1e-13));
  CHECK(solution.bend_twist_energy < 1e-28);
  CHECK(distance(solution.material_force[3], 5 * axis<Space>()) < 1e-14);
}

TEST_CASE("a small side force: Timoshenko's beam") {  // F L³/3EI + F L/GA, up to h² and F²
  const int n = 200;
  const double F = 1e-5;
  auto scene = uniform_scene<Planar>(n, Vec1(2.), Vec2(5, 70));
  scene.loads.add_force(scene.rod.grid, Vec2(F, 0), 1);
  const double sheared = solved<Planar, Cosserat>(scene).curve.positions[n][0];
  const double rigid = solved<Planar, ExtensibleKirchhoff>(scene).curve.positions[n][0];
  CHECK(rigid / F == doctest::Approx(1. / 6).epsilon(2e-5));
  CHECK((sheared - rigid) / F == doctest::Approx(1. / 5).epsilon(1e-6));
}

TEST_CASE("the elastica under a side force, by elliptic integrals") {
  for (const double F : {1., 10.}) {
    // sqrt(F) = K(k) − F(k, φ), sin φ = 1/(k √2): Bisshopp and Drucker, 1945.
    double low = std::sqrt(0.5), high = 1;
    const auto φ = [](double k) { return std::asin(std::min(1., 1 / (k * std::sqrt(2)))); };
    for (int i = 0; i < 100; ++i) {
      const double k = (low + high) / 2;
      (std::comp_ellint_1(k) - std::ellint_1(k, φ(k)) < std::sqrt(F) ? low : high) = k;
    }
    const double k = low;
    const Vec2 tip(1 - 2 / std::sqrt(F) * (std::comp_ellint_2(k) - std::ellint_2(k, φ(k))),
                   std::sqrt(2 * (2 * k * k - 1) / F));
    std::vector<Vec2> found;
    for (const int n : {64, 128, 256}) {
      auto scene = uniform_scene<Planar>(n, Vec1(1.), stretching<Planar>());
      scene.loads.add_force(scene.rod.grid, Vec2(F, 0), 1);
      const auto solution = solved<Planar, InextensibleKirchhoff>(scene);
      found.push_back(solution.curve.positions[n]);
      CHECK(solution.moment[0][0] == doctest::Approx(F * found.back()[1]).epsilon(1e-12));
    }
    CHECK(std::log2(distance(found[0], tip) / distance(found[1], tip)) ==
          doctest::Approx(2).epsilon(0.02));
    CHECK(std::log2(distance(found[1], tip) / distance(found[2], tip)) ==
          doctest::Approx(2).epsilon(0.01));
    CHECK(distance((4 * found[2] - found[1]) / 3, tip) < 2e-7);
  }
}

TEST_CASE("beyond Euler's load the straight rod is an equilibrium, but not a stable one") {
  const int n = 200;
  for (const auto& [load, index] : {std::pair{0.99, 0}, {1.01, 1}, {8.9, 1}, {9.1, 2}}) {
    CAPTURE(load);
    auto flat = uniform_scene<Planar>(n, Vec1(1.), stretching<Planar>());
    flat.loads.add_force(flat.rod.grid, Vec2(0, -load * π * π / 4), 1);
    const auto plane = solved<Planar, InextensibleKirchhoff>(flat, Options{}, Trace{}, false);
    CHECK(plane.status == Status::converged);
    CHECK(plane.index == index);
    CHECK(distance(plane.curve.positions[n], Vec2(0, 1)) < 1e-14);

    auto scene = uniform_scene<Spatial>(n, Vec3(1, 1, 1), stretching<Spatial>());
    scene.loads.add_force(scene.rod.grid, Vec3(0, 0, -load * π * π / 4), 1);
    const auto space = solved<Spatial, InextensibleKirchhoff>(scene, Options{}, Trace{}, false);
    CHECK(space.index == 2 * index);
  }
  // Started beside it, the rod buckles.
  auto scene = uniform_scene<Planar>(n, Vec1(1.), stretching<Planar>());
  scene.loads.add_force(scene.rod.grid, Vec2(0, -4), 1);
  const auto buckled =
      solved<Planar, InextensibleKirchhoff>(scene, std::vector<Angle>(n, Angle{0.1}));
  CHECK(buckled.status == Status::converged);
  CHECK(buckled.index == 0);
  CHECK(buckled.curve.positions[n][0] > 0.3);
}

TEST_CASE_TEMPLATE("section forces and moments are in exact balance with the loads", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  for (const int n : {2, 10, 100}) {
    const auto scene = rich_scene<Space>(n);
    const auto solution = solved<Space, typename Case::Model>(scene);
    CHECK(solution.status == Status::converged);
    CHECK(imbalance(scene, solution) < 1e-12);
    CHECK(distance(solution.moment[n], scene.loads.end_moment) < 1e-13);
    CHECK(distance(solution.force, scene.loads.section_forces()) == 0);
    for (int j = 0; j < n; ++j)
      CHECK(distance(rotate(solution.curve.frames[j], solution.material_force[j]),
                     solution.force[j]) < 1e-13);
    for (int j = 0; j <= n; ++j) {
      const Spin<Space> M =
          scene.rod.bending[j].cwiseProduct(solution.strains.K[j] - scene.rod.K0[j]);
      CHECK(distance(solution.material_moment[j], M) < 1e-12 * (1 + M.norm()));
    }
  }
}

TEST_CASE_TEMPLATE("what a solution says of itself is consistent", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  auto scene = rich_scene<Space>(20);
  Random random(3);
  scene.r0 = random.vector<Space::dim>();
  scene.q0 = random.rotation<Space>(1);
  const auto solution = solved<Space, typename Case::Model>(scene);
  CHECK(distance(solution.curve.positions[0], scene.r0) == 0);
  CHECK(distance(solution.curve.start_frame, scene.q0) == 0);
  const auto found = strains(scene.rod.grid, solution.curve);
  CHECK(distance(found.K, solution.strains.K) < 1e-11);
  CHECK(distance(found.Γ, solution.strains.Γ) < 1e-12);
  double bend = 0, stretch = 0;
  for (int j = 0; j <= 20; ++j) {
    const Spin<Space> ΔK = found.K[j] - scene.rod.K0[j];
    bend += scene.rod.grid.Δs(j) / 2 * ΔK.dot(scene.rod.bending[j].cwiseProduct(ΔK));
    if (j == 20) break;
    const Point<Space> C = scene.rod.stretching[j], ΔΓ = found.Γ[j] - axis<Space>();
    stretch += scene.rod.grid.h(j) / 2 * ΔΓ.dot(C.cwiseProduct(ΔΓ));
    for (int i = 0; i < Space::dim; ++i)  // what the model constrains stays
      if (i == Space::dim - 1 ? !Case::Model::extensible : !Case::Model::shearable)
        CHECK(std::abs(ΔΓ[i]) < 1e-14);
  }
  CHECK(solution.bend_twist_energy == doctest::Approx(bend).epsilon(1e-11));
  CHECK(solution.stretch_shear_energy == doctest::Approx(stretch).epsilon(1e-11));
  CHECK(solution.energy() == solution.bend_twist_energy + solution.stretch_shear_energy);
}

TEST_CASE_TEMPLATE("from its own solution a solve is done at once", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  const auto scene = rich_scene<Space>(20);
  const auto solution = solved<Space, typename Case::Model>(scene);
  const auto again = solved<Space, typename Case::Model>(scene, solution.curve.frames);
  CHECK(again.status == Status::converged);
  CHECK(again.record.size() == 1);
  CHECK(again.index == solution.index);
  CHECK(distance(again.curve.positions, solution.curve.positions) < 1e-13);
}

TEST_CASE_TEMPLATE("a rigid motion of clamp and loads moves the solution", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(4);
  const auto scene = rich_scene<Space>(30);
  const auto Q = random.rotation<Space>();
  auto moved = scene;
  moved.r0 = random.vector<Space::dim>();
  moved.q0 = Q * scene.q0;
  for (auto& F : moved.loads.force) F = rotate(Q, F);
  for (auto& M : moved.loads.moment) M = rotate_spin(Q, M);
  moved.loads.end_moment = rotate_spin(Q, moved.loads.end_moment);
  const auto before = solved<Space, typename Case::Model>(scene);
  const auto after = solved<Space, typename Case::Model>(moved);
  CHECK(after.record.size() == before.record.size());
  CHECK(after.energy() == doctest::Approx(before.energy()).epsilon(1e-12));
  CHECK(after.index == before.index);
  for (int j = 0; j <= 30; ++j) {
    const Point<Space> r = moved.r0 + rotate(Q, before.curve.positions[j]);
    CHECK(distance(after.curve.positions[j], r) < 1e-12);
    CHECK(distance(after.strains.K[j], before.strains.K[j]) < 1e-11);
    CHECK(distance(after.moment[j], rotate_spin(Q, before.moment[j])) < 1e-11);
  }
}

TEST_CASE_TEMPLATE("units do not matter: a strand of DNA, a cable across a fjord", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  const int n = 30;
  const auto unit = solved<Space, typename Case::Model>(rich_scene<Space>(n));
  for (const auto& [L, EI] : {std::pair{3.4e-8, 2e-28}, {1e4, 3e7}}) {
    CAPTURE(L);
    const auto solution = solved<Space, typename Case::Model>(rich_scene<Space>(n, L, EI));
    CHECK(solution.status == Status::converged);
    CHECK(solution.record.size() == unit.record.size());
    CHECK(solution.index == unit.index);
    CHECK(solution.energy() * L / EI == doctest::Approx(unit.energy()).epsilon(1e-12));
    for (int j = 0; j <= n; ++j) {
      CHECK(distance(solution.curve.positions[j] / L, unit.curve.positions[j]) < 1e-12);
      CHECK(distance(solution.moment[j] * (L / EI), unit.moment[j]) < 1e-11);
    }
  }
}
