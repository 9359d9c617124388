// SPDX-License-Identifier: BSD-3-Clause
/// \file Plane or space, decided by a type: how many numbers a position and a turn take.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/spatial.hpp>

namespace pyrod {

// In differential.hpp.
template <class Real>
class LogDifferentialOf;
template <class Real>
class PlanarLogDifferentialOf;

struct Planar {
  static constexpr int dim = 2;   ///< components of a position: 1 and 3
  static constexpr int spin = 1;  ///< components of a rotation vector: 2
  template <class Real>
  using RotationOf = AngleOf<Real>;
  template <class Real>
  using DifferentialOf = PlanarLogDifferentialOf<Real>;
  using Rotation = Angle;
  using Differential = PlanarLogDifferentialOf<double>;
};

struct Spatial {
  static constexpr int dim = 3;
  static constexpr int spin = 3;
  template <class Real>
  using RotationOf = QuaternionOf<Real>;
  template <class Real>
  using DifferentialOf = LogDifferentialOf<Real>;
  using Rotation = Quaternion;
  using Differential = LogDifferentialOf<double>;
};

/// A position, force or strain Γ.
template <class Space, class Real = double>
using Point = Vec<Space::dim, Real>;
/// A rotation vector, curvature K or moment.
template <class Space, class Real = double>
using Spin = Vec<Space::spin, Real>;

/// Unit vector along the axis of the rod, the third director's own components.
template <class Space, class Real = double>
Point<Space, Real> axis() {
  Point<Space, Real> e3 = Point<Space, Real>::Zero();
  e3[Space::dim - 1] = 1;
  return e3;
}

template <class Real>
Vec<3, Real> cross(const Vec<3, Real>& a, const Vec<3, Real>& b) {
  return a.cross(b);
}
inline Vec3 cross(const Vec3& a, const Vec3& b) { return a.cross(b); }
/// Component 2 of the spatial product.
template <class Real>
Vec<1, Real> cross(const Vec<2, Real>& a, const Vec<2, Real>& b) {
  return Vec<1, Real>(a[1] * b[0] - a[0] * b[1]);
}
inline Vec1 cross(const Vec2& a, const Vec2& b) { return cross<double>(a, b); }

/// skew(a) φ = a × φ for a rotation vector φ: dim × spin.
inline Vec2 skew(const Vec2& a) { return {-a[1], a[0]}; }
/// m × φ between rotation vectors.
inline Mat3 spin_skew(const Vec3& m) { return skew(m); }
inline Mat<1> spin_skew(const Vec1&) { return Mat<1>::Zero(); }

/// Spin components from the frame to space. In the plane they are the same.
inline Vec3 rotate_spin(const Quaternion& q, const Vec3& m) { return rotate(q, m); }
inline Vec1 rotate_spin(Angle, const Vec1& m) { return m; }

}  // namespace pyrod
