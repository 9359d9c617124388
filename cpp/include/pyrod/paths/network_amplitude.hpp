// SPDX-License-Identifier: BSD-3-Clause
/// \file How far a state of a network is from another along a mode.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

namespace detail {

/// What a turn amounts to, such that its derivative is exact: 2 sin(θ/2) about its axis.
inline Vec1 turned(Angle a) { return Vec1(a.radians); }
inline Vec3 turned(const Quaternion& q) { return 2 * q.vec(); }

/// The derivative of c·turned(q) by a turn of q, in its components.
inline Vec1 turned_slope(Angle, const Vec1& c) { return c; }
inline Vec3 turned_slope(const Quaternion& q, const Vec3& c) {
  const Vec3 v = q.vec();
  return q.w() * c + c.cross(v);
}

}  // namespace detail

/// Σ weights mode · (the turns of the edges from x0 to x), and its gradient: h of theory (40).
template <class Space>
double amplitude(const Layout<Space>& layout, const Vector& weights, const NetworkState<Space>& x0,
                 const NetworkState<Space>& x, const Vector& mode, Vector& gradient) {
  constexpr int spin = Space::spin;
  gradient.setZero(mode.size());
  double sum = 0;
  for (int e = 0; e < layout.edges(); ++e) {
    const int row = layout.frame_row(e);
    const Spin<Space> c = weights[row] * mode.segment<spin>(row);
    const auto turn = x0.frames[e].conjugate() * x.frames[e];
    sum += c.dot(detail::turned(turn));
    gradient.segment<spin>(row) = detail::turned_slope(turn, c);
  }
  return sum;
}

}  // namespace pyrod
