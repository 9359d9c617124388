// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rotation/embedding.hpp>

#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/jets.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// One cell with everything at random, and its energy as a function of the two frames.
template <class Space>
struct Cell {
  using Rotation = typename Space::Rotation;
  Spin<Space> C, K0;
  double Δs;
  Rotation a, b;

  Cell(Random& random, double angle)
      : C(random.between<Space::spin>(0.5, 3)),
        K0(random.vector<Space::spin>()),
        Δs(random.number(0.1, 0.4)),
        a(random.rotation<Space>()),
        b(a * random.rotation<Space>(angle)) {}

  Spin<Space> u() const { return log(a.conjugate() * b); }
  template <Hessian kind = Hessian::exact>
  TurnJet<Space> jet() const {
    const Spin<Space> turn = u();
    return bend_twist<kind>(turn, typename Space::Differential(turn), C, K0, Δs);
  }
  Cell moved_by(const Spin<Space>& φa, const Spin<Space>& φb) const {
    Cell out = *this;
    out.a = moved(a, φa);
    out.b = moved(b, φb);
    return out;
  }
};

const std::vector<double> angles{0, 1e-9, 0.01, 0.7, 0.72, 1.5, 3.14, 3.15, 4.5};

}  // namespace

TEST_CASE_TEMPLATE("the energy of a cell is half the strain times the moment", Space, EACH_SPACE) {
  Random random(1);
  const Cell<Space> cell(random, 2);
  const Spin<Space> strain = cell.u() / cell.Δs - cell.K0;
  const double expected = cell.Δs / 2 * strain.dot(cell.C.cwiseProduct(strain));
  CHECK(cell.jet().energy == doctest::Approx(expected).epsilon(1e-14));
  CHECK(cell.template jet<Hessian::convex>().energy == cell.jet().energy);
}

TEST_CASE_TEMPLATE("bend_twist against differences", Space, EACH_SPACE) {
  Random random(2);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Cell<Space> cell(random, θ);
    const auto jet = cell.jet();
    const Spin<Space> a = random.vector<Space::spin>(), b = random.vector<Space::spin>();
    Vec<twice(Space::spin)> both, twist;
    both << a, b;
    twist << spin_skew(jet.a) * a, spin_skew(jet.b) * b;
    const auto at = [&](double t) { return cell.moved_by(t * a, t * b).jet(); };
    check_slope([&](double t) { return at(t).energy; }, gradient(jet).dot(both), 0.03);
    // The gradient's components turn with the frames; the Hessian is what is left.
    check_derivative([&](double t) { return gradient(at(t)); }, hessian(jet) * both + twist / 2,
                     0.03);
  }
}

TEST_CASE_TEMPLATE("the convex Hessian", Space, EACH_SPACE) {
  Random random(3);
  for (const double θ : angles) {
    CAPTURE(θ);
    Cell<Space> cell(random, θ);
    const auto convex = cell.template jet<Hessian::convex>();
    CHECK(distance(gradient(convex), gradient(cell.jet())) == 0);
    const auto H = hessian(convex);
    const Vector λ = eigenvalues(H);
    CHECK(λ[0] > -1e-13 * H.norm());
    CHECK(λ[Space::spin] > 0.1);  // only turns of both frames cost nothing

    cell.K0 = cell.u() / cell.Δs;  // stress-free: nothing else is left of the exact one
    CHECK(distance(hessian(cell.template jet<Hessian::convex>()), hessian(cell.jet())) <
          1e-12 * H.norm());
  }
}

TEST_CASE("a planar cell is a spatial one that turns about e2") {
  Random random(4);
  for (int i = 0; i < 10; ++i) {
    const Cell<Planar> flat(random, random.number(0, 6));
    const Vec3 C(0.7, flat.C[0], 1.9), u = embed_spin(flat.u());
    const auto plane = flat.jet();
    const auto space =
        bend_twist<Hessian::exact>(u, LogDifferential(u), C, embed_spin(flat.K0), flat.Δs);
    const double scale = 1 + std::abs(plane.bb(0, 0)) + std::abs(plane.b[0]);
    CHECK(std::abs(plane.energy - space.energy) < 1e-14 * (1 + plane.energy));
    CHECK(distance(embed_spin(plane.a), space.a) < 1e-14 * scale);
    CHECK(distance(embed_spin(plane.b), space.b) < 1e-14 * scale);
    CHECK(std::abs(plane.aa(0, 0) - space.aa(1, 1)) < 1e-13 * scale);
    CHECK(std::abs(plane.ab(0, 0) - space.ab(1, 1)) < 1e-13 * scale);
    CHECK(std::abs(plane.bb(0, 0) - space.bb(1, 1)) < 1e-13 * scale);
  }
}

TEST_CASE_TEMPLATE("the moment a cell transmits is the slope of its energy", Space, EACH_SPACE) {
  Random random(5);
  for (const double θ : angles) {
    const Cell<Space> cell(random, θ);
    const auto jet = cell.jet();
    const Spin<Space> M = transmitted_moment<Space>(cell.u(), cell.C, cell.K0, cell.Δs);
    CHECK(distance(M, -jet.a) < 1e-14 * (1 + M.norm()));
    // Seen from space it is the same moment on either side of the cell.
    CHECK(distance(rotate_spin(cell.a, M), rotate_spin(cell.b, jet.b)) < 1e-13 * (1 + M.norm()));
  }
}

TEST_CASE_TEMPLATE("turn_under_moment inverts transmitted_moment", Space, EACH_SPACE) {
  Random random(6);
  for (int i = 0; i < 200; ++i) {
    const Spin<Space> C = random.between<Space::spin>(0.5, 3), K0 = random.vector<Space::spin>();
    const double Δs = random.number(0.01, 0.3);
    // A strain of up to one radian per cell.
    const Spin<Space> m = C.cwiseProduct(random.turn<Space>(random.number(0, 1))) / Δs;
    const Spin<Space> u = turn_under_moment<Space>(m, C, K0, Δs);
    CHECK(distance(transmitted_moment<Space>(u, C, K0, Δs), m) < 1e-13 * (1 + m.norm()));
    CHECK(u.norm() < 3);
  }
  const Spin<Space> K0 = random.vector<Space::spin>();
  const auto at_rest =
      turn_under_moment<Space>(Spin<Space>::Zero(), random.between<Space::spin>(1, 2), K0, 0.5);
  CHECK(distance(at_rest, K0 / 2) < 1e-15);
}

TEST_CASE("an isotropic cell turns about the moment, by any angle") {
  Random random(7);
  for (const double θ : {1e-9, 1., 3., 6.}) {
    const Vec3 u = random.turn<Spatial>(θ);
    const Vec3 found =
        turn_under_moment<Spatial>(u / 0.2 * 1.7, Vec3::Constant(1.7), Vec3::Zero(), 0.2);
    CHECK(distance(found, u) < 1e-14 * θ);
  }
}
