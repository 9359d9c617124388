// SPDX-License-Identifier: BSD-3-Clause
/// \file Writhe and linking number: Gauss's double integral, exact for polygons.
///
/// Seen from all sides, two straight edges cross in the solid angle Ω that the directions from the
/// one to the other fill: a spherical quadrilateral with the corners A, B, C, D below. Writhe and
/// link are sums of signed Ω (Banchoff, Indiana Univ. Math. J. 25, 1976; Klenin and Langowski,
/// Biopolymers 54, 2000).
#pragma once

#include <pyrod/core/parallel.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/approach.hpp>
#include <pyrod/curve/arc.hpp>
#include <pyrod/curve/turning.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace pyrod {

namespace detail {

/// Direction and distance from one vertex to another.
struct Sight {
  Vec3 d;
  double length;

  Sight(const Vec3& from, const Vec3& to) : d(to - from), length(d.norm()) { d /= length; }
};

/// Ω/2 = arg(z1 z2) in (−π, π): the quadrilateral is two triangles, and half the area of a triangle
/// of unit vectors is the argument of 1 + a·b + b·c + c·a + i det(a, b, c) (van Oosterom and
/// Strackee). Both determinants are the triple product V of the two edges and a line between them,
/// in the scale of the unit vectors. V alone says the sign: where edges nearly cross, z1 and z2 are
/// nearly imaginary, and rounding turns their product past π. NaN where vertices coincide.
inline double half_solid_angle(double V, const Sight& A, const Sight& B, const Sight& C,
                               const Sight& D) {
  const double AC = A.d.dot(C.d), scale = A.length * C.length;
  const double real1 = 1 + A.d.dot(B.d) + B.d.dot(C.d) + AC, imag1 = V / (scale * B.length);
  const double real2 = 1 + AC + C.d.dot(D.d) + A.d.dot(D.d), imag2 = V / (scale * D.length);
  const double real = real1 * real2 - imag1 * imag2, imag = real1 * imag2 + imag1 * real2;
  return std::copysign(signed_angle(imag, real), V);
}

/// How near two edges may come and still meet, for all that their rounded vertices tell.
inline double meeting_distance(const Arc& arc, const Arc& other) {
  double largest = 0;
  for (const Arc* each : {&arc, &other})
    for (const Vec3& r : each->positions) largest = std::max(largest, r.lpNorm<Eigen::Infinity>());
  return 32 * std::numeric_limits<double>::epsilon() * largest;
}

/// Σ Ω/2 over the edges [first, last) of `others` seen from edge i of `arc`. No edge may be as near
/// as `meeting`: rounding would decide on which side it passes.
inline double half_solid_angles(const Arc& arc, int i, const Arc& others, int first, int last,
                                double meeting) {
  const Vec3 &start = arc.positions[i], &end = arc.positions[arc.next(i)], edge = arc.edge(i);
  double sum = 0;
  if (first >= last) return sum;
  Sight A(start, others.positions[first]), B(end, others.positions[first]);
  for (int j = first; j < last; ++j) {
    const Vec3& next = others.positions[others.next(j)];
    const Sight D(start, next), C(end, next);
    const Vec3 other = others.edge(j);
    const double V = -A.length * A.d.dot(edge.cross(other));
    const double part = half_solid_angle(V, A, B, C, D);
    // |V| is the distance of the two lines times |edge × other|: few pairs need a closer look
    const bool near = V * V <= meeting * meeting * edge.squaredNorm() * other.squaredNorm();
    const bool meet = near && segment_distance(start, edge, others.positions[j], other) <= meeting;
    require(!meet && !std::isnan(part), "positions: edge ", i, " meets edge ", j,
            &arc == &others ? " of the same curve" : " of the other curve",
            ", so that crossings cannot be counted; move the curve apart there");
    sum += part;
    A = D, B = C;
  }
  return sum;
}

inline double sum_of_rows(const std::vector<double>& rows) {
  double sum = 0;
  for (const double row : rows) sum += row;
  return sum;
}

}  // namespace detail

/// Writhe of a polygon: (1/2π) Σ Ω over all pairs of edges; edges with a common vertex see each
/// other in no solid angle. Exact; also for an open arc, where it is no integral of a topological
/// kind. O(n²).
inline double writhe(const Arc& arc, int threads = 0, const KeepGoing& keep_going = {}) {
  const int n = arc.edges();
  const double meeting = detail::meeting_distance(arc, arc);
  std::vector<double> rows(n);
  for_each_row(n, threads, keep_going, [&](int i) {
    const int last = arc.closed() && i == 0 ? n - 1 : n;
    rows[i] = detail::half_solid_angles(arc, i, arc, i + 2, last, meeting);
  });
  return detail::sum_of_rows(rows) / std::numbers::pi;
}

/// Gauss's integral (1/4π) Σ Ω over the edges of two arcs: their linking number, whole up to
/// rounding, where both are closed. O(n m).
inline double gauss_integral(const Arc& arc, const Arc& other, int threads = 0,
                             const KeepGoing& keep_going = {}) {
  const double meeting = detail::meeting_distance(arc, other);
  std::vector<double> rows(arc.edges());
  for_each_row(arc.edges(), threads, keep_going, [&](int i) {
    rows[i] = detail::half_solid_angles(arc, i, other, 0, other.edges(), meeting);
  });
  return detail::sum_of_rows(rows) / (2 * std::numbers::pi);
}

}  // namespace pyrod
