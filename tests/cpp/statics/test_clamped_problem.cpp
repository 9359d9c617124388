// SPDX-License-Identifier: BSD-3-Clause
// A clamped rod as a problem: only the frames of its edges are unknown.
#include <pyrod/rod/energy.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/start/clamped_start.hpp>

#include "support/allocations.hpp"
#include "support/cantilever.hpp"
#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A rod, loads and frames, all at random.
template <class Case>
struct Setting {
  using Space = typename Case::Space;
  using Rotation = typename Space::Rotation;

  Rod<Space> rod;
  Loads<Space> loads;
  Rotation clamp;
  std::vector<Rotation> frames;

  Setting(Random& random, int n, bool moments)
      : rod(in_model(random.rod<Space>(n), Case::Model::kind)),
        loads(n),
        clamp(random.rotation<Space>()),
        frames(random.curve<Space>(rod.grid, 1.5).frames) {
    clamp = frames[0] * random.rotation<Space>(1);
    for (auto& F : loads.force) F = random.vector<Space::dim>();
    if (!moments) return;
    for (auto& M : loads.moment) M = random.vector<Space::spin>();
    loads.end_moment = random.vector<Space::spin>();
  }

  Network<Space> network() const {
    return clamped<Space>(rod, {Point<Space>::Zero(), clamp}, loads);
  }
};

/// A setting as a problem, and its frames as a state.
template <class S>
struct Statics {
  using Space = S;
  Layout<Space> layout;
  NetworkProblem<Space> problem{layout};
  NetworkState<Space> x = ClampedStart<Space>(layout).state();

  template <class Case>
  explicit Statics(const Setting<Case>& setting) : layout(setting.network()) {
    CHECK(layout.determinate());
    CHECK(layout.multipliers() == 0);
    CHECK(layout.unknowns() == Space::spin * setting.rod.edges());
    for (int j = 0; j < setting.rod.edges(); ++j) CHECK(layout.frame_row(j) == Space::spin * j);
    CHECK(problem.least_shift() == 0);
    x.frames = setting.frames;
  }
  Statics(const Statics&) = delete;
  Statics& operator=(const Statics&) = delete;

  auto linearised(const NetworkState<Space>& at, Hessian kind = Hessian::exact) const {
    auto out = problem.linearisation();
    problem.linearise(at, kind, out);
    return out;
  }
};
template <class Case>
Statics(const Setting<Case>&) -> Statics<typename Case::Space>;

template <class Case>
auto linearised(const Setting<Case>& setting, Hessian kind = Hessian::exact) {
  const Statics statics(setting);
  return statics.linearised(statics.x, kind);
}

}  // namespace

TEST_CASE_TEMPLATE("residual and tangent against differences, with and without moments", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  constexpr int spin = Space::spin;
  Random random(1);
  for (const int n : {1, 5, 33})
    for (const bool moments : {false, true}) {
      CAPTURE(n);
      CAPTURE(moments);
      const Setting<Case> setting(random, n, moments);
      const Statics whole(setting);
      const auto& statics = whole.problem;
      const Vector δ = random.vector(spin * n);
      const auto at = [&](double t) {
        NetworkState<Space> q;
        statics.move(whole.x, t * δ, q);
        return whole.linearised(q);
      };
      const auto here = at(0);
      const Vector g = here.gradient;
      CHECK(statics.conservative() == (spin == 1 || !moments));
      if (statics.conservative())
        check_slope([&](double t) { return at(t).energy; }, g.dot(δ), 0.03);

      Vector Hδ, skew_part, turning(spin * n);
      here.hessian.multiply(δ, Hδ);
      statics.multiply_skew(whole.x, δ, skew_part);
      for (int k = 0; k < spin * n; k += spin)  // none at an equilibrium
        turning.segment<spin>(k) =
            spin_skew(Spin<Space>(g.segment<spin>(k))) * δ.segment<spin>(k) / 2;
      if (statics.conservative())
        CHECK(skew_part.norm() == 0);
      else
        CHECK(std::abs(skew_part.dot(δ)) < 1e-14 * skew_part.norm() * δ.norm());
      check_derivative([&](double t) { return at(t).gradient; }, Hδ + skew_part + turning, 0.03);
    }
}

TEST_CASE_TEMPLATE("the energy: bending, less the work of the forces and of what they stretch",
                   Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(2);
  for (const int n : {1, 31, 32, 33, 65}) {
    CAPTURE(n);
    const Setting<Case> setting(random, n, false);
    const auto& grid = setting.rod.grid;
    const auto force = setting.loads.section_forces();
    double expected = 0, magnitude = 0;
    for (int j = 0; j < n; ++j) {
      const Spin<Space> u =
          log((j == 0 ? setting.clamp : setting.frames[j - 1]).conjugate() * setting.frames[j]);
      const Spin<Space> ΔK = u / grid.Δs(j) - setting.rod.K0[j];
      const double bend = grid.Δs(j) / 2 * ΔK.dot(setting.rod.bending[j].cwiseProduct(ΔK));
      const Point<Space> b = unrotate(setting.frames[j], force[j]);
      const Point<Space> S = compliance(setting.rod.stretching[j]);
      const double work = -grid.h(j) * (b.dot(axis<Space>()) + b.dot(S.cwiseProduct(b)) / 2);
      expected += bend + work;
      magnitude += bend + std::abs(work);
    }
    const auto here = linearised(setting);
    CHECK(std::abs(here.energy - expected) < 1e-14 * magnitude);
    CHECK(here.magnitude == doctest::Approx(magnitude).epsilon(1e-13));
  }
}

TEST_CASE_TEMPLATE("the convex Hessian", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(3);
  Setting<Case> setting(random, 33, false);
  const auto exact = linearised(setting);
  const auto convex = linearised(setting, Hessian::convex);
  CHECK(convex.energy == exact.energy);
  CHECK(distance(convex.gradient, exact.gradient) == 0);
  CHECK(eigenvalues(dense(convex.hessian))[0] > 0);

  setting.loads = Loads<Space>(33);
  setting.frames = setting.rod.at_rest(Point<Space>::Zero(), setting.clamp).frames;
  const Dense rest = dense(linearised(setting).hessian);
  const Dense at_rest = dense(linearised(setting, Hessian::convex).hessian);
  CHECK(distance(rest, at_rest) < 1e-12 * rest.norm());
}

TEST_CASE_TEMPLATE("the residual is that of the energy in positions and frames", Space,
                   EACH_SPACE) {
  // With positions placed by the section forces, forces balance on all vertices, and on the frames
  // both gradients are the same.
  constexpr int dim = Space::dim, spin = Space::spin, station = dim + spin, n = 9;
  Random random(4);
  const Setting<With<Space, Cosserat>> setting(random, n, false);
  const auto force = setting.loads.section_forces();
  CosseratCurve<Space> curve{{Point<Space>::Zero()}, setting.frames, setting.clamp, setting.clamp};
  for (int j = 0; j < n; ++j) {
    const Point<Space> S = compliance(setting.rod.stretching[j]);
    const Point<Space> Γ = axis<Space>() + S.cwiseProduct(unrotate(curve.frames[j], force[j]));
    curve.positions.push_back(curve.positions[j] +
                              setting.rod.grid.h(j) * rotate(curve.frames[j], Γ));
  }
  const Vector full = energy(setting.rod, curve).gradient;
  const Vector reduced = linearised(setting).gradient;
  for (int j = 1; j <= n; ++j)
    CHECK(distance(full.segment<dim>(station * j), setting.loads.force[j]) < 1e-13 * full.norm());
  for (int j = 0; j < n; ++j)
    CHECK(distance(full.segment<spin>(station * j + dim), reduced.segment<spin>(spin * j)) <
          1e-13 * full.norm());
}

TEST_CASE_TEMPLATE("a plane problem is a spatial one", Model, Cosserat, ExtensibleKirchhoff,
                   InextensibleKirchhoff) {
  Random random(5);
  const int n = 9;
  const Setting<With<Planar, Model>> flat(random, n, true);
  Setting<With<Spatial, Model>> space(random, n, true);
  space.rod.grid = flat.rod.grid;
  space.clamp = embed(flat.clamp);
  space.loads.end_moment = embed_spin(flat.loads.end_moment);
  for (int j = 0; j <= n; ++j) {
    space.rod.bending[j][1] = flat.rod.bending[j][0];
    space.rod.K0[j] = embed_spin(flat.rod.K0[j]);
    space.loads.force[j] = embed(flat.loads.force[j]);
    if (j == n) break;
    space.rod.stretching[j][0] = flat.rod.stretching[j][0];
    space.rod.stretching[j][2] = flat.rod.stretching[j][1];
    space.loads.moment[j] = embed_spin(flat.loads.moment[j]);
    space.frames[j] = embed(flat.frames[j]);
  }
  std::vector<int> second;
  for (int j = 0; j < n; ++j) second.push_back(3 * j + 1);
  for (const Hessian kind : {Hessian::exact, Hessian::convex}) {
    const auto a = linearised(flat, kind);
    const auto b = linearised(space, kind);
    CHECK(distance(b.gradient(second), a.gradient) < 1e-12);
    CHECK(b.gradient.norm() == doctest::Approx(a.gradient.norm()).epsilon(1e-12));
    const Dense A = dense(a.hessian), B = dense(b.hessian);
    CHECK(distance(B(second, second), A) < 1e-12 * A.norm());
  }
}

TEST_CASE_TEMPLATE("once there is storage, nothing is allocated", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(6);
  const Setting<Case> setting(random, 40, true);
  const Statics whole(setting);
  const auto& statics = whole.problem;
  auto here = statics.linearisation();
  auto q = whole.x;
  const Vector δ = random.vector(Space::spin * 40);
  Vector out(Space::spin * 40);
  const std::size_t before = allocations();
  Eigen::internal::set_is_malloc_allowed(false);  // Eigen's assertions see to it
  statics.linearise(q, Hessian::exact, here);
  statics.linearise(q, Hessian::convex, here);
  statics.move(whole.x, δ, q);
  statics.multiply_skew(q, δ, out);
  here.hessian.multiply(δ, out);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations() == before);
  const std::vector<int> counted(10);
  const int* volatile kept = counted.data();  // or compilers do without it
  CHECK(*kept == 0);
  CHECK(allocations() == before + 1);
}
