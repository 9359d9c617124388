// SPDX-License-Identifier: BSD-3-Clause
/// \file The only home of small angles: entire (or nearly entire) functions of a rotation angle,
/// each accurate to rounding for every angle, so that no other file needs a threshold.
#pragma once

#include <pyrod/core/pack.hpp>
#include <pyrod/rotation/trigonometry.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>

namespace pyrod {

/// sin θ / θ.
inline double sinc(double θ) { return θ == 0 ? 1 : std::sin(θ) / θ; }

/// (1 − cos θ)/θ², from the half angle: no cancellation anywhere.
inline double versinc(double θ) {
  const double s = sinc(θ / 2);
  return s * s / 2;
}

/// (θ − sin θ)/θ³. Taylor below one radian, where the difference would cancel.
inline double sine_defect(double θ) {
  constexpr std::array a{1. / 6,
                         -1. / 120,
                         1. / 5040,
                         -1. / 362880,
                         1. / 39916800,
                         -1. / 6227020800,
                         1. / 1307674368000.,
                         -1. / 355687428096000.,
                         1. / 1.21645100408832e17};
  const double x = θ * θ;
  return x < 1 ? series::horner(a, x) : (θ - std::sin(θ)) / (x * θ);
}

/// The coefficient c of the logarithm's differential and its slope, both even functions of θ:
///   c(θ) = (1 − (θ/2) cot(θ/2))/θ²,   slope = c'(θ)/θ.
template <class Real = double>
struct LogCoefficients {
  Real c, slope;
};

/// The closed form, well conditioned beyond π.
inline LogCoefficients<> log_coefficients_beyond_π(double θ) {
  const double x = θ * θ, half = θ / 2, cot = 1 / std::tan(half), sin = std::sin(half);
  const double xcot = half * cot, ratio = half / sin;
  return {(1 - xcot) / x, (xcot + ratio * ratio - 2) / (x * x)};
}

/// Puts the closed form where a turn is not `near`.
inline void replace_lanes(LogCoefficients<>& out, double x, bool near) {
  if (!near) out = log_coefficients_beyond_π(std::sqrt(x));
}
template <int W>
void replace_lanes(LogCoefficients<Pack<W>>& out, const Pack<W>& x, const Mask<W>& near) {
  for (int i = 0; i < W; ++i) {
    if (near.bits[i]) continue;
    const auto lane = log_coefficients_beyond_π(std::sqrt(x.values[i]));
    out.c.values[i] = lane.c;
    out.slope.values[i] = lane.slope;
  }
}

/// From x = θ², |θ| < 2π. With cot's partial fractions, c(θ) as in theory (7): the first
/// term, which carries the pole at 2π, is kept as it is, the others are summed as a power series in
/// θ² with radius (4π)². All terms are positive, so nothing cancels.
template <Number Real>
LogCoefficients<Real> log_coefficients_of_square(const Real& x) {
  // 2 (ζ(2m+2) − 1)/(2π)^(2m+2)
  constexpr std::array a{3.26727415121644476e-2,  1.05641107053346990e-4,  5.63737028287684530e-7,
                         3.35714192665745136e-9,  2.07428729041660455e-11, 1.30004821386989740e-13,
                         8.19605205569100860e-16, 5.18011819616972431e-18, 3.27753917470179184e-20,
                         2.07474018785936045e-22, 1.31362418071665338e-24, 8.31800319518926409e-27,
                         5.26726299683423087e-29, 3.33548429882214433e-31, 2.11220633231838855e-33,
                         1.33756640932152445e-35};
  constexpr auto slopes = [](const auto& of) {  // c'/θ = 2 dc/dx of c = Σ of[m] xᵐ, x = θ²
    std::array<double, std::tuple_size_v<std::decay_t<decltype(of)>> - 1> out{};
    for (std::size_t m = 0; m < out.size(); ++m) out[m] = 2 * double(m + 1) * of[m + 1];
    return out;
  };
  constexpr std::array few{a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7]};
  constexpr auto b = slopes(a);
  constexpr auto few_b = slopes(few);
  constexpr double π = std::numbers::pi;

  const auto small = x < Real(0.5), near = x <= Real(π * π);
  const Real pole = Real(1) / (Real(4 * π * π) - x);
  LogCoefficients<Real> out{Real(2) * pole, Real(4) * pole * pole};
  if (everywhere(small))
    return {out.c + series::horner(few, x), out.slope + series::horner(few_b, x)};
  out.c += select(small, series::horner(few, x), series::horner(a, x));
  out.slope += select(small, series::horner(few_b, x), series::horner(b, x));
  if (!everywhere(near)) replace_lanes(out, x, near);
  return out;
}

inline LogCoefficients<> log_coefficients(double θ) {
  constexpr double π = std::numbers::pi;
  return θ * θ > π * π ? log_coefficients_beyond_π(θ) : log_coefficients_of_square(θ * θ);
}

/// cos(θ/2) and sin(θ/2)/θ from θ²: they make a rotation vector a unit quaternion. Below one radian
/// by Taylor's series, which cost less than the functions and need no θ.
template <class Real = double>
struct HalfTurn {
  Real cosine, sine_over_θ;
};

template <Number Real>
HalfTurn<Real> half_turn(const Real& θ2) {
  constexpr std::array cosine{1.,         -1. / 2,       1. / 24,        -1. / 720,
                              1. / 40320, -1. / 3628800, 1. / 479001600, -1. / 87178291200};
  constexpr std::array sine{1.,          -1. / 6,        1. / 120,        -1. / 5040,
                            1. / 362880, -1. / 39916800, 1. / 6227020800, -1. / 1307674368000};
  using std::sqrt;
  const auto small = θ2 < Real(1);
  const Real quarter = Real(0.25) * θ2;
  const HalfTurn<Real> taylor{series::horner(cosine, quarter),
                              Real(0.5) * series::horner(sine, quarter)};
  if (everywhere(small)) return taylor;
  const Real θ = sqrt(θ2);
  const auto half = sine_cosine(Real(0.5) * θ);
  return {select(small, taylor.cosine, half.cosine),
          select(small, taylor.sine_over_θ, half.sine / θ)};
}

/// Angle of the point (cosine, sine) divided by its sine part: 2·half_angle_ratio(|v|, w) turns the
/// vector part v of a unit quaternion into its rotation vector. sine ≥ 0; result in units of
/// 1/sine. Small angles by the series of the arctangent, which costs less than the function.
template <Number Real>
Real half_angle_ratio(const Real& sine, const Real& cosine) {
  constexpr std::array atan{1.,       -1. / 3, 1. / 5,   -1. / 7, 1. / 9,   -1. / 11, 1. / 13,
                            -1. / 15, 1. / 17, -1. / 19, 1. / 21, -1. / 23, 1. / 25};
  const Real tan = sine / cosine;
  const auto small = (cosine > Real(0)) & (tan < Real(0.25));
  const Real taylor = series::horner(atan, tan * tan) / cosine;
  if (everywhere(small)) return taylor;
  const Real large = select(sine > Real(0), angle(sine, cosine) / sine, Real(1) / cosine);
  return select(small, taylor, large);
}
inline double half_angle_ratio(double sine, double cosine) {
  return half_angle_ratio<double>(sine, cosine);
}

}  // namespace pyrod
