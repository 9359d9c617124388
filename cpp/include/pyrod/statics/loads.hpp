// SPDX-License-Identifier: BSD-3-Clause
/// \file Dead loads on a rod, brought to the grid: forces to the vertices, couples to the edges.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// Loads fixed in space, all in spatial components. A force at a vertex acts on its position, a
/// couple on an edge acts on its frame; the end couple acts on the end of the rod, behind the last
/// half cell.
template <class Space>
struct Loads {
  std::vector<Point<Space>> force;  ///< on the n + 1 vertices
  std::vector<Spin<Space>> couple;  ///< on the n edges
  Spin<Space> end_couple = Spin<Space>::Zero();
  Spin<Space> start_couple = Spin<Space>::Zero();  ///< what falls to the start: no edge feels it
  Point<Space> start_share = Point<Space>::Zero(), end_share = Point<Space>::Zero();
  ///< what distributed forces put on the first and the last vertex

  explicit Loads(int edges)
      : force(edges + 1, Point<Space>::Zero()), couple(edges, Spin<Space>::Zero()) {}

  /// A force at arc length s, shared by the two vertices beside it as a lever would.
  void add_force(const Grid& grid, const Point<Space>& F, double s) {
    s = grid.on_rod(s);
    const auto& S = grid.arc_lengths();
    int j = int(std::upper_bound(S.begin(), S.end(), s) - S.begin()) - 1;
    j = std::min(j, grid.edges() - 1);
    const double t = (s - grid.s(j)) / (grid.s(j + 1) - grid.s(j));  // 1 at the end, exactly
    force[j] += (1 - t) * F;
    force[j + 1] += t * F;
  }

  /// A couple at arc length s, shared by the two edges whose centres are beside it.
  void add_couple(const Grid& grid, const Spin<Space>& M, double s) {
    s = grid.on_rod(s);
    const int n = grid.edges();
    if (s == grid.length()) {
      end_couple += M;
      return;
    }
    int j = 0;  // first edge whose centre is beyond s
    while (j < n && grid.centre(j) <= s) ++j;
    const double left = j == 0 ? 0 : grid.centre(j - 1);
    const double t = j == n ? 0 : (s - left) / (grid.centre(j) - left);
    (j > 0 ? couple[j - 1] : start_couple) += (1 - t) * M;
    if (j < n) couple[j] += t * M;
  }

  /// Force per length f on each edge: half of it goes to either end of the edge.
  void add_force_per_length(const Grid& grid, const std::vector<Point<Space>>& f) {
    const int n = grid.edges();
    for (int j = 0; j < n; ++j) {
      force[j] += grid.h(j) / 2 * f[j];
      force[j + 1] += grid.h(j) / 2 * f[j];
    }
    start_share += grid.h(0) / 2 * f[0];
    end_share += grid.h(n - 1) / 2 * f[n - 1];
  }

  /// Moment per length on each edge.
  void add_couple_per_length(const Grid& grid, const std::vector<Spin<Space>>& l) {
    for (int j = 0; j < grid.edges(); ++j) couple[j] += grid.h(j) * l[j];
  }

  /// n_{j-1/2}: the section force of every edge when the end is free, all that acts behind it.
  std::vector<Point<Space>> section_forces() const {
    std::vector<Point<Space>> n(couple.size());
    Point<Space> sum = Point<Space>::Zero();
    for (std::size_t j = n.size(); j-- > 0;) n[j] = sum += force[j + 1];
    return n;
  }

  /// n(s_j): the section force at the vertices, just inside the rod at its ends; where a point
  /// force acts, between its values on either side.
  std::vector<Point<Space>> vertex_forces(const Grid& grid) const {
    const auto edge = section_forces();
    const int n = grid.edges();
    std::vector<Point<Space>> out{edge[0] + start_share};
    for (int j = 1; j < n; ++j)
      out.push_back((grid.h(j) * edge[j - 1] + grid.h(j - 1) * edge[j]) / (2 * grid.Δs(j)));
    out.push_back(force[n] - end_share);
    return out;
  }

  /// Σ of the couples behind vertex j: the section moments of a rod that no force acts on.
  std::vector<Spin<Space>> couples_behind() const {
    std::vector<Spin<Space>> m(couple.size() + 1);
    Spin<Space> sum = end_couple;
    m[couple.size()] = sum;
    for (std::size_t j = couple.size(); j-- > 0;) m[j] = sum += couple[j];
    return m;
  }

  /// All that acts is finite, and so are the sums.
  void check() const {
    for (const auto& n : section_forces())
      require(n.allFinite(), "loads: the section force is not finite, ", n.transpose());
    for (const auto& m : couples_behind())
      require(m.allFinite(), "loads: the moments add up to what is not finite, ", m.transpose());
  }

  bool has_couples() const {
    if (!end_couple.isZero(0)) return true;
    for (const auto& m : couple)
      if (!m.isZero(0)) return true;
    return false;
  }
};

}  // namespace pyrod
