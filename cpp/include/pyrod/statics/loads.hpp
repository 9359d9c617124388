// SPDX-License-Identifier: BSD-3-Clause
/// \file Dead loads on a rod, brought to the grid: forces to the vertices, couples to the edges.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>

#include <algorithm>
#include <utility>
#include <vector>

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
struct FollowerCouple {
  int edge;
  Spin<Space> couple;
};

/// Curvature that a rod has at rest at its ends, by which a frame there differs from its edge's.
template <class Space>
struct EndCurvature {
  Spin<Space> start = Spin<Space>::Zero(), end = Spin<Space>::Zero();
};

/// Loads fixed in space, all in spatial components. A force at a vertex acts on its position, a
/// couple on an edge acts on its frame; the end couple acts on the end of the rod, behind the last
/// half cell.
template <class Space>
struct Loads {
  std::vector<Point<Space>> force;  ///< on the n + 1 vertices
  std::vector<Spin<Space>> couple;  ///< on the n edges
  Spin<Space> end_couple = Spin<Space>::Zero();
  Spin<Space> start_couple = Spin<Space>::Zero();  ///< what falls to the start: no edge feels it
  std::vector<Point<Space>> shares;            ///< of distributed forces: half of those on an edge
  std::vector<Point<Space>> following_shares;  ///< the same, in the frame of the edge; or none
  std::vector<FollowerForce<Space>> following_forces;
  std::vector<FollowerCouple<Space>> following_couples;
  Spin<Space> following_end_couple = Spin<Space>::Zero();  ///< in the frame of the end

  explicit Loads(int edges)
      : force(edges + 1, Point<Space>::Zero()), couple(edges, Spin<Space>::Zero()) {}

  /// A force at a place, shared by the two vertices beside it as a lever would.
  void add_force(const Grid&, const Point<Space>& F, const Site& at) {
    force[at.edge] += (1 - at.part) * F;
    force[at.edge + 1] += at.part * F;
  }
  void add_force(const Grid& grid, const Point<Space>& F, double s) {
    add_force(grid, F, Site::on(grid, s));
  }

  /// A couple at a place, shared by the two edges whose centres are beside it.
  void add_couple(const Grid& grid, const Spin<Space>& M, const Site& at) {
    if (at.is_end(grid)) {
      end_couple += M;
      return;
    }
    const auto [behind, t] = between_centres(grid, at);
    (behind > 0 ? couple[behind - 1] : start_couple) += (1 - t) * M;
    if (behind < grid.edges()) couple[behind] += t * M;
  }
  void add_couple(const Grid& grid, const Spin<Space>& M, double s) {
    add_couple(grid, M, Site::on(grid, s));
  }

  /// A force at a place in the components of the frame there: that of the edge; at a vertex half in
  /// that of either edge; at an end in that of the edge, turned on by the curvature at rest.
  void add_following_force(const Grid& grid, const Point<Space>& F, const Site& at,
                           const EndCurvature<Space>& K0 = {}) {
    const auto [j, t] = at;
    const auto put = [&](int edge, int vertex, double part,
                         const Spin<Space>& turn = Spin<Space>::Zero()) {
      following_forces.push_back({edge, vertex, part * Point<Space>(rotate(exp(turn), F))});
    };
    if (t == 0 && j > 0)
      put(j - 1, j, 0.5), put(j, j, 0.5);
    else if (t == 0)
      put(0, 0, 1, -grid.h(0) / 2 * K0.start);
    else if (t == 1)
      put(j, j + 1, 1, grid.h(j) / 2 * K0.end);
    else
      put(j, j, 1 - t), put(j, j + 1, t);
  }
  void add_following_force(const Grid& grid, const Point<Space>& F, double s,
                           const EndCurvature<Space>& K0 = {}) {
    add_following_force(grid, F, Site::on(grid, s), K0);
  }

  void add_following_force_per_length(const Grid& grid, const std::vector<Point<Space>>& f) {
    for (int j = 0; j < grid.edges(); ++j)
      for (const int vertex : {j, j + 1})
        following_forces.push_back({j, vertex, grid.h(j) / 2 * f[j]});
    share_out(grid, f, following_shares);
  }

  /// A couple at a place in the components of the frame there, shared like a dead one.
  void add_following_couple(const Grid& grid, const Spin<Space>& M, const Site& at) {
    if (at.is_end(grid)) {
      following_end_couple += M;
      return;
    }
    const int n = grid.edges();
    const auto [behind, t] = between_centres(grid, at);
    if (behind == 0 || behind == n)
      following_couples.push_back({behind == 0 ? 0 : n - 1, M});
    else
      for (const auto& [edge, part] : {std::pair{behind - 1, 1 - t}, std::pair{behind, t}})
        if (part > 0) following_couples.push_back({edge, part * M});
  }
  void add_following_couple(const Grid& grid, const Spin<Space>& M, double s) {
    add_following_couple(grid, M, Site::on(grid, s));
  }

  void add_following_couple_per_length(const Grid& grid, const std::vector<Spin<Space>>& l) {
    for (int j = 0; j < grid.edges(); ++j) following_couples.push_back({j, grid.h(j) * l[j]});
  }

  /// Force per length f on each edge: half of it goes to either end of the edge.
  void add_force_per_length(const Grid& grid, const std::vector<Point<Space>>& f) {
    const int n = grid.edges();
    for (int j = 0; j < n; ++j) {
      force[j] += grid.h(j) / 2 * f[j];
      force[j + 1] += grid.h(j) / 2 * f[j];
    }
    share_out(grid, f, shares);
  }

  /// By how much distributed forces change the section force over half an edge whose frame is q.
  Point<Space> share(int edge, const typename Space::Rotation& q) const {
    Point<Space> sum = Point<Space>::Zero();
    if (!shares.empty()) sum += shares[edge];
    if (!following_shares.empty()) sum += rotate(q, following_shares[edge]);
    return sum;
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

  /// Sum of all dead couples.
  Spin<Space> total_couple() const {
    Spin<Space> sum = start_couple + end_couple;
    for (const auto& m : couple) sum += m;
    return sum;
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

 private:
  /// The first edge whose centre is behind the place, and how far on the way to it from the centre
  /// before (or the start) the place is; behind the last centre: the number of edges, 0.
  static std::pair<int, double> between_centres(const Grid& grid, const Site& at) {
    const auto [e, part] = at;
    if (part < 0.5) {
      if (e == 0) return {0, 2 * part};
      return {e, (grid.h(e - 1) / 2 + part * grid.h(e)) / grid.Δs(e)};
    }
    if (e == grid.edges() - 1) return {e + 1, 0};
    return {e + 1, (part - 0.5) * grid.h(e) / grid.Δs(e + 1)};
  }

  static void share_out(const Grid& grid, const std::vector<Point<Space>>& f,
                        std::vector<Point<Space>>& out) {
    out.resize(f.size(), Point<Space>::Zero());
    for (int j = 0; j < grid.edges(); ++j) out[j] += grid.h(j) / 2 * f[j];
  }
};

}  // namespace pyrod
