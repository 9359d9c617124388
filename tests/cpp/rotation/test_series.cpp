// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rotation/series.hpp>

#include "support/ulp.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

using Long = long double;
constexpr double π = std::numbers::pi;

/// Σ_k (−1)^k a(k) z^k / (2k + shift)!, summed as it is written.
template <class A>
Long alternating(Long z, int shift, const A& a) {
  Long power = 1, factorial = 1, sum = 0;
  for (int i = 2; i <= shift; ++i) factorial *= i;
  for (int k = 0; k < 40; ++k) {
    sum += a(k) * power / factorial;
    power *= -z;
    factorial *= Long(2 * k + 1 + shift) * Long(2 * k + 2 + shift);
  }
  return sum;
}
constexpr auto one = [](int) { return Long(1); };

Long exact_sinc(Long θ) { return θ == 0 ? 1 : std::sin(θ) / θ; }
Long exact_versinc(Long θ) {
  const Long s = exact_sinc(θ / 2);
  return s * s / 2;
}
Long exact_sine_defect(Long θ) {
  return θ < 2 ? alternating(θ * θ, 3, one) : (θ - std::sin(θ)) / (θ * θ * θ);
}

/// c = P/(4Q) with P = (sin y − y cos y)/y³, Q = sin y/y, y = θ/2, and slope = dc/d(θ²)·2.
struct Logarithm {
  Long P, dP, Q, dQ;  // derivatives with respect to y²
  explicit Logarithm(Long θ) {
    const Long y = θ / 2, z = y * y;
    Q = exact_sinc(y);
    P = alternating(z, 3, [](int k) { return Long(2 * (k + 1)); });
    dP = -alternating(z, 5, [](int k) { return Long(2 * (k + 2) * (k + 1)); });
    dQ = -alternating(z, 3, [](int k) { return Long(k + 1); });
  }
  Long c() const { return P / (4 * Q); }
  Long slope() const { return (dP * Q - P * dQ) / (8 * Q * Q); }
};

}  // namespace

// The bounds are the errors found, rounded up: a wrong or missing coefficient breaks them at once.

TEST_CASE("sinc is accurate for every angle") {
  const Worst w = worst(angles(20, {π, 2 * π}), sinc, exact_sinc);
  CAPTURE(w.at);
  CHECK(w.ulps < 1.6);
  CHECK(sinc(0) == 1);
  CHECK(sinc(-0.7) == sinc(0.7));
}

TEST_CASE("versinc is accurate for every angle") {
  const Worst w = worst(angles(20, {π, 2 * π}), versinc, exact_versinc);
  CAPTURE(w.at);
  CHECK(w.ulps < 4);
  CHECK(versinc(0) == 0.5);
  CHECK(versinc(-0.7) == versinc(0.7));
}

TEST_CASE("sine_defect is accurate for every angle") {
  const Worst w = worst(angles(20, {1}), sine_defect, exact_sine_defect);
  CAPTURE(w.at);
  CHECK(w.ulps < 4);
  CHECK(sine_defect(0) == 1. / 6);
  CHECK(sine_defect(-0.7) == sine_defect(0.7));
}

TEST_CASE("the logarithm's coefficients are accurate below two pi") {
  const auto at = angles(2 * π * (1 - 1e-15), {std::sqrt(0.5), 1, π, π * (1 + 1e-12)});
  const Worst c = worst(
      at, [](double θ) { return log_coefficients(θ).c; }, [](Long θ) { return Logarithm(θ).c(); });
  CAPTURE(c.at);
  CHECK(c.ulps < 4);
  const Worst slope = worst(
      at, [](double θ) { return log_coefficients(θ).slope; },
      [](Long θ) { return Logarithm(θ).slope(); });
  CAPTURE(slope.at);
  CHECK(slope.ulps < 12);  // the closed form, just beyond π

  CHECK(ulps(log_coefficients(0).c, Long(1) / 12) < 1);
  CHECK(ulps(log_coefficients(0).slope, Long(1) / 360) < 1);
  CHECK(ulps(log_coefficients(π).c, 1 / (Long(π) * π)) < 2);  // cot(π/2) = 0
  CHECK(log_coefficients(-3).c == log_coefficients(3).c);
  CHECK(log_coefficients(-4).slope == log_coefficients(4).slope);
}

TEST_CASE("half_turn is accurate on both sides of its branch") {
  Worst cosine, sine;
  for (const double θ : angles(20, {1})) {
    const auto half = half_turn(θ * θ);
    const Long x = std::sqrt(Long(θ * θ)) / 2;  // of the argument as it is rounded
    const double error = double(std::abs(Long(half.cosine) - std::cos(x)) / 2.2e-16L);
    if (!(error <= cosine.ulps)) cosine = {error, θ};  // absolute: the cosine has zeros
    const double relative =
        double(std::abs(Long(half.sine_over_θ) - exact_sinc(x) / 2) * (1 + x) / 2.2e-16L);
    if (!(relative <= sine.ulps)) sine = {relative, θ};
  }
  CAPTURE(cosine.at);
  CAPTURE(sine.at);
  CHECK(cosine.ulps < 6);  // of one; beyond π the rounded root turns by up to an ulp of θ/2
  CHECK(sine.ulps < 6);
}

TEST_CASE("half_angle_ratio is accurate up to the full half turn") {
  const auto exact_at = [](Long half) { return std::sin(half); };
  Worst found;
  for (const double half : angles(π, {π / 2, 1e-8})) {
    const double sine = double(exact_at(half)), cosine = std::cos(half);
    if (!(sine > 0)) continue;
    const Long exact = std::atan2(Long(sine), Long(cosine)) / Long(sine);
    const double error = ulps(half_angle_ratio(sine, cosine), exact);
    if (!(error <= found.ulps)) found = {error, half};
  }
  CAPTURE(found.at);
  CHECK(found.ulps < 1.2);
  CHECK(half_angle_ratio(0, 1) == 1);
  CHECK(half_angle_ratio(1e-300, 1) == 1);
  CHECK(half_angle_ratio(5e-324, 1) == 1);
  CHECK(half_angle_ratio(1, 0) == doctest::Approx(π / 2).epsilon(1e-15));
  CHECK(half_angle_ratio(1e-300, -1) * 1e-300 == doctest::Approx(π).epsilon(1e-15));
}

TEST_CASE("horner sums the lowest power first") {
  CHECK(series::horner(std::array{1., 2., 3.}, 10.) == 321);
  CHECK(series::horner(std::array{7.}, 10.) == 7);
}
