// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/turning.hpp>

#include "support/near.hpp"
#include "support/random.hpp"
#include "support/ulp.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
constexpr double ε = std::numeric_limits<double>::epsilon();

using Long3 = Eigen::Matrix<long double, 3, 1>;

/// The angle between a and a + d, where the sum is exact: its sine does not cancel.
long double exact_angle(const Vec3& a, const Vec3& d) {
  const Long3 A = a.cast<long double>(), D = d.cast<long double>();
  return std::atan2(A.cross(D).norm(), A.dot(A + D));
}

Quaternion least_turn(const Vec3& a, const Vec3& b) { return Turning(a, b).rotation(); }

}  // namespace

TEST_CASE("small angles keep all their digits, however small") {
  const Vec3 a = Vec3::UnitX();
  for (double x = 1; x > 1e-150; x /= 7) {
    CAPTURE(x);
    for (const Vec3& b : {Vec3(1, x, 0), Vec3(1, 0, -x), Vec3(1, 0.6 * x, 0.8 * x)}) {
      const long double exact = exact_angle(a, b - Vec3(1, 0, 0));
      CHECK(ulps(Turning(a, b).angle(), exact) < 4);
      CHECK(ulps(Turning(b, a).angle(), exact) < 4);
    }
  }
}

TEST_CASE("small angles between directions that are not simple") {
  Random random(1);
  double worst = 0;
  for (double x = 1e-15; x < 1; x *= 1.1) {
    const Vec3 a = random.vector<3>(), b = a + x * random.vector<3>();
    const Vec3 d = b - a;
    if (a + d != b) continue;  // d is exact
    const long double exact = exact_angle(a, d);
    worst = std::max(worst, double(std::abs(Turning(a, b).angle() - exact) / exact));
  }
  CHECK(worst < 4 * ε);
}

TEST_CASE("the whole range of angles") {
  for (double θ = 0; θ <= π; θ += 1e-3) {
    const Vec3 b(std::cos(θ), 0.6 * std::sin(θ), 0.8 * std::sin(θ));
    CHECK(std::abs(Turning(3 * Vec3::UnitX(), 0.1 * b).angle() - θ) < 5e-16 * (1 + θ));
  }
  CHECK(Turning(Vec3::UnitX(), Vec3::UnitY()).angle() == π / 2);
  CHECK(Turning(Vec3(1, 2, 3), Vec3(2, 4, 6)).angle() == 0);
  CHECK(Turning(Vec3(1, 2, 3), Vec3(-2, -4, -6)).angle() == π);
}

TEST_CASE("near pi the rotation keeps the digits of what is missing") {
  for (double x = 1; x > 1e-150; x /= 7) {
    CAPTURE(x);
    const Turning turning(Vec3::UnitX(), Vec3(-1, 0.6 * x, 0.8 * x));
    const long double missing = exact_angle(Vec3::UnitX(), Vec3(0, 0.6 * x, 0.8 * x));
    CHECK(ulps(turning.rotation().w(), std::sin(missing / 2)) < 6);
    CHECK(std::abs(turning.angle() - (π - double(missing))) <= 8 * ε);  // π from there on
    if (missing > 9 * ε) CHECK(std::abs(turning.angle() - (π - double(missing))) <= 2 * ε);
    CHECK(distance(turning.binormal(), Vec3(0, -0.8, 0.6)) < 3e-16);
  }
}

TEST_CASE("the rotation takes a to b about an axis across both, by the angle") {
  Random random(2);
  int obtuse = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 a = random.turn<Spatial>(random.number(0.1, 10));
    const Vec3 b = i % 3 == 0   ? random.turn<Spatial>(1)
                   : i % 3 == 1 ? Vec3(a + 1e-6 * random.vector<3>())
                                : Vec3(-a + 1e-6 * random.vector<3>());
    const Turning turning(a, b);
    const Quaternion B = turning.rotation();
    obtuse += a.dot(b) < 0;
    CHECK(std::abs(B.norm() - 1) < 8e-16);
    CHECK(B.w() >= 0);
    CHECK(distance(rotate(B, a.normalized()), b.normalized()) < 2e-15);
    CHECK(std::abs(B.vec().dot(a.normalized())) < 4e-16);
    CHECK(std::abs(B.vec().dot(b.normalized())) < 4e-16);
    CHECK(std::abs(log(B).norm() - turning.angle()) < 2e-15);
    CHECK(distance(B.vec(), std::sin(turning.angle() / 2) * turning.binormal()) < 1e-15);
  }
  CHECK(obtuse > 700);
  CHECK(obtuse < 1300);
}

TEST_CASE("the rotation at and around a right angle, where its formula changes") {
  for (const double c : {-1e-3, -1e-17, -0., 0., 1e-17, 1e-3}) {
    const Vec3 b(c, 1, 0);
    CHECK(distance(least_turn(Vec3::UnitX(), b), exp(Vec3(0, 0, π / 2 - std::atan(c)))) < 4e-16);
  }
  CHECK(distance(least_turn(Vec3::UnitX(), Vec3(5, 0, 0)), Quaternion::Identity()) == 0);
}

TEST_CASE("powers of two in front of the directions change nothing") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Vec3 a = random.vector<3>(), b = random.vector<3>();
    const double large = 0x1p199, small = 0x1p-199;
    CHECK(Turning(large * a, large * b).angle() == Turning(a, b).angle());
    CHECK(Turning(small * a, small * b).angle() == Turning(a, b).angle());
    CHECK(distance(least_turn(large * a, large * b), least_turn(a, b)) == 0);
    CHECK(distance(least_turn(small * a, small * b), least_turn(a, b)) == 0);
    CHECK(distance(Turning(small * a, large * b).binormal(), Turning(a, b).binormal()) == 0);
  }
}

TEST_CASE("the angle of a point: on each branch, on their boundaries, on either side") {
  double worst = 0;
  const auto check = [&](double sine, double cosine) {
    const long double exact =
        std::atan2(static_cast<long double>(sine), static_cast<long double>(cosine));
    for (const double scale : {1., 0x1p500, 0x1p-500}) {
      worst = std::max(worst, ulps(signed_angle(scale * sine, scale * cosine), exact));
      CHECK(signed_angle(-scale * sine, scale * cosine) ==
            -signed_angle(scale * sine, scale * cosine));
    }
  };
  for (int i = -4; i <= 4; ++i) {  // |sine| = cosine/4
    check(0.3, 1.2 + i * ε);
    check(0.25 + i * ε / 4, 1);
  }
  for (double φ = 1e-3; φ < 3.14; φ += 1e-3) check(std::sin(φ), std::cos(φ));
  for (double x = 1; x > 1e-120; x /= 3) check(x, 1);
  for (double x = 1; x > 8.01 * ε; x /= 1.1) check(x, -1);
  CHECK(worst < 2);  // three roundings: series, quotient, product
}

TEST_CASE("pi is positive, within rounding of either side") {
  for (const double size : {1., 1e-200, 1e200}) {
    CAPTURE(size);
    for (const double sine : {0., -0., 1e-16, -1e-16, 8 * ε, -8 * ε})
      CHECK(signed_angle(sine * size, -size) == π);
    CHECK(signed_angle(-8.1 * ε * size, -size) == doctest::Approx(-π).epsilon(1e-15));
    CHECK(signed_angle(-8.1 * ε * size, -size) > -π);
    CHECK(signed_angle(8.1 * ε * size, -size) < π);
    CHECK(signed_angle(0, size) == 0);
    CHECK(signed_angle(size, 0) == π / 2);
    CHECK(signed_angle(-size, 0) == -π / 2);
  }
}

TEST_CASE("straight and antiparallel within a tolerance, never both") {
  const Vec3 a(2, 0, 0);
  const double x = 1e-3;
  const Turning along(a, Vec3(1, x, 0)), against(a, Vec3(-1, 0, x)), across(a, Vec3(0, 1, 0));
  CHECK(along.straight(1.0001 * x));
  CHECK_FALSE(along.straight(0.9999 * x));
  CHECK_FALSE(along.antiparallel(10));
  CHECK(against.antiparallel(1.0001 * x));
  CHECK_FALSE(against.antiparallel(0.9999 * x));
  CHECK_FALSE(against.straight(10));
  CHECK_FALSE(across.straight(1e10));
  CHECK_FALSE(across.antiparallel(1e10));
  CHECK(Turning(a, Vec3(3, 0, 0)).straight(0));
  CHECK_FALSE(Turning(a, Vec3(3, 0, 0)).antiparallel(0));
  CHECK_FALSE(Turning(a, Vec3(-3, 0, 0)).straight(0));
  CHECK(Turning(a, Vec3(-3, 0, 0)).antiparallel(0));
}
