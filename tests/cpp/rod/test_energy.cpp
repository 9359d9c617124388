// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rod/energy.hpp>
#include <pyrod/rotation/embedding.hpp>

#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int edges = 5;
const std::vector<HeldEnds> all_ends{{true, false}, {true, true}, {false, false}, {false, true}};

template <class Space>
int station() {
  return Space::dim + Space::spin;
}

template <class Space>
CosseratCurve<Space> moved_by(CosseratCurve<Space> curve, const Vector& δ) {
  for (int j = 0; j <= curve.edges(); ++j)
    curve.positions[j] += δ.segment<Space::dim>(station<Space>() * j);
  for (int j = 0; j < curve.edges(); ++j)
    curve.frames[j] = moved(curve.frames[j],
                            Spin<Space>(δ.segment<Space::spin>(station<Space>() * j + Space::dim)));
  return curve;
}

/// ½ [g] δ on the frames, by which the gradient's components change beside the Hessian's part.
template <class Space>
Vector turning(const Vector& gradient, const Vector& δ) {
  Vector out = Vector::Zero(δ.size());
  for (Eigen::Index k = Space::dim; k < δ.size(); k += station<Space>())
    out.segment<Space::spin>(k) =
        spin_skew(Spin<Space>(gradient.segment<Space::spin>(k))) * δ.segment<Space::spin>(k) / 2;
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("the energy of a rod against differences", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  using Model = typename Case::Model;
  Random random(1);
  const Rod<Space> rod = random.rod<Space>(edges);
  const auto curve = random.curve<Space>(rod.grid, 2);
  for (const HeldEnds held : all_ends) {
    CAPTURE(held.start);
    CAPTURE(held.end);
    const auto jet = energy(in_model(rod, Model::kind), curve, held);
    const Vector δ = random.vector(int(jet.gradient.size()));
    const auto at = [&](double t) {
      return energy(in_model(rod, Model::kind), moved_by<Space>(curve, t * δ), held);
    };
    check_slope([&](double t) { return at(t).energy(); }, jet.gradient.dot(δ), 0.02);
    check_derivative([&](double t) { return at(t).gradient; },
                     jet.hessian * δ + turning<Space>(jet.gradient, δ), 0.02);
    const Eigen::MatrixXd H = jet.hessian;
    CHECK(distance(H, H.transpose()) < 1e-14 * H.norm());
  }
}

TEST_CASE_TEMPLATE("the energy is the sum over strains", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  using Model = typename Case::Model;
  Random random(2);
  const Rod<Space> rod = random.rod<Space>(edges);
  const auto curve = random.curve<Space>(rod.grid, 2);
  const auto found = strains(rod.grid, curve);
  for (const HeldEnds held : all_ends) {
    double bend = 0, stretch = 0;
    for (int j = 0; j <= edges; ++j) {
      if ((j == 0 && !held.start) || (j == edges && !held.end)) continue;
      const Spin<Space> ΔK = found.K[j] - rod.K0[j];
      bend += rod.grid.Δs(j) / 2 * ΔK.dot(rod.bending[j].cwiseProduct(ΔK));
    }
    for (int j = 0; j < edges; ++j) {
      const Point<Space> ΔΓ = found.Γ[j] - axis<Space>();
      const int last = Space::dim - 1;
      for (int i = 0; i <= last; ++i)
        if (i == last ? Model::extensible : Model::shearable)
          stretch += rod.grid.h(j) / 2 * rod.stretching[j][i] * ΔΓ[i] * ΔΓ[i];
    }
    const auto jet = energy(in_model(rod, Model::kind), curve, held);
    CHECK(jet.bend_twist == doctest::Approx(bend).epsilon(1e-13));
    CHECK(jet.stretch_shear == doctest::Approx(stretch).epsilon(1e-13));
    CHECK(jet.energy() == jet.bend_twist + jet.stretch_shear);
  }
}

TEST_CASE_TEMPLATE("at rest a rod stores nothing and is in equilibrium", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(3);
  const Rod<Space> rod = random.rod<Space>(edges);
  const auto rest = rod.at_rest(random.vector<Space::dim>(), random.rotation<Space>());
  const auto jet = energy(in_model(rod, Case::Model::kind), rest, {true, true});
  CHECK(jet.energy() < 1e-28);
  CHECK(jet.gradient.norm() < 1e-12);
}

TEST_CASE_TEMPLATE("the energy does not see a rigid motion; the gradient turns with it", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  using Model = typename Case::Model;
  Random random(4);
  const Rod<Space> rod = random.rod<Space>(edges);
  const auto curve = random.curve<Space>(rod.grid, 2);
  const auto Q = random.rotation<Space>();
  auto turned = curve;
  const Point<Space> t = random.vector<Space::dim>();
  for (auto& r : turned.positions) r = t + rotate(Q, r);
  for (auto& q : turned.frames) q = Q * q;
  turned.start_frame = Q * curve.start_frame;
  turned.end_frame = Q * curve.end_frame;
  const auto before = energy(in_model(rod, Model::kind), curve, {true, true});
  const auto after = energy(in_model(rod, Model::kind), turned, {true, true});
  CHECK(after.energy() == doctest::Approx(before.energy()).epsilon(1e-13));
  const Vector g = before.gradient, turned_g = after.gradient;
  const double scale = g.norm();
  for (int k = 0; k < g.size(); k += station<Space>()) {
    const Point<Space> r = g.segment<Space::dim>(k);
    CHECK(distance(turned_g.segment<Space::dim>(k), rotate(Q, r)) < 1e-13 * scale);
    if (k / station<Space>() == edges) break;
    const Spin<Space> φ = g.segment<Space::spin>(k + Space::dim);
    CHECK(distance(turned_g.segment<Space::spin>(k + Space::dim), φ) < 1e-13 * scale);
  }
}

TEST_CASE_TEMPLATE("the Hessian has the entries that neighbours moment", Space, EACH_SPACE) {
  Random random(5);
  constexpr int d = Space::dim, s = Space::spin;
  for (const int n : {1, 2, 7}) {
    const Rod<Space> rod = random.rod<Space>(n);
    const auto jet = energy(rod, random.curve<Space>(rod.grid));
    // n + 1 positions with themselves and the next; n frames with themselves and the next; each
    // frame with the two positions at its ends.
    const int expected =
        (n + 1) * d * d + 2 * n * d * d + n * s * s + 2 * (n - 1) * s * s + 2 * 2 * n * d * s;
    CHECK(jet.hessian.rows() == (d + s) * n + d);
    CHECK(jet.hessian.nonZeros() == expected);
  }
}

TEST_CASE_TEMPLATE("a planar rod is a spatial one in its plane", Model, Cosserat,
                   ExtensibleKirchhoff, InextensibleKirchhoff) {
  Random random(6);
  const Rod<Planar> flat = random.rod<Planar>(edges);
  Rod<Spatial> rod{flat.grid, {}, {}, {}};
  for (const auto& C : flat.bending) rod.bending.push_back(Vec3(0.9, C[0], 1.3));
  for (const auto& C : flat.stretching) rod.stretching.push_back(Vec3(C[0], 17, C[1]));
  for (const auto& K : flat.K0) rod.K0.push_back(embed_spin(K));
  const auto plane = random.curve<Planar>(flat.grid, 3);
  CosseratCurve<Spatial> space{{}, {}, embed(plane.start_frame), embed(plane.end_frame)};
  for (const auto& r : plane.positions) space.positions.push_back(embed(r));
  for (const auto& q : plane.frames) space.frames.push_back(embed(q));

  const auto a = energy(in_model(flat, Model::kind), plane, {true, true});
  const auto b = energy(in_model(rod, Model::kind), space, {true, true});
  CHECK(b.bend_twist == doctest::Approx(a.bend_twist).epsilon(1e-13));
  CHECK(b.stretch_shear == doctest::Approx(a.stretch_shear).epsilon(1e-13));
  std::vector<int> kept;  // unknowns r1, r3, φ2 of the spatial rod
  for (int j = 0; j <= edges; ++j)
    for (const int k : {0, 2, 4})
      if (6 * j + k < b.gradient.size()) kept.push_back(6 * j + k);
  REQUIRE(Eigen::Index(kept.size()) == a.gradient.size());
  const Eigen::MatrixXd H = b.hessian;
  CHECK(distance(b.gradient(kept), a.gradient) < 1e-12 * a.gradient.norm());
  CHECK(b.gradient.norm() == doctest::Approx(a.gradient.norm()).epsilon(1e-13));  // no others
  CHECK(distance(H(kept, kept), Eigen::MatrixXd(a.hessian)) < 1e-12 * a.hessian.norm());
}

TEST_CASE("what no rod can be made of is refused by name") {
  Random random(7);
  const Rod<Spatial> good = random.rod<Spatial>(3);
  CHECK_NOTHROW(good.check());
  auto rod = good;
  rod.bending.pop_back();
  CHECK_REFUSED("bending: expected 4 rows (one per vertex), got 3", rod.check());
  rod = good, rod.stretching.clear();
  CHECK_REFUSED("stretching: expected 3 rows (one per edge), got 0", rod.check());
  rod = good, rod.K0.pop_back();
  CHECK_REFUSED("K0: expected 4 rows", rod.check());
  rod = good, rod.bending[2][1] = 0;
  CHECK_REFUSED("bending[2]:", rod.check());
  rod = good, rod.bending[1][0] = std::numeric_limits<double>::infinity();
  CHECK_REFUSED("bending[1]:", rod.check());
  rod = good, rod.stretching[1][2] = -1;
  CHECK_REFUSED("stretching[1]:", rod.check());
  rod = good, rod.stretching[1][2] = std::numeric_limits<double>::infinity();
  CHECK_NOTHROW(rod.check());
  rod = good, rod.K0[3][0] = std::nan("");
  CHECK_REFUSED("K0[3]: expected finite", rod.check());
  rod = good, rod.K0[1] = Vec3(0, 3.2 / rod.grid.Δs(1), 0);
  CHECK_REFUSED("K0[1]: the rod at rest turns by 3.2 rad at this vertex", rod.check());
}

TEST_CASE_TEMPLATE("a uniform rod", Space, EACH_SPACE) {
  Random random(8);
  const Spin<Space> C = random.vector<Space::spin>(), K0 = random.vector<Space::spin>();
  const Point<Space> S = random.vector<Space::dim>();
  const auto rod = Rod<Space>::uniform(Grid::uniform(1, 3), C, S, K0);
  CHECK(rod.bending == std::vector<Spin<Space>>(4, C));
  CHECK(rod.K0 == std::vector<Spin<Space>>(4, K0));
  CHECK(rod.stretching == std::vector<Point<Space>>(3, S));
  CHECK(Rod<Space>::uniform(Grid::uniform(1, 3), C, S).K0[0] == Spin<Space>::Zero());
}
