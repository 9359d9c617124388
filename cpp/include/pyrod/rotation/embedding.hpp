// SPDX-License-Identifier: BSD-3-Clause
/// \file The plane as a part of space: component 2 of vectors and components 1, 3 of turns are
/// zero.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

namespace pyrod {

inline Vec3 embed(const Vec2& v) { return {v[0], 0, v[1]}; }
inline Vec3 embed_spin(const Vec1& m) { return {0, m[0], 0}; }
inline Quaternion embed(Angle a) { return exp(embed_spin(Vec1(a.radians))); }

inline const Vec3& embed(const Vec3& v) { return v; }
inline const Vec3& embed_spin(const Vec3& m) { return m; }
inline const Quaternion& embed(const Quaternion& q) { return q; }

/// The part of a spatial vector that the space has.
template <class Space>
Point<Space> restrict_point(const Vec3& v) {
  if constexpr (Space::dim == 3)
    return v;
  else
    return {v[0], v[2]};
}

template <class Space>
Spin<Space> restrict_spin(const Vec3& m) {
  if constexpr (Space::spin == 3)
    return m;
  else
    return Spin<Space>(m[1]);
}

/// For a turn about e2; the planar angle is that of log q.
template <class Space>
typename Space::Rotation restrict_rotation(const Quaternion& q) {
  if constexpr (Space::spin == 3)
    return q;
  else
    return exp(restrict_spin<Space>(log(q)));
}

}  // namespace pyrod
