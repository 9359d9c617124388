// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rotation/differential.hpp>

#include "support/difference.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
const std::vector<double> angles{0, 1e-300, 1e-12, 1e-8, 1e-4, 0.1, 0.7, 0.71, 1, 2, π, 4, 5, 5.5};

/// The largest step of a difference: the logarithm has a pole at 2π.
double step(double θ) { return 0.02 * (2 * π - θ); }

}  // namespace

TEST_CASE("the differentials of exp and log are inverse to each other below two pi") {
  Random random(1);
  auto all = angles;
  all.insert(all.end(), {6., 6.2, 6.28, 2 * π - 1e-6});
  for (const double θ : all) {
    CAPTURE(θ);
    const Vec3 u = random.turn<Spatial>(θ);
    const Mat3 D = exp_differential(u), T = LogDifferential(u).T();
    const double condition = 1 + T.norm();
    CHECK(distance(D * T, Mat3::Identity()) < 2e-15 * condition);
    CHECK(distance(T * D, Mat3::Identity()) < 2e-15 * condition);
    CHECK(distance(T * matrix(exp(u)).transpose(), T.transpose()) < 2e-15 * condition);
  }
}

TEST_CASE("exp_differential against differences") {
  Random random(2);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Vec3 u = random.turn<Spatial>(θ), du = random.vector<3>();
    const Quaternion back = exp(u).conjugate();
    check_derivative([&](double t) { return log(back * exp(Vec3(u + t * du))); },
                     exp_differential(u) * du);
  }
}

TEST_CASE("T against differences, for increments from the right and from the left") {
  Random random(3);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Vec3 u = random.turn<Spatial>(θ), φ = random.vector<3>();
    const Quaternion W = exp(u);
    const Mat3 T = LogDifferential(u).T();
    check_derivative([&](double t) { return log(W * exp(Vec3(t * φ))); }, T * φ, step(θ));
    check_derivative([&](double t) { return log(exp(Vec3(t * φ)) * W); }, T.transpose() * φ,
                     step(θ));
  }
}

TEST_CASE("N against differences: d(Tᵀm) = (N + ½[m]) du, d(T m) = (N − ½[m]) du") {
  Random random(4);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Vec3 u = random.turn<Spatial>(θ), m = random.vector<3>(), du = random.vector<3>();
    const Mat3 N = LogDifferential(u).N(m);
    const auto T = [&](double t) { return LogDifferential(Vec3(u + t * du)).T(); };
    check_derivative([&](double t) -> Vec3 { return T(t).transpose() * m; }, (N + skew(m) / 2) * du,
                     step(θ));
    check_derivative([&](double t) -> Vec3 { return T(t) * m; }, (N - skew(m) / 2) * du, step(θ));
  }
}

TEST_CASE("the coefficients a LogDifferential reports are those of its angle") {
  const LogDifferential dlog(Vec3(0.6, 0, -0.8));
  CHECK(dlog.θ2() == doctest::Approx(1).epsilon(1e-15));
  CHECK(dlog.c() == doctest::Approx(log_coefficients(1).c).epsilon(1e-15));
  CHECK(dlog.slope() == doctest::Approx(log_coefficients(1).slope).epsilon(1e-15));
}

TEST_CASE("the Cayley map's differential and its inverse") {
  Random random(5);
  for (const double size : {0., 1e-12, 1e-3, 0.5, 1., 3., 20.}) {
    CAPTURE(size);
    const Vec3 q = random.turn<Spatial>(size), dq = random.turn<Spatial>(1 + size);
    const Mat3 C = cayley_differential(q), inverse = inverse_cayley_differential(q);
    CHECK(distance(C * inverse, Mat3::Identity()) < 1e-14);
    const Quaternion p = cayley(q);
    check_derivative([&](double t) { return log(p.conjugate() * cayley(Vec3(q + t * dq))); },
                     C * dq);
    const Vec3 φ = random.vector<3>();
    check_derivative([&](double t) { return inverse_cayley(p * exp(Vec3(t * φ))); }, inverse * φ,
                     0.1 / (1 + size));
  }
}

TEST_CASE("in the plane T is one and its derivative vanishes") {
  const PlanarLogDifferential dlog(Vec1(40.));
  CHECK(dlog.T()(0, 0) == 1);
  CHECK(dlog.N(Vec1(3.))(0, 0) == 0);
}
