// SPDX-License-Identifier: BSD-3-Clause
/// \file Places on a rod, and what acts at single ones.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>

#include <algorithm>
#include <utility>

namespace pyrod {

/// A place on a rod: a part of an edge, 0 at the vertex before it; the end is 1 of the last edge.
/// On finer grids it is the same by number: arc lengths are off by rounding.
struct Site {
  int edge;
  double part;

  /// Within 1e-9 of an edge's length of a vertex it is that.
  static Site on(const Grid& grid, double s) {
    s = grid.on_rod(s);
    const auto& S = grid.arc_lengths();
    const int n = grid.edges();
    const int j = std::min(int(std::upper_bound(S.begin(), S.end(), s) - S.begin()) - 1, n - 1);
    const double part = (s - grid.s(j)) / grid.h(j);
    if (part > 1e-9 && part < 1 - 1e-9) return {j, part};
    const int vertex = part < 0.5 ? j : j + 1;
    return vertex == n ? Site{n - 1, 1} : Site{vertex, 0};
  }

  /// Where every edge is cut in so many.
  Site refined(int parts) const {
    const int whole = std::min(int(part * parts), parts - 1);
    return {edge * parts + whole, part * parts - whole};
  }

  /// The vertex it is; −1: it is inside an edge.
  int vertex() const { return part == 0 ? edge : part == 1 ? edge + 1 : -1; }

  bool is_end(const Grid& grid) const { return edge == grid.edges() - 1 && part == 1; }
};

/// A force that turns with the frame of an edge and acts on a vertex; material components.
template <class Space>
struct FollowerForce {
  int edge, vertex;
  Point<Space> force;
};

/// A moment that turns with the frame of the edge it acts on; material components.
template <class Space>
struct FollowerMoment {
  int edge;
  Spin<Space> moment;
};

/// A moment that acts at an inner vertex, and what of it the edges before and behind feel.
template <class Space>
struct VertexMoment {
  int vertex;
  Spin<Space> moment, before, behind;
  bool follows;          ///< material components of the vertex, or of either edge; else spatial
  bool on_node = false;  ///< it acts on the frame of a node, and the edges feel nothing
};

/// Curvature that a rod has at rest at its ends, by which a frame there differs from its edge's.
template <class Space>
struct EndCurvature {
  Spin<Space> start = Spin<Space>::Zero(), end = Spin<Space>::Zero();
};

/// The first edge whose centre is behind the place, and how far on the way to it from the centre
/// before (or the start) the place is; behind the last centre: the number of edges, 0.
inline std::pair<int, double> between_centres(const Grid& grid, const Site& at) {
  const auto [e, part] = at;
  if (part < 0.5) {
    if (e == 0) return {0, 2 * part};
    return {e, (grid.h(e - 1) / 2 + part * grid.h(e)) / grid.Δs(e)};
  }
  if (e == grid.edges() - 1) return {e + 1, 0};
  return {e + 1, (part - 0.5) * grid.h(e) / grid.Δs(e + 1)};
}

}  // namespace pyrod
