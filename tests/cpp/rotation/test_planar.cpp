// SPDX-License-Identifier: BSD-3-Clause
// The plane is a part of space: turns about e2, vectors without component 2.
#include <pyrod/rotation/embedding.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {
constexpr double π = std::numbers::pi;
}

TEST_CASE("planar rotations are the spatial ones about e2") {
  Random random(1);
  for (int i = 0; i < 50; ++i) {
    const Vec1 φ(random.number(-6.2, 6.2)), ψ = random.vector<1>();
    const Vec2 v = random.vector<2>(), w = random.vector<2>();
    const Angle a = exp(φ);
    const Quaternion q = exp(embed_spin(φ));
    CHECK(distance(embed(a), q) < 1e-15);
    CHECK(distance(embed(rotate(a, v)), rotate(q, embed(v))) < 2e-15);
    CHECK(distance(embed(unrotate(a, v)), unrotate(q, embed(v))) < 2e-15);
    CHECK(distance(embed(Vec2(matrix(a) * v)), matrix(q) * embed(v)) < 2e-15);
    CHECK(distance(embed_spin(log(a)), log(q)) < 4e-15);
    CHECK(distance(embed(moved(a, ψ)), moved(q, embed_spin(ψ))) < 1e-15);
    CHECK(distance(embed(a * exp(ψ)), q * exp(embed_spin(ψ))) < 1e-15);
    CHECK(distance(embed(a.conjugate()), q.conjugate()) < 1e-15);
    CHECK(distance(embed_spin(inverse_cayley(a)), inverse_cayley(q)) <
          1e-14 * (1 + inverse_cayley(q).squaredNorm()));
    CHECK(distance(embed(cayley(ψ)), cayley(embed_spin(ψ))) < 1e-15);
    CHECK(distance(embed_spin(cross(v, w)), cross(embed(v), embed(w))) < 1e-16);
    CHECK(distance(embed(Vec2(skew(v) * ψ)), skew(embed(v)) * embed_spin(ψ)) < 1e-16);
    CHECK(distance(embed_spin(rotate_spin(a, ψ)), rotate_spin(q, embed_spin(ψ))) < 1e-15);
    CHECK(distance(embed_spin(Vec1(spin_skew(φ) * ψ)), spin_skew(embed_spin(φ)) * embed_spin(ψ)) ==
          0);
  }
}

TEST_CASE("a planar angle remembers its turns") {
  const Angle a{7}, b{50};
  CHECK(log(a.conjugate() * b)[0] == 43);
  CHECK(between(a, b, 0.25).radians == 7 + 43. / 4);
  CHECK(between(a, b).radians == 28.5);
  CHECK(moved(b, Vec1(-3.)).radians == 47);
  CHECK(Angle::Identity().radians == 0);
}

TEST_CASE("the planar Cayley map is the tangent of the quarter angle") {
  for (const double θ : {-6., -1., 0., 1e-12, 0.5, π, 6.}) {
    CHECK(inverse_cayley(Angle{θ})[0] == doctest::Approx(std::tan(θ / 4)).epsilon(1e-15));
    CHECK(distance(cayley(inverse_cayley(Angle{θ})), Angle{θ}) < 4e-15);
  }
}

TEST_CASE("the angle turns e3 towards e1") {
  CHECK(distance(rotate(Angle{π / 2}, axis<Planar>()), Vec2(1, 0)) < 1e-15);
}

TEST_CASE_TEMPLATE("what is embedded is restricted to itself", Space, EACH_SPACE) {
  Random random(2);
  const Point<Space> v = random.vector<Space::dim>();
  const Spin<Space> m = random.vector<Space::spin>();
  const auto q = random.rotation<Space>(5);
  CHECK(distance(restrict_point<Space>(embed(v)), v) == 0);
  CHECK(distance(restrict_spin<Space>(embed_spin(m)), m) == 0);
  CHECK(distance(restrict_rotation<Space>(embed(q)), q) < 2e-15);
  CHECK(distance(embed(axis<Space>()), axis<Spatial>()) == 0);
}
