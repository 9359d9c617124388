// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/equations/section_force.hpp>

#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Case, Hessian kind = Hessian::exact>
auto term(const typename Case::Space::Rotation& frame, const Point<typename Case::Space>& n,
          const Point<typename Case::Space>& stiffness, double h) {
  using Space = typename Case::Space;
  return edge_term<kind, Space, double>(frame, n, compliance(in<typename Case::Model>(stiffness)),
                                        h);
}

}  // namespace

TEST_CASE_TEMPLATE("an edge under its section force, against differences", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(1);
  for (int i = 0; i < 5; ++i) {
    const auto frame = random.rotation<Space>(6);
    const Point<Space> n = 3 * random.vector<Space::dim>(), C = random.between<Space::dim>(2, 6);
    const Spin<Space> φ = random.vector<Space::spin>();
    const auto at = [&](double t) { return term<Case>(moved(frame, t * φ), n, C, 0.7); };
    const auto jet = at(0);
    check_slope([&](double t) { return at(t).energy; }, jet.gradient.dot(φ));
    check_derivative([&](double t) { return at(t).gradient; },
                     jet.hessian * φ + spin_skew(jet.gradient) * φ / 2);
    const Point<Space> b = unrotate(frame, n);
    const double expected =
        -0.7 *
        (b.dot(axis<Space>()) + b.dot(compliance(in<typename Case::Model>(C)).cwiseProduct(b)) / 2);
    CHECK(jet.energy == doctest::Approx(expected).epsilon(1e-14));
  }
}

TEST_CASE_TEMPLATE("the convex Hessian of an edge", Case, EACH_MODEL) {
  using Space = typename Case::Space;
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const auto frame = random.rotation<Space>(6);
    const Point<Space> n = 3 * random.vector<Space::dim>(), C = random.between<Space::dim>(2, 6);
    const auto exact = term<Case>(frame, n, C, 0.7);
    const auto convex = term<Case, Hessian::convex>(frame, n, C, 0.7);
    CHECK(convex.energy == exact.energy);
    CHECK(distance(convex.gradient, exact.gradient) == 0);
    CHECK(eigenvalues(convex.hessian)[0] >= 0);
    CHECK(convex.hessian.allFinite());
  }
  // Without a force there is nothing.
  const auto idle = term<Case, Hessian::convex>(random.rotation<Space>(), Point<Space>::Zero(),
                                                Point<Space>::Ones(), 0.7);
  CHECK(idle.hessian.norm() == 0);
}

TEST_CASE_TEMPLATE("the convex Hessian leads the edge to the direction of its force", Space,
                   EACH_SPACE) {
  Random random(3);
  using Case = With<Space, InextensibleKirchhoff>;
  for (int i = 0; i < 50; ++i) {
    const auto frame = random.rotation<Space>(3);
    const Point<Space> n = random.vector<Space::dim>();
    const auto jet = term<Case, Hessian::convex>(frame, n, Point<Space>::Ones(), 0.7);
    const double k = jet.hessian(0, 0);
    REQUIRE(k > 0);
    const auto aligned = moved(frame, Spin<Space>(-jet.gradient / k));
    CHECK(distance(rotate(aligned, axis<Space>()), n.normalized()) < 1e-13);
  }
}

TEST_CASE_TEMPLATE("stiffness against turning: limits", Space, EACH_SPACE) {
  const Point<Space> e3 = axis<Space>(), e1 = Point<Space>::Unit(0);
  const auto stiffness = [&](const Point<Space>& b) {
    return secant_stiffness<Space>(b, cross(b, e3));
  };
  CHECK(stiffness(3 * e3) == 3);   // along the force: the force itself
  CHECK(stiffness(-3 * e3) == 0);  // against it
  CHECK(stiffness(Point<Space>::Zero()) == 0);
  CHECK(stiffness(2 * e1) == doctest::Approx(2 / (std::numbers::pi / 2)).epsilon(1e-15));
  for (const double tiny : {1e-3, 1e-8, 1e-200})  // continuous towards the aligned edge
    CHECK(stiffness(3 * e3 + tiny * e1) == doctest::Approx(3).epsilon(1e-6));
}
