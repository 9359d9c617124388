// SPDX-License-Identifier: BSD-3-Clause
/// \file Frames along a curve: adapting them to its tangents, and their twist about these.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/curve/turning.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>
#include <vector>

namespace pyrod {

/// q turned the least way that brings its a3 into the direction t.
inline Quaternion adapted(const Quaternion& q, const Vec3& t) {
  return (Turning(rotate(q, Vec3::UnitZ()), t).rotation() * q).normalized();
}

/// ψ, the part of the difference rotation W that turns about a3: W = (least rotation of a3) exp(ψ
/// e3). In (−2π, 2π]; zero for parallel transport.
inline double twist_angle(const Quaternion& W) { return 2 * signed_angle(W.z(), W.w()); }

/// ψ_j at the vertices.
inline Vector twist_angles(const Grid& grid, const CosseratCurve<Spatial>& curve) {
  return Vector::NullaryExpr(
      grid.vertices(), [&](Eigen::Index j) { return twist_angle(difference(curve, int(j))); });
}

/// Frames turned about their own a3 by the angles φ [rad]: R ← R exp(φ e3).
inline std::vector<Quaternion> turned_about_tangents(std::vector<Quaternion> frames,
                                                     const Vector& φ) {
  for (std::size_t j = 0; j < frames.size(); ++j)
    frames[j] = (frames[j] * exp(Vec3(0, 0, φ[Eigen::Index(j)]))).normalized();
  return frames;
}

/// The angles that `turned_about_tangents` needs to make `frames` out of `from`, continued along
/// the curve: from edge to edge they change by the twist of the one framing beside the other.
inline Vector angles_about_tangents(const std::vector<Quaternion>& from,
                                    const std::vector<Quaternion>& frames) {
  Vector φ(Eigen::Index(frames.size()));
  Quaternion before = Quaternion::Identity();
  for (Eigen::Index j = 0; j < φ.size(); ++j) {
    const Quaternion relative = from[j].conjugate() * frames[j];
    const double change = twist_angle(before.conjugate() * relative);
    φ[j] = (j > 0 ? φ[j - 1] : 0) + std::remainder(change, 2 * std::numbers::pi);
    before = relative;
  }
  return φ;
}

/// The same frames with the signs of the quaternions chosen so that no neighbours differ by more
/// than π.
inline std::vector<Quaternion> continued(std::vector<Quaternion> frames) {
  for (std::size_t j = 1; j < frames.size(); ++j)
    if (frames[j].dot(frames[j - 1]) < 0) frames[j].coeffs() *= -1;
  return frames;
}

/// Refuses a frame turned by π from the one before: whatever sign is chosen, the sense of that turn
/// is lost (Linn, note 9). For frames whose signs mean nothing, as those of matrices.
inline void check_continued(const std::vector<Quaternion>& frames) {
  for (std::size_t j = 1; j < frames.size(); ++j)
    require(std::abs(frames[j].dot(frames[j - 1])) > 5e-10, "frames[", j,
            "]: turned by pi from the one before, so that the sense of the turn is lost; use more "
            "edges");
}

}  // namespace pyrod
