// SPDX-License-Identifier: BSD-3-Clause
/// \file Coarser copies of a network.
///
/// The hard part of a solve, finding the shape, is done with few edges; coarse equilibria are a
/// start on a finer grid from which Newton's method needs few steps. Between vertices that are kept
/// edges are even, whatever the fine ones are, so that errors on one coarse grid tell those on the
/// next.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/unknowns/kinks.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

namespace detail {

/// A coarser grid, and where on it the vertices are that it keeps, those of which are in order.
struct CoarserGrid {
  Grid grid;
  std::vector<int> fine, coarse;

  /// −1: the vertex is not kept.
  int vertex(int j) const {
    const auto found = std::ranges::lower_bound(fine, j);
    return found != fine.end() && *found == j ? coarse[std::size_t(found - fine.begin())] : -1;
  }
};

/// `ends`: of spans, which are cut in at most `edges` edges; `kept`: besides, as far as they are
/// few. Both in order.
inline CoarserGrid coarser_grid(const Grid& grid, const std::vector<int>& ends,
                                const std::vector<int>& kept, int edges) {
  std::vector<int> fine = ends, coarse{0};
  if (2 * int(kept.size()) <= edges) fine.insert(fine.end(), kept.begin(), kept.end());
  std::ranges::sort(fine);
  fine.erase(std::ranges::unique(fine).begin(), fine.end());
  std::vector<double> h;
  std::size_t end = 0;
  for (std::size_t i = 1; i < fine.size(); ++i) {
    const int from = fine[i - 1], to = fine[i];
    if (from == ends[end]) ++end;
    const double length = grid.s(to) - grid.s(from),
                 span = grid.s(ends[end]) - grid.s(ends[end - 1]);
    const int parts = std::max(1, int(std::lround(edges * length / span)));
    for (int k = 0; k < std::min(parts, to - from); ++k)
      h.push_back(parts < to - from ? length / parts : grid.h(from + k));
    coarse.push_back(int(h.size()));
  }
  return {Grid(Eigen::Map<const Vector>(h.data(), Eigen::Index(h.size())), grid.closure()),
          std::move(fine), std::move(coarse)};
}

/// Where the cells of a grid end one after another; those of a closed one begin and end with the
/// halves of the same.
struct Cells {
  const Grid& grid;
  int count() const { return grid.edges() + 1; }
  double end(int j) const { return j < grid.edges() ? grid.centre(j) : grid.length(); }
  std::size_t number(int j) const { return std::size_t(j == grid.edges() ? grid.next(j - 1) : j); }
  std::size_t places() const { return std::size_t(grid.vertices()); }
};

struct Edges {
  const Grid& grid;
  int count() const { return grid.edges(); }
  double end(int j) const { return grid.s(j + 1); }
  std::size_t number(int j) const { return std::size_t(j); }
  std::size_t places() const { return std::size_t(grid.edges()); }
};

/// For each part of the coarse grid, what those of the fine one say, or its inverse, times what
/// they have of its length.
template <bool inverse, class Parts, class Value>
std::vector<Value> added_up(const Parts& fine, const std::vector<Value>& values,
                            const Parts& coarse) {
  constexpr std::size_t N = Value::SizeAtCompileTime;
  using Numbers = std::array<double, N>;  // which stay in registers
  std::vector<Value> out(coarse.places(), Value::Zero());
  Numbers sum{}, of{}, part{};
  const auto take = [&](double length, const Value& value) {
    for (std::size_t i = 0; i < N; ++i) {
      if (value[Eigen::Index(i)] != of[i])  // mostly it is that of the part before
        of[i] = value[Eigen::Index(i)], part[i] = inverse ? 1 / of[i] : of[i];
      sum[i] += length * part[i];
    }
  };
  double from = 0;
  for (int J = 0, j = 0; J < coarse.count(); ++J) {
    const bool last = J + 1 == coarse.count();
    const double end = last ? fine.end(fine.count() - 1) : coarse.end(J);
    for (; j < fine.count() && fine.end(j) <= end; ++j) {
      take(fine.end(j) - from, values[fine.number(j)]);
      from = fine.end(j);
    }
    if (j < fine.count()) take(end - from, values[fine.number(j)]), from = end;
    for (std::size_t i = 0; i < N; ++i)
      out[coarse.number(J)][Eigen::Index(i)] += std::exchange(sum[i], 0.);
  }
  return out;
}

/// The rod on a coarser grid. Compliances add along merged cells and edges, rest curvatures are
/// averaged.
template <class Space>
Rod<Space> merged(const Rod<Space>& rod, const CoarserGrid& to) {
  const Grid& grid = to.grid;
  const Cells cells{rod.grid}, coarse_cells{grid};
  Rod<Space> out{grid,
                 added_up<true>(cells, rod.bending, coarse_cells),
                 added_up<true>(Edges{rod.grid}, rod.stretching, Edges{grid}),
                 added_up<false>(cells, rod.K0, coarse_cells),
                 {}};
  for (int K = 0; K < grid.vertices(); ++K) {
    out.bending[K] = grid.Δs(K) * out.bending[K].cwiseInverse();
    out.K0[K] /= grid.Δs(K);
  }
  for (int J = 0; J < grid.edges(); ++J)
    out.stretching[J] = grid.h(J) * out.stretching[J].cwiseInverse();
  for (auto jump : rod.jumps)
    if ((jump.vertex = to.vertex(jump.vertex)) >= 0) out.jumps.push_back(jump);
  return out;
}

/// Number by number: two in one register would wait for the memory that they just went to.
template <class Value>
void add(double part, const Value& from, Value& to) {
  for (Eigen::Index i = 0; i < from.size(); ++i) to[i] += part * from[i];
}

/// Places that are mostly in order, found on a coarser grid one after another.
class Walk {
 public:
  explicit Walk(const Grid& coarse) : coarse_(coarse) {}

  /// The coarse edge that holds s.
  int edge(double s) {
    if (s < coarse_.s(J_)) J_ = 0;
    while (J_ + 1 < coarse_.edges() && coarse_.s(J_ + 1) <= s) ++J_;
    return J_;
  }
  /// Calls put(vertex, part) for the vertices beside s, as by a lever.
  template <class Put>
  void lever(double s, const Put& put) {
    const int J = edge(s);
    const double t = part((s - coarse_.s(J)) / coarse_.h(J));
    if (t < 1) put(J, 1 - t);
    if (t > 0) put(J + 1, t);
  }
  /// The same of the edges whose centres are beside s.
  template <class Put>
  void lever_of_edges(double s, const Put& put) {
    const int J = edge(s), last = coarse_.edges() - 1;
    const int from = std::max(0, s < coarse_.centre(J) ? J - 1 : J), to = std::min(from + 1, last);
    const double apart = coarse_.centre(to) - coarse_.centre(from);
    const double t = apart > 0 ? part((s - coarse_.centre(from)) / apart) : 0;
    if (t < 1) put(from, 1 - t);
    if (t > 0) put(to, t);
  }

 private:
  /// All or nothing, but for rounding.
  static double part(double t) { return t < 1e-9 ? 0 : t > 1 - 1e-9 ? 1 : t; }

  const Grid& coarse_;
  int J_ = 0;
};

/// What acts on the same coarse edge, or on a vertex of it, is added up if it comes in a row.
template <class Space>
void add_followers(const Loads<Space>& loads, const Grid& grid, const Grid& coarse,
                   Loads<Space>& out) {
  auto& forces = out.follower_forces;
  Walk edges(coarse), vertices(coarse);
  const auto put = [&](int edge, int vertex, const Point<Space>& F) {
    edge = std::clamp(edge, std::max(0, vertex - 1), std::min(vertex, coarse.edges() - 1));
    for (std::size_t i = forces.size(); i-- > 0 && i + 2 >= forces.size();)
      if (forces[i].edge == edge && forces[i].vertex == vertex) {
        forces[i].force += F;
        return;
      }
    forces.push_back({edge, vertex, F});
  };
  for (const auto& f : loads.follower_forces) {
    const int edge = edges.edge(grid.centre(f.edge));
    vertices.lever(grid.s(f.vertex), [&](int J, double part) { put(edge, J, part * f.force); });
  }
  auto& moments = out.follower_moments;
  for (const auto& c : loads.follower_moments) {
    const int edge = edges.edge(grid.centre(c.edge));
    if (!moments.empty() && moments.back().edge == edge)
      moments.back().moment += c.moment;
    else
      moments.push_back({edge, c.moment});
  }
}

/// Loads brought to a coarser grid, as by levers.
template <class Space>
Loads<Space> merged(const Loads<Space>& loads, const Grid& grid, const CoarserGrid& to) {
  const int n = grid.edges(), m = to.grid.edges();
  Loads<Space> out(m);
  Walk vertices(to.grid), centres(to.grid);
  for (int j = 0; j <= n; ++j)
    if (const auto& F = loads.force[j]; !F.isZero(0))
      vertices.lever(grid.s(j), [&](int J, double part) { add(part, F, out.force[J]); });
  for (int j = 0; j < n; ++j)
    if (const auto& M = loads.moment[j]; !M.isZero(0))
      centres.lever_of_edges(grid.centre(j),
                             [&](int J, double part) { add(part, M, out.moment[J]); });
  add_followers(loads, grid, to.grid, out);
  for (auto c : loads.vertex_moments)  // its parts are on the edges beside it already
    if ((c.vertex = to.vertex(c.vertex)) >= 0) out.vertex_moments.push_back(c);
  for (const int j : loads.pushed)
    if (const int J = to.vertex(j); J >= 0) out.pushed.push_back(J);
  out.start_moment = loads.start_moment;
  out.end_moment = loads.end_moment;
  out.follower_end_moment = loads.follower_end_moment;
  return out;
}

}  // namespace detail

/// The network with about `edges` edges in each span that has more.
template <class Space>
Network<Space> coarsened(const Network<Space>& fine, int edges) {
  Network<Space> out{{}, fine.placements, {}, fine.nodes, fine.attachments};
  std::vector<std::vector<int>> ends(fine.rods.size());
  for (const auto& a : fine.attachments) ends[std::size_t(a.rod)].push_back(a.vertex);
  std::vector<detail::CoarserGrid> grids;
  for (std::size_t rod = 0; rod < fine.rods.size(); ++rod) {
    const Grid& grid = fine.rods[rod].grid;
    auto& on = ends[rod];
    on.push_back(0), on.push_back(grid.edges());
    std::ranges::sort(on);
    on.erase(std::ranges::unique(on).begin(), on.end());
    grids.push_back(detail::coarser_grid(grid, on, kinks(fine.rods[rod], fine.loads[rod]), edges));
    out.rods.push_back(detail::merged(fine.rods[rod], grids[rod]));
    out.loads.push_back(detail::merged(fine.loads[rod], grid, grids[rod]));
  }
  for (const auto& tendon : fine.tendons) {
    const auto& to = grids[std::size_t(tendon.rod)];
    out.tendons.push_back(tendon.on(to.grid, [&](int j) { return to.vertex(j); }));
  }
  for (auto& a : out.attachments) a.vertex = grids[std::size_t(a.rod)].vertex(a.vertex);
  return out;
}

}  // namespace pyrod
