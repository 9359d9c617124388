// SPDX-License-Identifier: BSD-3-Clause
/// \file The frame with a given tangent, and a normal as near to a given one as can be.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <optional>
#include <string_view>

namespace pyrod {

/// The unit vector along v.
inline Vec3 direction(const Vec3& v, std::string_view name) {
  require(v.allFinite() && !v.isZero(0), name,
          ": expected a vector of 3 finite numbers, not zero, got ", v.transpose());
  return (v / v.lpNorm<Eigen::Infinity>()).normalized();
}

/// a3 along `tangent`, a1 as near to `normal` as can be. Without a normal, the frame e1, e2, e3 is
/// turned the shortest way.
inline Quaternion frame_along(const Vec3& tangent, const std::optional<Vec3>& normal = {}) {
  const Vec3 t = direction(tangent, "tangent");
  if (!normal) {
    const double sine = std::hypot(t.x(), t.y());
    if (sine == 0) return t.z() < 0 ? Quaternion(0, 1, 0, 0) : Quaternion::Identity();
    return exp(Vec3(std::atan2(sine, t.z()) / sine * Vec3(-t.y(), t.x(), 0)));
  }
  const Vec3 n = direction(*normal, "normal");
  Vec3 a1 = n - n.dot(t) * t;
  require(a1.norm() >= 1e-6, "normal: must not be parallel to the tangent");
  a1.normalize();
  a1 -= a1.dot(t) * t;  // again, for what cancelled if the normal is near the tangent
  Mat3 R;
  R << a1.normalized(), t.cross(a1).normalized(), t;
  return Quaternion(R).normalized();
}

}  // namespace pyrod
