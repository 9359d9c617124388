// SPDX-License-Identifier: BSD-3-Clause
/// \file Rotations of space as unit quaternions: exponential, logarithm, Cayley map.
///
/// A quaternion and its negative are the same frame but not the same turn: the logarithm reaches up
/// to 2π (Linn, note 9), so no function here ever flips a sign.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/series.hpp>

#include <Eigen/Geometry>

#include <cmath>

namespace pyrod {

using Quaternion = Eigen::Quaterniond;

template <class Real>
using QuaternionOf = Eigen::Quaternion<Real>;

template <class Real>
QuaternionOf<Real> quaternion(const Real& real, const Vec<3, Real>& imaginary) {
  return {real, imaginary.x(), imaginary.y(), imaginary.z()};
}
inline Quaternion quaternion(double real, const Vec3& imaginary) {
  return quaternion<double>(real, imaginary);
}

/// Cross product matrix: skew(a) b = a × b.
inline Mat3 skew(const Vec3& a) {
  Mat3 A;
  A << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return A;
}

/// Unit quaternion that turns by the rotation vector φ [rad].
template <class Real>
QuaternionOf<Real> exp(const Vec<3, Real>& φ) {
  const auto [cosine, sine_over_θ] = half_turn<Real>(φ.squaredNorm());
  return quaternion<Real>(cosine, sine_over_θ * φ);
}
inline Quaternion exp(const Vec3& φ) { return exp<double>(φ); }

/// Rotation vector of a unit quaternion, |log p| in [0, 2π]: Linn's 2 log p̂ = ϑ Û.
template <class Real>
Vec<3, Real> log(const QuaternionOf<Real>& p) {
  using std::sqrt;
  const Vec<3, Real> v = p.vec();
  return Real(2) * half_angle_ratio<Real>(sqrt(v.squaredNorm()), p.w()) * v;
}
inline Vec3 log(const Quaternion& p) { return log<double>(p); }

/// The same frame by the smaller turn, |log p| ≤ π. For where nothing tells the sign.
inline Quaternion principal(const Quaternion& p) {
  return p.w() < 0 ? Quaternion(-p.w(), -p.x(), -p.y(), -p.z()) : p;
}

/// The same frame as `p`, with the sign for which the turn from there to `q` is the smaller one.
inline Quaternion nearest(const Quaternion& p, const Quaternion& q) {
  return p.dot(q) < 0 ? Quaternion(-p.coeffs()) : p;
}

/// Whether the turn is by half a turn at most, but for rounding.
inline bool is_principal(const Quaternion& p) { return p.w() > -5e-7; }

/// R itself, with the directors a1, a2, a3 as columns.
template <class Real>
Mat<3, 3, Real> matrix(const QuaternionOf<Real>& q) {
  return q.toRotationMatrix();
}
inline Mat3 matrix(const Quaternion& q) { return matrix<double>(q); }

/// R v: from the frame's components to space.
inline Vec3 rotate(const Quaternion& q, const Vec3& v) {
  const Vec3 t = 2 * q.vec().cross(v);
  return v + q.w() * t + q.vec().cross(t);
}

/// Rᵀ v: from space to the frame's components.
template <class Real>
Vec<3, Real> unrotate(const QuaternionOf<Real>& q, const Vec<3, Real>& v) {
  const Vec<3, Real> t = Real(2) * q.vec().cross(v);
  return v - q.w() * t + q.vec().cross(t);
}
inline Vec3 unrotate(const Quaternion& q, const Vec3& v) { return unrotate<double>(q, v); }

/// (1 + q)/(1 − q): the unit quaternion whose angle ϑ has tan(ϑ/4) = |q| (Linn, note 3).
inline Quaternion cayley(const Vec3& q) {
  const double x = q.squaredNorm(), scale = 1 / (1 + x);
  return quaternion((1 - x) * scale, 2 * scale * q);
}

/// (p − 1)/(p + 1), defined unless p = −1 (Linn, note 3). Towards it 1 + w would cancel.
inline Vec3 inverse_cayley(const Quaternion& p) {
  if (p.w() >= 0) return p.vec() / (1 + p.w());
  return (1 - p.w()) / p.vec().squaredNorm() * p.vec();
}

/// q exp(φ), brought back to unit length so that a long sequence of moves does not drift.
template <class Real>
QuaternionOf<Real> moved(const QuaternionOf<Real>& q, const Vec<3, Real>& φ) {
  using std::sqrt;
  QuaternionOf<Real> p = q * exp<Real>(φ);
  p.coeffs() /= sqrt(p.coeffs().squaredNorm());
  return p;
}
inline Quaternion moved(const Quaternion& q, const Vec3& φ) { return moved<double>(q, φ); }

/// The rotation from a towards b by the given fraction of the way, along the shortest great circle
/// that the turn conj(a) b, with its sign, belongs to.
inline Quaternion between(const Quaternion& a, const Quaternion& b, double fraction = 0.5) {
  return moved(a, fraction * log(a.conjugate() * b));
}

}  // namespace pyrod
