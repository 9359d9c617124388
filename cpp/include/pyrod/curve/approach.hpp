// SPDX-License-Identifier: BSD-3-Clause
/// \file How near a curve comes to itself or to another: the smallest distance between two edges.
#pragma once

#include <pyrod/core/parallel.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/arc.hpp>
#include <pyrod/curve/grid.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace pyrod {

struct Approach {
  double distance = std::numeric_limits<double>::infinity();
  int edge = -1, other = -1;  ///< the two edges; −1 where there are none to compare
};

/// Distance between the segments p + x a and q + y b, 0 ≤ x, y ≤ 1. The least of a convex quadratic
/// on a square: free in x, then clamped in turn. Its determinant is |a × b|², not a
/// difference of products: nearly parallel segments would lose half their digits.
inline double segment_distance(const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b) {
  const Vec3 gap = p - q, normal = a.cross(b);
  const double aa = a.squaredNorm(), bb = b.squaredNorm(), ab = a.dot(b);
  const double ag = a.dot(gap), bg = b.dot(gap), det = normal.squaredNorm();
  const auto clamp = [](double x) { return std::clamp(x, 0., 1.); };
  double x = det > 0 ? clamp(normal.dot(b.cross(gap)) / det) : 0;
  const double y = clamp((ab * x + bg) / bb);
  x = clamp((ab * y - ag) / aa);
  return (gap + x * a - y * b).norm();
}

namespace detail {

/// The nearest to edge i of `arc` among the edges [first, last) of `others` that count. Spheres
/// around the edges rule most of them out.
template <class Counts>
Approach nearest(const Arc& arc, int i, const Arc& others, int first, int last,
                 const Counts& counts) {
  Approach best{.edge = i};
  const Vec3 a = arc.edge(i), centre = arc.centre(i);
  const double radius = a.norm() / 2;
  for (int j = first; j < last; ++j) {
    const Vec3 b = others.edge(j);
    const double reach = best.distance + radius + b.norm() / 2;
    const double between = (others.centre(j) - centre).squaredNorm();
    if (between >= reach * reach || !counts(j, between)) continue;
    const double d = segment_distance(arc.positions[i], a, others.positions[j], b);
    if (d < best.distance) best = {d, i, j};
  }
  return best;
}

inline Approach smallest(const std::vector<Approach>& rows) {
  const auto best = std::min_element(rows.begin(), rows.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance;
  });
  return best == rows.end() || best->other < 0 ? Approach{} : *best;
}

}  // namespace detail

/// The two nearest edges of parts of an arc that are not near along it: between their centres it is
/// more than 1.5 times as far along the arc as straight (half a circle: π/2 times). O(n²).
inline Approach self_approach(const Arc& arc, int threads = 0, const KeepGoing& keep_going = {}) {
  const int n = arc.edges();
  const Grid ς = arc_length(arc);
  std::vector<Approach> rows(n);
  for_each_row(n, threads, keep_going, [&](int i) {
    rows[i] = detail::nearest(arc, i, arc, i + 2, arc.closed() && i == 0 ? n - 1 : n,
                              [&](int j, double straight_squared) {
                                double along = ς.centre(j) - ς.centre(i);
                                if (arc.closed()) along = std::min(along, ς.length() - along);
                                return 1.5 * 1.5 * straight_squared < along * along;
                              });
  });
  return detail::smallest(rows);
}

/// The nearest edges of two arcs.
inline Approach approach(const Arc& arc, const Arc& other, int threads = 0,
                         const KeepGoing& keep_going = {}) {
  std::vector<Approach> rows(arc.edges());
  for_each_row(arc.edges(), threads, keep_going, [&](int i) {
    rows[i] = detail::nearest(arc, i, other, 0, other.edges(), [](int, double) { return true; });
  });
  return detail::smallest(rows);
}

}  // namespace pyrod
