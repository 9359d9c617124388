// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/measure.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
constexpr Measure all[] = {Measure::log, Measure::chord, Measure::cayley};
const std::vector<double> angles{0,     1e-300, 1e-12, 1e-4,     0.1,      1,
                                 π / 2, 2,      3,     π - 1e-3, π - 1e-6, π - 1e-9};

/// The slope of a chord ends at π: what rounding of the chord, of size 2, does to the angle.
double rounding(double θ, Measure measure) {
  return measure == Measure::chord ? 4e-16 + 4e-16 / std::cos(θ / 2) : 1e-15;
}

}  // namespace

TEST_CASE("sizes of turns that have simple ones") {
  CHECK(measured(π / 3, Measure::chord) == doctest::Approx(1).epsilon(1e-15));
  CHECK(measured(π, Measure::chord) == 2);
  CHECK(measured(π / 2, Measure::cayley) == doctest::Approx(2).epsilon(1e-15));
  CHECK(measured(-2 * π / 3, Measure::cayley) == doctest::Approx(-2 * std::sqrt(3)).epsilon(1e-15));
  CHECK(measured(π, Measure::cayley) > 1e16);
  CHECK(measured(-7., Measure::log) == -7);
  CHECK(name(Measure::log) == "log");
  CHECK(name(Measure::chord) == "chord");
  CHECK(name(Measure::cayley) == "cayley");
}

TEST_CASE("the measures agree up to the third power of the angle, with the factors of the series") {
  for (const double θ : {0.1, 0.03, 0.01}) {
    CHECK((measured(θ, Measure::chord) - θ) / std::pow(θ, 3) ==
          doctest::Approx(-1. / 24 + θ * θ / 1920).epsilon(1e-8));
    CHECK((measured(θ, Measure::cayley) - θ) / std::pow(θ, 3) ==
          doctest::Approx(1. / 12 + θ * θ / 120 + 17 * std::pow(θ, 4) / 20160).epsilon(1e-7));
  }
}

TEST_CASE("the angle of a size is the angle that was measured") {
  for (const Measure measure : all)
    for (const double θ : angles)
      for (const double sign : {1., -1.}) {
        CAPTURE(name(measure));
        CAPTURE(θ);
        CHECK(std::abs(angle_of(measured(sign * θ, measure), measure) - sign * θ) <=
              rounding(θ, measure) * std::min(θ, 1.));
      }
  CHECK(angle_of(2, Measure::chord) == π);
  CHECK(std::isnan(angle_of(2.0001, Measure::chord)));
  CHECK(angle_of(std::numeric_limits<double>::infinity(), Measure::cayley) == π);
}

TEST_CASE("the vector of a turn lies along its axis and has the size of its angle") {
  Random random(1);
  for (const Measure measure : all)
    for (const double θ : angles) {
      if (θ > π - 1e-4 && measure == Measure::cayley) continue;  // the next test
      CAPTURE(name(measure));
      CAPTURE(θ);
      const Vec3 axis = random.turn<Spatial>(1);
      const Vec3 u = measured(exp(Vec3(θ * axis)), measure);
      const double size = measured(θ, measure);
      CHECK(distance(u, size * axis) <= 2e-15 * size * (1 + size));
    }
}

TEST_CASE("towards pi the Cayley vector grows as 4/(pi - angle)") {
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const Vec3 u = measured(exp(Vec3(0, π - gap, 0)), Measure::cayley);
    CHECK(u.y() * gap / 4 == doctest::Approx(1).epsilon(gap * gap + 4e-16 / gap));
  }
}

TEST_CASE("quaternions: the turn of the vector is the turn that was measured") {
  Random random(2);
  for (const Measure measure : all)
    for (const double θ : angles) {
      CAPTURE(name(measure));
      CAPTURE(θ);
      const Quaternion W = exp(random.turn<Spatial>(θ)), a = random.rotation<Spatial>();
      CHECK(distance(turn_of(measured(W, measure), measure), W) < rounding(θ, measure));
      const Quaternion b = turned(a, measured(W, measure), measure);
      CHECK(distance(b, a * W) < 2 * rounding(θ, measure));
      CHECK(std::abs(b.norm() - 1) < 4e-16);
    }
}

TEST_CASE("beyond pi only the logarithm knows the turn") {
  Random random(3);
  for (const double θ : {π + 1e-3, 4., 6.}) {
    const Quaternion W = exp(random.turn<Spatial>(θ));
    CHECK(distance(turn_of(measured(W, Measure::log), Measure::log), W) < 2e-15);
    // the frame is right, the way there the short one
    CHECK(distance(turn_of(measured(W, Measure::cayley), Measure::cayley).coeffs(), -W.coeffs()) <
          1e-15);
    // a chord is as long on both sides
    CHECK(distance(turn_of(measured(W, Measure::chord), Measure::chord),
                   quaternion(-W.w(), W.vec())) < rounding(2 * π - θ, Measure::chord));
  }
}

TEST_CASE("a chord of 2 is half a turn about any axis; a longer one is none") {
  Random random(4);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 axis = random.turn<Spatial>(1);
    // rounding of the length, 4e-16, is seen by its square root
    const Quaternion W = quaternion(0, axis);
    CHECK(distance(turn_of(measured(W, Measure::chord), Measure::chord), W) < 3e-8);
  }
  CHECK(std::isnan(turn_of(Vec3(0, 2.0001, 0), Measure::chord).w()));
}

TEST_CASE("an infinite or huge Cayley vector is half a turn") {
  CHECK(distance(turn_of(Vec3(0, 1e17, 0), Measure::cayley), quaternion(0, Vec3::UnitY())) < 1e-16);
}

TEST_CASE("many turns one after the other leave the length of quaternions alone") {
  Random random(5);
  for (const Measure measure : all) {
    Quaternion q = random.rotation<Spatial>();
    for (int i = 0; i < 10000; ++i) q = turned(q, random.vector<3>(), measure);
    CHECK(std::abs(q.norm() - 1) < 4e-16);
  }
}

TEST_CASE("planar turns are measured like the spatial ones about e2") {
  Random random(6);
  for (const Measure measure : all)
    for (int i = 0; i < 50; ++i) {
      CAPTURE(name(measure));
      const Angle a{random.number(-3, 3)}, start{random.number(-3, 3)};
      const Vec1 u = measured(a, measure);
      CHECK(u[0] == measured(a.radians, measure));
      CHECK(distance(embed_spin(u), measured(embed(a), measure)) < 1e-14 * (1 + u.norm()));
      CHECK(distance(turn_of(u, measure), a) < 2 * rounding(a.radians, measure));
      CHECK(
          distance(embed(turned(start, u, measure)), turned(embed(start), embed_spin(u), measure)) <
          2 * rounding(a.radians, measure));
    }
}
