// SPDX-License-Identifier: BSD-3-Clause
/// \file Rotations of the plane by one angle, under the names that spatial rotations have.
///
/// The plane is that of the directors a1 and a3: planar vectors are spatial ones without component
/// 2, and the angle turns about e2, which takes e3 towards e1.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/trigonometry.hpp>

#include <cmath>
#include <cstdlib>
#include <numbers>

namespace pyrod {

using Vec1 = Vec<1>;
using Vec2 = Vec<2>;

/// A turn that knows how often it went round: the angle is not reduced.
template <class Real>
struct AngleOf {
  Real radians = 0;

  static AngleOf Identity() { return {}; }
  AngleOf conjugate() const { return {-radians}; }
  friend AngleOf operator*(const AngleOf& a, const AngleOf& b) { return {a.radians + b.radians}; }
};
using Angle = AngleOf<double>;

inline Angle exp(const Vec1& φ) { return {φ[0]}; }
template <class Real>
Vec<1, Real> log(const AngleOf<Real>& a) {
  return Vec<1, Real>(a.radians);
}

template <class Real>
Mat<2, 2, Real> matrix(const AngleOf<Real>& a) {
  const auto [s, c] = sine_cosine(a.radians);
  Mat<2, 2, Real> R;
  R << c, s, -s, c;
  return R;
}
inline Mat<2> matrix(Angle a) { return matrix<double>(a); }

/// R v.
template <class Real>
Vec<2, Real> rotate(const AngleOf<Real>& a, const Vec<2, Real>& v) {
  const auto [s, c] = sine_cosine(a.radians);
  return {c * v[0] + s * v[1], c * v[1] - s * v[0]};
}
inline Vec2 rotate(Angle a, const Vec2& v) { return rotate<double>(a, v); }

/// Rᵀ v.
template <class Real>
Vec<2, Real> unrotate(const AngleOf<Real>& a, const Vec<2, Real>& v) {
  return rotate<Real>(a.conjugate(), v);
}
inline Vec2 unrotate(Angle a, const Vec2& v) { return unrotate<double>(a, v); }

/// The turn with tan(ϑ/4) = q, and back.
inline Angle cayley(const Vec1& q) { return {4 * std::atan(q[0])}; }
inline Vec1 inverse_cayley(Angle a) { return Vec1(std::tan(a.radians / 4)); }

/// The same frame by the smaller turn, |angle| ≤ π.
inline Angle principal(Angle a) { return {std::remainder(a.radians, 2 * std::numbers::pi)}; }

/// The same frame as `a`, such that the turn from there to `b` is the smaller one.
inline Angle nearest(Angle a, Angle b) {
  constexpr double whole = 2 * std::numbers::pi;
  return {a.radians + whole * std::round((b.radians - a.radians) / whole)};
}

/// Whether the turn is by half a turn at most, but for rounding.
inline bool is_principal(Angle a) { return std::abs(a.radians) < std::numbers::pi + 1e-6; }

template <class Real>
AngleOf<Real> moved(const AngleOf<Real>& a, const Vec<1, Real>& φ) {
  return {a.radians + φ[0]};
}
inline Angle moved(Angle a, const Vec1& φ) { return moved<double>(a, φ); }
inline Angle between(Angle a, Angle b, double fraction = 0.5) {
  return {a.radians + fraction * (b.radians - a.radians)};
}

}  // namespace pyrod
