// SPDX-License-Identifier: BSD-3-Clause
/// \file The same curve in Frenet's and in Bishop's numbers, and reconstructed from either.
///
/// Parallel transport leaves binormals alone at vertices (it turns about them), so seen in Bishop
/// frames the binormal b_j stands at an angle β_j that changes by the dihedral angle α from one
/// vertex to the next: exact at any coarseness, in every measure of the curvature.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/bishop.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/curve/frenet.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/curve/turning.hpp>
#include <pyrod/rotation/measure.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pyrod {

/// κ b_j in the components of a Bishop frame in which the first binormal is a2: K = (κ¹, κ², 0).
inline std::vector<Vec3> bishop_curvature(const Vector& κ, const Vector& α) {
  std::vector<Vec3> K(κ.size());
  double β = 0;
  for (Eigen::Index j = 0; j < κ.size(); ++j) {
    K[j] = {-κ[j] * std::sin(β), κ[j] * std::cos(β), 0};
    if (j < α.size()) β += α[j];
  }
  return K;
}

struct FrenetNumbers {
  Vector κ, α;  ///< at the vertices; on the edges between them
};

/// The inverse for the n + 1 vertices of an open arc. Where K vanishes, β stays as it was; at the
/// start it is that of the first vertex where it does not.
inline FrenetNumbers frenet_numbers(const std::vector<Vec3>& K) {
  const auto angle = [](const Vec3& k) { return std::atan2(-k.x(), k.y()); };
  const auto bent = [](const Vec3& k) { return k.x() != 0 || k.y() != 0; };
  const auto first = std::find_if(K.begin(), K.end(), bent);
  FrenetNumbers out{Vector(Eigen::Index(K.size())), Vector(Eigen::Index(K.size()) - 1)};
  double β = first == K.end() ? 0 : angle(*first);
  for (Eigen::Index j = 0; j < out.κ.size(); ++j) {
    out.κ[j] = std::hypot(K[j].x(), K[j].y());
    const double next = bent(K[j]) ? angle(K[j]) : β;
    if (j > 0) out.α[j - 1] = signed_angle(std::sin(next - β), std::cos(next - β));
    β = next;
  }
  return out;
}

/// The one arc with these curvatures, torsions and lengths that starts at r_0 with the frame
/// (n, b, t) = q_0; with its Bishop frames, which start there as well.
inline CosseratCurve<Spatial> reconstruct_frenet(const Grid& grid, const Vector& κ, const Vector& τ,
                                                 const Vec3& r0, const Quaternion& q0,
                                                 Measure measure = Measure::log) {
  const Vector α = Vector::NullaryExpr(
      τ.size(), [&](Eigen::Index j) { return angle_of(grid.h(int(j)) * τ[j], measure); });
  return reconstruct<Spatial>(
      grid, {bishop_curvature(κ, α), std::vector<Vec3>(grid.edges(), Vec3::UnitZ())}, r0, q0,
      measure);
}

}  // namespace pyrod
