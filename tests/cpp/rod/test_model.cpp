// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rod/stretch_shear.hpp>

#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// The compliance of an edge of a rod in the model.
template <class Space>
Point<Space> compliance_in(ModelKind model, const Point<Space>& stiffness) {
  const auto rod = Rod<Space>::uniform(Grid::uniform(1, 2), Spin<Space>::Ones(), stiffness);
  return compliance(in_model(rod, model).stretching[1]);
}

}  // namespace

TEST_CASE("each model leaves its own strains free") {
  const Vec3 stiffness(2, 4, 8);
  CHECK(compliance_in<Spatial>(ModelKind::cosserat, stiffness) == Vec3(0.5, 0.25, 0.125));
  CHECK(compliance_in<Spatial>(ModelKind::extensible, stiffness) == Vec3(0, 0, 0.125));
  CHECK(compliance_in<Spatial>(ModelKind::inextensible, stiffness) == Vec3::Zero());
  const Vec2 flat(2, 8);
  CHECK(compliance_in<Planar>(ModelKind::cosserat, flat) == Vec2(0.5, 0.125));
  CHECK(compliance_in<Planar>(ModelKind::extensible, flat) == Vec2(0, 0.125));
  CHECK(compliance_in<Planar>(ModelKind::inextensible, flat) == Vec2::Zero());
  const double rigid = std::numeric_limits<double>::infinity();
  CHECK(compliance_in<Spatial>(ModelKind::cosserat, Vec3::Constant(rigid)) == Vec3::Zero());
}

TEST_CASE_TEMPLATE("compliance and storing stiffness are inverse where a strain is free", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(1);
  const Point<Space> C = random.between<Space::dim>(1, 3), b = random.vector<Space::dim>();
  const Point<Space> of_model = in<typename Case::Model>(C);
  const Point<Space> Sb = compliance(of_model).cwiseProduct(b);
  const Point<Space> storing = storing_stiffness(of_model);
  CHECK(distance(storing.cwiseProduct(Sb), Sb.cwiseProduct(C)) < 1e-15);
  for (int i = 0; i < Space::dim; ++i) CHECK((storing[i] != 0) == (Sb[i] != 0));
}

TEST_CASE("what is rigid stores no energy") {
  const double rigid = std::numeric_limits<double>::infinity();
  CHECK(storing_stiffness(Vec3(rigid, rigid, 3)) == Vec3(0, 0, 3));
  CHECK(storing_stiffness(in<ExtensibleKirchhoff>(Vec2(2, rigid))) == Vec2::Zero());
}

TEST_CASE_TEMPLATE("stretch_shear against differences", Space, EACH_SPACE) {
  constexpr int dim = Space::dim, spin = Space::spin;
  using Jet = EdgeEnergyJet<Space>;
  Random random(2);
  for (int i = 0; i < 5; ++i) {
    const Point<Space> a = random.vector<dim>(), b = random.vector<dim>();
    const Point<Space> C = random.between<dim>(1, 5);
    const auto frame = random.rotation<Space>(6);
    const Vec<Jet::size> δ = random.vector<Jet::size>();
    const auto at = [&](double t) {
      const Vec<Jet::size> x = t * δ;
      return stretch_shear<Space>(a + x.template head<dim>(), b + x.template tail<dim>(),
                                  moved(frame, Spin<Space>(x.template segment<spin>(dim))), C, 0.6);
    };
    const Jet jet = at(0);
    check_slope([&](double t) { return at(t).energy; }, jet.gradient.dot(δ));
    Vec<Jet::size> turning = Vec<Jet::size>::Zero();
    turning.template segment<spin>(dim) =
        spin_skew(Spin<Space>(jet.gradient.template segment<spin>(dim))) *
        δ.template segment<spin>(dim) / 2;
    check_derivative([&](double t) { return at(t).gradient; }, jet.hessian * δ + turning);
    CHECK(distance(jet.hessian, jet.hessian.transpose()) < 1e-14 * jet.hessian.norm());
  }
}

TEST_CASE_TEMPLATE("stretching an edge: energy ½ h EA ε², force EA ε", Space, EACH_SPACE) {
  const Point<Space> e3 = axis<Space>(), C = Point<Space>::Constant(7);
  const auto jet = stretch_shear<Space>(Point<Space>::Zero(), 0.5 * 1.1 * e3,
                                        Space::Rotation::Identity(), C, 0.5);
  CHECK(jet.energy == doctest::Approx(0.5 / 2 * 7 * 0.01).epsilon(1e-14));
  CHECK(distance(jet.gradient.template tail<Space::dim>(), 0.7 * e3) < 1e-14);
}
