// SPDX-License-Identifier: BSD-3-Clause
/// \file Polygonal arcs: vertices in space, open or closed, with the directions that hold the ends.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/curve/turning.hpp>

#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace pyrod {

/// A polygonal arc (Linn A.3). It looks at vertices that live elsewhere.
///
/// Edge j leads from vertex j to the next; on a closed arc the last edge leads to vertex 0. An end
/// may be held by a tangent (Linn 4.4.1): the half cell between it and the edge then turns. An end
/// without one has the direction of its edge, and its half cell does not turn.
struct Arc {
  std::span<const Vec3> positions;
  Closure closure = Closure::open;
  std::optional<Vec3> start_tangent{}, end_tangent{};

  int vertices() const { return int(positions.size()); }
  int edges() const { return vertices() - !closed(); }
  bool closed() const { return closure == Closure::closed; }
  int next(int j) const { return j + 1 == vertices() ? 0 : j + 1; }

  /// l_{j+1/2} = r_{j+1} − r_j.
  Vec3 edge(int j) const { return positions[next(j)] - positions[j]; }
  /// r̄_{j+1/2}, the centre of the edge.
  Vec3 centre(int j) const { return (positions[j] + positions[next(j)]) / 2; }

  /// The direction before vertex j, and the one behind it.
  Vec3 before(int j) const {
    if (j > 0) return edge(j - 1);
    return closed() ? edge(edges() - 1) : start_tangent.value_or(edge(0));
  }
  Vec3 behind(int j) const {
    if (j < edges()) return edge(j);
    return end_tangent.value_or(edge(edges() - 1));
  }
  Turning turning(int j) const { return {before(j), behind(j)}; }

  /// Angle [rad] by which rounded positions alone may turn the edges at vertex j. Tangents that
  /// hold the ends have no length to compare with positions.
  double rounding(int j) const {
    const double size = positions[j].lpNorm<Eigen::Infinity>();
    double angle = 1;
    if (j > 0 || closed()) angle += size / before(j).norm();
    if (j < edges()) angle += size / behind(j).norm();
    return 8 * std::numeric_limits<double>::epsilon() * angle;
  }

  /// Refuses what is no regular arc, naming the place and the remedy: coinciding neighbours and
  /// edges that fold back (Linn, note 9).
  void check() const;
};

/// The squares of products of edges beyond these leave the range of numbers.
inline constexpr double shortest_edge = 1e-60, longest_edge = 1e60;

inline void check_tangent(const std::optional<Vec3>& t, std::string_view name) {
  require(!t || (t->allFinite() && t->norm() > shortest_edge && t->norm() < longest_edge), name,
          ": expected a direction, finite and not zero, got ",
          t.value_or(Vec3::Zero()).transpose());
}

inline void Arc::check() const {
  const int least = closed() ? 3 : 2;
  require(vertices() >= least, "positions: expected at least ", least, " vertices, got ",
          vertices());
  check_tangent(start_tangent, "start_tangent");
  check_tangent(end_tangent, "end_tangent");
  require(!closed() || !(start_tangent || end_tangent),
          "start_tangent, end_tangent: a closed arc has no ends");
  for (int j = 0; j < vertices(); ++j)
    require(positions[j].allFinite(), "positions[", j, "]: expected finite numbers, got ",
            positions[j].transpose());
  for (int j = 0; j < edges(); ++j) {
    const double length = edge(j).norm();
    require(
        length > shortest_edge, "positions[", next(j), "]: coincides with positions[", j,
        "]; leave one of the two out",
        closed() && next(j) == 0 ? " (a closed arc returns to its first vertex by itself)" : "");
    require(length < longest_edge, "positions[", next(j), "]: the edge before has length ", length,
            "; use other units of length");
  }
  for (int j = 0; j < vertices(); ++j)
    require(!turning(j).antiparallel(rounding(j)), "positions[", j,
            "]: the edges before and behind are antiparallel, so that the plane of their turn is "
            "lost; put a vertex aside of the fold or leave one out");
}

/// The grid of discrete arc length ς: edge lengths ℓ, cells Δς, places ς_j (Linn A.3). Second order
/// in the true arc length.
inline Grid arc_length(const Arc& arc) {
  return Grid(
      Vector::NullaryExpr(arc.edges(), [&](Eigen::Index j) { return arc.edge(int(j)).norm(); }),
      arc.closure);
}

/// t_{j+1/2}, the unit tangents of the edges.
inline std::vector<Vec3> tangents(const Arc& arc) {
  std::vector<Vec3> out(arc.edges());
  for (int j = 0; j < arc.edges(); ++j) out[j] = arc.edge(j).normalized();
  return out;
}

}  // namespace pyrod
