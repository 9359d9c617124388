// SPDX-License-Identifier: BSD-3-Clause
/// \file Discrete Frenet curves: curvature, binormals, torsion, frames (Linn 4.2, A.4).
#pragma once

#include <pyrod/core/products.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/arc.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/curve/turning.hpp>
#include <pyrod/rotation/measure.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pyrod {

/// θ_j, the turning angles at the vertices.
inline Vector turning_angles(const Arc& arc) {
  return Vector::NullaryExpr(arc.vertices(),
                             [&](Eigen::Index j) { return arc.turning(int(j)).angle(); });
}

/// κ_j = θ_j/Δς_j, Linn (3), or the turn in another measure per length of the cell.
inline Vector curvature(const Grid& grid, const Vector& θ, Measure measure = Measure::log) {
  return Vector::NullaryExpr(
      θ.size(), [&](Eigen::Index j) { return measured(θ[j], measure) / grid.Δs(int(j)); });
}

namespace detail {

/// A unit vector across t, the same for the same t.
inline Vec3 any_normal(const Vec3& t) {
  Eigen::Index smallest;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Vec3::Unit(smallest)).normalized();
}

}  // namespace detail

/// b_j, the unit axes of the turns; defined at every vertex.
///
/// A vertex is straight if it turns by no more than its `straight` [rad] or than its rounded
/// position, a double, could turn it. It has no axis of its own and takes its predecessor's by
/// parallel transport, so that torsion vanishes along straight stretches and the whole dihedral
/// angle between two bent vertices falls on the edge into the second. Straight vertices at the
/// start take the axis of the first bent one (closed arc: of the last). Where an arc in a plane
/// bends the other way its binormal turns by π; a straight arc gets one of its normals.
inline std::vector<Vec3> binormals(const Arc& arc, const Vector& straight) {
  const int n = arc.vertices();
  require(straight.size() == n, "straight: expected ", n, ", one per vertex, got ",
          straight.size());
  std::vector<Vec3> b(n);
  int first = -1;
  const auto transport = [&](const Vec3& v, int j, bool back) {
    const Quaternion B = arc.turning(j).rotation();
    return (back ? unrotate(B, v) : rotate(B, v)).normalized();
  };
  for (int j = 0; j < n; ++j) {
    const Turning turning = arc.turning(j);
    const bool bent = !turning.straight(std::max(straight[j], arc.rounding(j)));
    if (first < 0 && bent) first = j;
    if (first >= 0) b[j] = bent ? turning.binormal() : transport(b[j - 1], j, false);
  }
  if (first < 0) {
    b[0] = detail::any_normal(arc.behind(0));
    for (int j = 1; j < n; ++j) b[j] = transport(b[j - 1], j, false);
  } else if (arc.closed()) {
    for (int j = 0; j < first; ++j) b[j] = transport(b[j == 0 ? n - 1 : j - 1], j, false);
  } else {
    for (int j = first; j-- > 0;) b[j] = transport(b[j + 1], j + 1, true);
  }
  return b;
}

/// The same with one angle for all vertices.
inline std::vector<Vec3> binormals(const Arc& arc, double straight = 0) {
  return binormals(arc, Vector::Constant(arc.vertices(), straight));
}

/// α_{j+1/2} in (−π, π], the angle about the edge from one binormal to the next.
///
/// With the mean binormal b̄ ∝ b_j + b_{j+1}, scaled so that b̄·b_j = 1, the symmetric difference
/// t·(b̄ × (b_{j+1} − b_j)) is 2 tan(α/2) (Linn 4.2 and A.4.2): monotone up to ±π. The arctangent of
/// its sine and cosine is that angle, also at π where b̄ vanishes.
inline Vector dihedral_angles(const Arc& arc, const std::vector<Vec3>& b) {
  return Vector::NullaryExpr(arc.edges(), [&](Eigen::Index j) {
    const Vec3 &start = b[j], &end = b[arc.next(int(j))];
    return signed_angle(arc.edge(int(j)).normalized().dot(accurate_cross(start, end)),
                        start.dot(end));
  });
}

/// τ_{j+1/2} = α_{j+1/2}/ℓ_{j+1/2}, Linn (4), or in another measure. Second order where
/// neighbouring edges differ little in length; elsewhere, and on the last edges of an open arc,
/// only sums of α converge (docs/curves.md).
inline Vector torsion(const Grid& grid, const Vector& α, Measure measure = Measure::log) {
  return Vector::NullaryExpr(
      α.size(), [&](Eigen::Index j) { return measured(α[j], measure) / grid.h(int(j)); });
}

/// Sauer's τ = sin α/ℓ, for comparison: it falls again beyond a right angle (Linn A.4.2).
inline Vector sauer_torsion(const Grid& grid, const Vector& α) {
  return α.array().sin() / grid.edge_lengths().array();
}

/// The frame (n, b, t) with the given unit tangent and unit binormal across it, with the sign of
/// the quaternion nearest to `neighbour`.
inline Quaternion frenet_frame(const Vec3& t, const Vec3& b, const Quaternion& neighbour) {
  Mat3 R;
  R << b.cross(t), b, t;
  Quaternion q = Quaternion(R).normalized();
  if (q.dot(neighbour) < 0) q.coeffs() *= -1;
  return q;
}

/// Frenet frames of the vertices: t̄ halves the turn, b is the binormal.
inline std::vector<Quaternion> vertex_frenet_frames(const Arc& arc, const std::vector<Vec3>& b) {
  std::vector<Quaternion> out;
  out.reserve(b.size());
  for (int j = 0; j < arc.vertices(); ++j) {
    const Vec3 mean = arc.before(j).normalized() + arc.behind(j).normalized();
    const Vec3 t = (mean - mean.dot(b[j]) * b[j]).normalized();
    out.push_back(frenet_frame(t, b[j], j > 0 ? out[j - 1] : Quaternion::Identity()));
  }
  return out;
}

/// Frenet frames of the edges: b̄ is half-way between the two binormals, turned about the edge.
inline std::vector<Quaternion> edge_frenet_frames(const Arc& arc, const std::vector<Vec3>& b,
                                                  const Vector& α) {
  std::vector<Quaternion> out;
  out.reserve(arc.edges());
  for (int j = 0; j < arc.edges(); ++j) {
    const Vec3 t = arc.edge(j).normalized();
    const Vec3 across = (b[j] - b[j].dot(t) * t).normalized();
    const Vec3 mean = std::cos(α[j] / 2) * across + std::sin(α[j] / 2) * t.cross(across);
    out.push_back(frenet_frame(t, mean, j > 0 ? out[j - 1] : Quaternion::Identity()));
  }
  return out;
}

}  // namespace pyrod
