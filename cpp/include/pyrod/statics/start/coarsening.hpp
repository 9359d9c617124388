// SPDX-License-Identifier: BSD-3-Clause
/// \file Coarser copies of a network, and the way of a state from one grid to another.
///
/// The hard part of a solve, finding the shape, is done with few edges; a coarse equilibrium is a
/// start on the finer grid from which Newton's method needs few steps.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pyrod {

namespace detail {

/// Vertices of a grid to keep: the given ones, and between neighbours of them at most `edges` − 1
/// more, as evenly as the grid has them.
inline std::vector<int> kept_vertices(const Grid& grid, const std::vector<int>& fixed, int edges) {
  std::vector<int> kept{fixed.front()};
  for (std::size_t i = 1; i < fixed.size(); ++i) {
    const double start = grid.s(fixed[i - 1]), length = grid.s(fixed[i]) - start;
    for (int k = 1; k < edges; ++k) {
      const double s = start + length * k / edges;
      const auto& all = grid.arc_lengths();
      int j = int(std::lower_bound(all.begin(), all.end(), s) - all.begin());
      if (j > 0 && s - grid.s(j - 1) < grid.s(j) - s) --j;
      if (j > kept.back() && j < fixed[i]) kept.push_back(j);
    }
    kept.push_back(fixed[i]);
  }
  return kept;
}

/// Calls put(cell, j, length) for what each cell of the coarse grid takes of the cell of vertex j.
template <class Put>
void share_cells(const Grid& grid, const Grid& coarse, const Put& put) {
  int cell = 0;  // it ends at the centre of the coarse edge of the same number
  const auto share = [&](double from, double to, int j) {
    for (; cell < coarse.edges() && coarse.centre(cell) < to; ++cell) {
      put(cell, j, coarse.centre(cell) - from);
      from = coarse.centre(cell);
    }
    put(coarse.closed() && cell == coarse.edges() ? 0 : cell, j, to - from);
  };
  for (int j = 0; j < grid.edges(); ++j) {
    share(grid.s(j), grid.centre(j), j);
    share(grid.centre(j), grid.s(j + 1), grid.next(j));
  }
}

/// The rod on the vertices that are kept. Compliances add along merged cells and edges, rest
/// curvatures are averaged.
template <class Space>
Rod<Space> merged(const Rod<Space>& rod, const std::vector<int>& kept) {
  const Grid& grid = rod.grid;
  const int m = int(kept.size()) - 1;
  Vector h(m);
  for (int J = 0; J < m; ++J) h[J] = grid.s(kept[J + 1]) - grid.s(kept[J]);
  Rod<Space> out{Grid(h, grid.closure()), {}, {}, {}};
  std::vector<Spin<Space>> turn(m + 1, Spin<Space>::Zero()), give(m + 1, Spin<Space>::Zero());
  share_cells(grid, out.grid, [&](int cell, int j, double length) {
    turn[cell] += length * rod.K0[j];
    give[cell] += length * rod.bending[j].cwiseInverse();
  });
  for (int K = 0; K < out.grid.vertices(); ++K) {
    out.bending.push_back(out.grid.Δs(K) * give[K].cwiseInverse());
    out.K0.push_back(turn[K] / out.grid.Δs(K));
  }
  for (int K = 0; K < m; ++K) {
    Point<Space> S = Point<Space>::Zero();
    for (int j = kept[K]; j < kept[K + 1]; ++j) S += grid.h(j) * rod.stretching[j].cwiseInverse();
    out.stretching.push_back(h[K] * S.cwiseInverse());
  }
  return out;
}

/// The coarse edge that holds a fine one.
inline int edge_of(const std::vector<int>& kept, int j) {
  return int(std::upper_bound(kept.begin(), kept.end(), j) - kept.begin()) - 1;
}

/// Loads brought to the vertices that are kept, forces as by levers.
template <class Space>
Loads<Space> merged(const Loads<Space>& loads, const Grid& grid, const std::vector<int>& kept) {
  const int m = int(kept.size()) - 1;
  Loads<Space> out(m);
  const auto share = [&](int j, auto&& put) {
    const int J = std::min(edge_of(kept, j), m - 1);
    const double t = (grid.s(j) - grid.s(kept[J])) / (grid.s(kept[J + 1]) - grid.s(kept[J]));
    put(J, 1 - t), put(J + 1, t);
  };
  for (int j = 0; j <= grid.edges(); ++j)
    if (!loads.force[j].isZero(0))
      share(j, [&](int J, double part) { out.force[J] += part * loads.force[j]; });
  for (int j = 0; j < grid.edges(); ++j) out.moment[edge_of(kept, j)] += loads.moment[j];
  for (const auto& f : loads.follower_forces)
    share(f.vertex, [&](int J, double part) {
      if (part > 0) out.follower_forces.push_back({edge_of(kept, f.edge), J, part * f.force});
    });
  for (const auto& c : loads.follower_moments)
    out.follower_moments.push_back({edge_of(kept, c.edge), c.moment});
  for (auto c : loads.vertex_moments)  // its parts are on the edges beside it already
    if (const int J = edge_of(kept, c.vertex); J > 0 && J < m && kept[J] == c.vertex) {
      c.vertex = J;
      out.vertex_moments.push_back(c);
    }
  out.start_moment = loads.start_moment;
  out.end_moment = loads.end_moment;
  out.follower_end_moment = loads.follower_end_moment;
  return out;
}

}  // namespace detail

/// The network with at most `edges` edges in each span.
template <class Space>
Network<Space> coarsened(const Network<Space>& fine, int edges) {
  Network<Space> out{{}, fine.placements, {}, fine.nodes, fine.attachments};
  for (int rod = 0; rod < int(fine.rods.size()); ++rod) {
    const Grid& grid = fine.rods[rod].grid;
    std::vector<int> fixed{0, grid.edges()};
    for (const auto& a : fine.attachments)
      if (a.rod == rod) fixed.push_back(a.vertex);
    std::sort(fixed.begin(), fixed.end());
    fixed.erase(std::unique(fixed.begin(), fixed.end()), fixed.end());
    const auto kept = detail::kept_vertices(grid, fixed, edges);
    out.rods.push_back(detail::merged(fine.rods[rod], kept));
    out.loads.push_back(detail::merged(fine.loads[rod], grid, kept));
    for (auto& a : out.attachments)
      if (a.rod == rod)
        a.vertex = int(std::lower_bound(kept.begin(), kept.end(), a.vertex) - kept.begin());
  }
  return out;
}

/// The state on a finer grid of the same rods: frames on the way between those of the coarse edges,
/// everything else as it is.
template <class Space>
NetworkState<Space> refined(const Layout<Space>& from, const NetworkState<Space>& x,
                            const Layout<Space>& to) {
  NetworkState<Space> out = x;
  out.frames.clear();
  for (int rod = 0; rod < int(to.network().rods.size()); ++rod) {
    const Grid &coarse = from.network().rods[rod].grid, &fine = to.network().rods[rod].grid;
    const auto frame = [&](int J) { return x.frames[from.edge(rod, J)]; };
    int J = 0;  // between the centres of the coarse edges J and J + 1
    for (int j = 0; j < fine.edges(); ++j) {
      const double s = fine.centre(j);
      while (J + 2 < coarse.edges() && coarse.centre(J + 1) < s) ++J;
      if (coarse.edges() == 1) {
        out.frames.push_back(frame(0));
        continue;
      }
      const double t = (s - coarse.centre(J)) / (coarse.centre(J + 1) - coarse.centre(J));
      out.frames.push_back(between(frame(J), frame(J + 1), t));
    }
  }
  return out;
}

}  // namespace pyrod
