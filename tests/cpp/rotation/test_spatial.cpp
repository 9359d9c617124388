// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rotation/spatial.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
const std::vector<double> angles{0,   1e-300, 1e-160, 1e-12,        1e-7,        1e-4,
                                 0.1, 1,      2.5,    3.1,          π - 1e-10,   π + 1e-10,
                                 3.2, 4,      6,      2 * π - 1e-3, 2 * π - 1e-6};

}  // namespace

TEST_CASE("log inverts exp up to two pi and never flips the sign") {
  Random random(1);
  for (const double θ : angles) {
    CAPTURE(θ);
    for (int i = 0; i < 20; ++i) {
      const Vec3 u = random.turn<Spatial>(θ);
      const Quaternion p = exp(u);
      CHECK(std::abs(p.norm() - 1) < 4e-16);
      CHECK(distance(log(p), u) <= 1e-15 * u.norm() + 1e-15 * θ);
      CHECK(distance(exp(log(p)), p) < 1e-15);
      CHECK((log(p).norm() > π) == (p.w() < 0));  // a turn beyond π is not taken the short way
    }
  }
}

TEST_CASE("exp turns about its vector, right-handed") {
  const Vec3 u(0, 0, π / 2);
  CHECK(distance(rotate(exp(u), Vec3::UnitX()), Vec3::UnitY()) < 1e-15);
  CHECK(distance(exp(Vec3(2 * π, 0, 0)), quaternion(-1, Vec3::Zero())) < 1e-15);
}

TEST_CASE("exp of parallel vectors adds up") {
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Vec3 u = random.turn<Spatial>(1);
    const double a = random.number(-3, 3), b = random.number(-3, 3);
    CHECK(distance(exp(Vec3(a * u)) * exp(Vec3(b * u)), exp(Vec3((a + b) * u))) < 1e-15);
  }
}

TEST_CASE("rotate, unrotate and matrix agree") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Quaternion q = random.rotation<Spatial>(random.number(0, 2 * π));
    const Vec3 v = random.vector<3>();
    const Mat3 R = matrix(q);
    CHECK(distance(rotate(q, v), R * v) < 2e-15);
    CHECK(distance(unrotate(q, v), R.transpose() * v) < 2e-15);
    CHECK(distance(unrotate(q, rotate(q, v)), v) < 2e-15);
    CHECK(std::abs(R.determinant() - 1) < 4e-15);
    CHECK(distance(rotate(q.conjugate(), v), unrotate(q, v)) < 2e-15);
  }
}

TEST_CASE("Rodrigues' formula gives the same matrix") {
  Random random(4);
  for (const double θ : angles) {
    const Vec3 u = random.turn<Spatial>(θ);
    const Mat3 U = skew(u);
    const Mat3 R = Mat3::Identity() + sinc(θ) * U + versinc(θ) * U * U;
    CHECK(distance(matrix(exp(u)), R) < 4e-15);
  }
}

TEST_CASE("skew is the cross product") {
  Random random(5);
  const Vec3 a = random.vector<3>(), b = random.vector<3>();
  CHECK(distance(skew(a) * b, a.cross(b)) == 0);
  CHECK(distance(skew(a).transpose(), -skew(a)) == 0);
}

TEST_CASE("the Cayley map: inverse, and tan of the quarter angle") {
  Random random(6);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Vec3 u = random.turn<Spatial>(θ);
    const Vec3 q = inverse_cayley(exp(u));
    const double quarter = std::tan(θ / 4);
    CHECK(std::abs(q.norm() - quarter) <= 1e-15 * quarter * (1 + quarter) + 1e-150);
    if (θ > 1e-100) CHECK(distance(q / q.norm(), u / θ) < 1e-14);
    const Quaternion p = cayley(q);
    CHECK(std::abs(p.norm() - 1) < 4e-16);
    CHECK(distance(p, exp(u)) < 2e-15);
  }
  CHECK(distance(inverse_cayley(cayley(Vec3(3, -4, 12))), Vec3(3, -4, 12)) < 1e-12);
}

TEST_CASE("moved multiplies on the right and keeps the length") {
  Random random(7);
  Quaternion q = random.rotation<Spatial>(), product = q;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 φ = random.vector<3>();
    q = moved(q, φ);
    product = product * exp(φ);
  }
  CHECK(std::abs(q.norm() - 1) < 4e-16);
  CHECK(distance(q, product) < 1e-13);
}

TEST_CASE("between divides the turn") {
  Random random(8);
  for (const double θ : {1e-9, 1., 3., 5., 6.2}) {
    CAPTURE(θ);
    const Quaternion a = random.rotation<Spatial>();
    const Vec3 u = random.turn<Spatial>(θ);
    const Quaternion b = a * exp(u);
    CHECK(distance(between(a, b, 0), a) < 1e-15);
    CHECK(distance(between(a, b, 1), b) < 2e-15);
    CHECK(distance(between(a, b, 0.3), a * exp(Vec3(0.3 * u))) < 2e-15);
    CHECK(distance(between(a, b), a * exp(Vec3(u / 2))) < 2e-15);
  }
}
