// SPDX-License-Identifier: BSD-3-Clause
/// \file Loads on a rod, brought to the grid: forces to the vertices, moments to the edges.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/point_loads.hpp>

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

namespace pyrod {

/// Dead ones are in spatial components, those that follow in the components of frames. A force at a
/// vertex acts on its position, a moment on an edge acts on its frame; the end moment acts on the
/// end of the rod, behind the last half cell.
template <class Space>
struct Loads {
  std::vector<Point<Space>> force;  ///< on the n + 1 vertices
  std::vector<Spin<Space>> moment;  ///< on the n edges
  Spin<Space> end_moment = Spin<Space>::Zero();
  Spin<Space> start_moment = Spin<Space>::Zero();  ///< what falls to the start: no edge feels it
  std::vector<Point<Space>> shares;           ///< of distributed forces: half of those on an edge
  std::vector<Point<Space>> follower_shares;  ///< the same, in the frame of the edge; or none
  std::vector<FollowerForce<Space>> follower_forces;
  std::vector<FollowerMoment<Space>> follower_moments;
  Spin<Space> follower_end_moment = Spin<Space>::Zero();  ///< in the frame of the end
  std::vector<int> pushed;                                ///< vertices on which point forces act
  std::vector<VertexMoment<Space>> vertex_moments;        ///< are among the moments as well

  explicit Loads(int edges)
      : force(edges + 1, Point<Space>::Zero()), moment(edges, Spin<Space>::Zero()) {}

  /// A force at a place, shared by the two vertices beside it as a lever would.
  void add_force(const Grid& grid, const Point<Space>& F, const Site& at) {
    check_edges(grid.edges());
    note_force(at);
    force[at.edge] += (1 - at.part) * F;
    force[at.edge + 1] += at.part * F;
  }
  void add_force(const Grid& grid, const Point<Space>& F, double s) {
    add_force(grid, F, Site::on(grid, s));
  }

  /// A moment at a place, shared by the two edges whose centres are beside it.
  void add_moment(const Grid& grid, const Spin<Space>& M, const Site& at) {
    check_edges(grid.edges());
    if (at.is_end(grid)) {
      end_moment += M;
      return;
    }
    const auto [behind, t] = between_centres(grid, at);
    (behind > 0 ? moment[behind - 1] : start_moment) += (1 - t) * M;
    if (behind < grid.edges()) moment[behind] += t * M;
    note_moment(grid, {behind, M, (1 - t) * M, t * M, false}, at);
  }
  void add_moment(const Grid& grid, const Spin<Space>& M, double s) {
    add_moment(grid, M, Site::on(grid, s));
  }

  /// A force at a place in the components of the frame there: that of the edge; at a vertex between
  /// those of the edges beside it, as it lies between their centres; at an end that of the edge,
  /// turned on by the curvature at rest.
  void add_follower_force(const Grid& grid, const Point<Space>& F, const Site& at,
                          const EndCurvature<Space>& K0 = {}) {
    check_edges(grid.edges());
    note_force(at);
    const auto [j, t] = at;
    const auto put = [&](int edge, int vertex, double part,
                         const Spin<Space>& turn = Spin<Space>::Zero()) {
      follower_forces.push_back({edge, vertex, part * Point<Space>(rotate(exp(turn), F))});
    };
    if (t == 0 && j > 0)
      put(j - 1, j, grid.h(j) / (2 * grid.Δs(j))), put(j, j, grid.h(j - 1) / (2 * grid.Δs(j)));
    else if (t == 0)
      put(0, 0, 1, -grid.h(0) / 2 * K0.start);
    else if (t == 1)
      put(j, j + 1, 1, grid.h(j) / 2 * K0.end);
    else
      put(j, j, 1 - t), put(j, j + 1, t);
  }
  void add_follower_force(const Grid& grid, const Point<Space>& F, double s,
                          const EndCurvature<Space>& K0 = {}) {
    add_follower_force(grid, F, Site::on(grid, s), K0);
  }

  void add_follower_force_per_length(const Grid& grid, const std::vector<Point<Space>>& f) {
    check_along(grid, f.size(), "force_per_length");
    for (int j = 0; j < grid.edges(); ++j)
      for (const int vertex : {j, j + 1})
        follower_forces.push_back({j, vertex, grid.h(j) / 2 * f[j]});
    share_out(grid, f, follower_shares);
  }

  /// A moment at a place in the components of the frame there, shared like a dead one. The frames
  /// of the edges beside it are turned back by what the moment itself bends their halves,
  /// `compliance` 1/C: else at a vertex the sum would be off by a part of h C⁻¹ M × M.
  void add_follower_moment(const Grid& grid, const Spin<Space>& M, const Site& at,
                           const Spin<Space>& compliance = Spin<Space>::Zero()) {
    check_edges(grid.edges());
    if (at.is_end(grid)) {
      follower_end_moment += M;
      return;
    }
    const int n = grid.edges();
    const auto [j, t] = between_centres(grid, at);
    if (j == 0 || j == n) {
      follower_moments.push_back({j == 0 ? 0 : n - 1, M});
      return;
    }
    const auto part = [&](double of, double length) -> Spin<Space> {
      return of * rotate_spin(exp(Spin<Space>(length * of * compliance.cwiseProduct(M))), M);
    };
    const double apart = grid.Δs(j);
    const Spin<Space> before = part(1 - t, t * apart), behind = part(t, (1 - t) * apart);
    if (t < 1) follower_moments.push_back({j - 1, before});
    if (t > 0) follower_moments.push_back({j, behind});
    note_moment(grid, {j, M, before, behind, true}, at);
  }
  void add_follower_moment(const Grid& grid, const Spin<Space>& M, double s,
                           const Spin<Space>& compliance = Spin<Space>::Zero()) {
    add_follower_moment(grid, M, Site::on(grid, s), compliance);
  }

  void add_follower_moment_per_length(const Grid& grid, const std::vector<Spin<Space>>& l) {
    check_along(grid, l.size(), "moment_per_length");
    for (int j = 0; j < grid.edges(); ++j) follower_moments.push_back({j, grid.h(j) * l[j]});
  }

  /// Takes what acts at an inner vertex from the edges beside it, and keeps it as acting on a node:
  /// the sum of what is dead, and of what follows the vertex, in its components.
  std::pair<Spin<Space>, Spin<Space>> take_moments(int vertex) {
    Spin<Space> dead = Spin<Space>::Zero(), following = dead;
    for (auto& c : vertex_moments) {
      if (c.vertex != vertex || c.on_node) continue;
      c.on_node = true;
      (c.follows ? following : dead) += c.moment;
      for (const auto& [edge, part] :
           {std::pair(vertex - 1, c.before), std::pair(vertex, c.behind)})
        if (c.follows)
          drop_follower(edge, part);
        else
          moment[edge] -= part;
    }
    return {dead, following};
  }

  /// Force per length f on each edge: half of it goes to either end of the edge.
  void add_force_per_length(const Grid& grid, const std::vector<Point<Space>>& f) {
    check_along(grid, f.size(), "force_per_length");
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
    if (!follower_shares.empty()) sum += rotate(q, follower_shares[edge]);
    return sum;
  }

  /// Moment per length on each edge.
  void add_moment_per_length(const Grid& grid, const std::vector<Spin<Space>>& l) {
    check_along(grid, l.size(), "moment_per_length");
    for (int j = 0; j < grid.edges(); ++j) moment[j] += grid.h(j) * l[j];
  }

  /// n_{j-1/2}: the section force of every edge when the end is free, all that acts behind it.
  std::vector<Point<Space>> section_forces() const {
    std::vector<Point<Space>> n(moment.size());
    Point<Space> sum = Point<Space>::Zero();
    for (std::size_t j = n.size(); j-- > 0;) n[j] = sum += force[j + 1];
    return n;
  }

  /// Sum of all dead moments.
  Spin<Space> total_moment() const {
    Spin<Space> sum = start_moment + end_moment;
    for (const auto& m : moment) sum += m;
    return sum;
  }

  /// Σ of the moments behind vertex j: the section moments of a rod that no force acts on.
  std::vector<Spin<Space>> moments_behind() const {
    std::vector<Spin<Space>> m(moment.size() + 1);
    Spin<Space> sum = end_moment;
    m[moment.size()] = sum;
    for (std::size_t j = moment.size(); j-- > 0;) m[j] = sum += moment[j];
    return m;
  }

  /// Whether some of it turns with the rod.
  bool follow() const {
    return !follower_forces.empty() || !follower_moments.empty() || !follower_shares.empty() ||
           !follower_end_moment.isZero(0);
  }

  /// The lists fit each other, all that acts is finite, and so are the sums.
  void check() const {
    check_lists();
    check_followers();
    Point<Space> n = Point<Space>::Zero();  // what is not finite leaves no sum finite
    for (std::size_t j = force.size(); j-- > 0;) n += force[j];
    require(n.allFinite(), "loads: the section force is not finite, ", n.transpose());
    Spin<Space> m = end_moment;
    for (std::size_t j = moment.size(); j-- > 0;) m += moment[j];
    m += start_moment;
    require(m.allFinite(), "loads: the moments add up to what is not finite, ", m.transpose());
  }

  /// The same, on a rod of so many edges.
  void check(int edges) const {
    check_edges(edges);
    check();
  }

  bool has_moments() const {
    if (!end_moment.isZero(0)) return true;
    for (const auto& m : moment)
      if (!m.isZero(0)) return true;
    return false;
  }

 private:
  void check_edges(int edges) const {
    require(int(moment.size()) == edges, "loads: made for ", moment.size(),
            " edges, on a rod that has ", edges, "; make them by Loads(rod.edges())");
    require_count(Eigen::Index(force.size()), edges + 1, "loads.force", "one per vertex");
  }

  void check_along(const Grid& grid, std::size_t count, std::string_view name) const {
    check_edges(grid.edges());
    require_count(Eigen::Index(count), grid.edges(), name, "one per edge");
  }

  void check_lists() const {
    const auto edges = Eigen::Index(moment.size());
    require_count(Eigen::Index(force.size()), edges + 1, "loads.force", "one per vertex");
    for (const auto* list : {&shares, &follower_shares}) {
      if (list->empty()) continue;
      require_count(Eigen::Index(list->size()), edges, "loads.shares", "one per edge, or none");
      for (const auto& f : *list)
        require(f.allFinite(), "loads: a distributed force is not finite, ", f.transpose());
    }
  }

  void check_followers() const {
    const int edges = int(moment.size());
    for (const auto& f : follower_forces)
      require(f.edge >= 0 && f.edge < edges && (f.vertex == f.edge || f.vertex == f.edge + 1) &&
                  f.force.allFinite(),
              "loads: a following force on edge ", f.edge, " and vertex ", f.vertex, " of ", edges,
              " edges, ", f.force.transpose(),
              "; expected an edge of the rod, one of its two "
              "vertices, and finite numbers");
    for (const auto& c : follower_moments)
      require(c.edge >= 0 && c.edge < edges && c.moment.allFinite(),
              "loads: a following moment on edge ", c.edge, " of ", edges, ", ",
              c.moment.transpose(), "; expected an edge of the rod, and finite numbers");
    require(follower_end_moment.allFinite(), "loads: a following moment is not finite, ",
            follower_end_moment.transpose());
  }

  void drop_follower(int edge, const Spin<Space>& part) {
    const auto is = [&](const auto& c) { return c.edge == edge && c.moment == part; };
    const auto found = std::ranges::find_if(follower_moments, is);
    if (found != follower_moments.end()) follower_moments.erase(found);
  }

  void note_force(const Site& at) {
    if (const int j = at.vertex(); j >= 0) pushed.push_back(j);
  }

  /// Keeps a moment, shared by the edges beside its vertex, if that is its place.
  void note_moment(const Grid& grid, const VertexMoment<Space>& shared, const Site& at) {
    const int j = shared.vertex;
    if (j > 0 && j < grid.edges() && at.vertex() == j) vertex_moments.push_back(shared);
  }

  static void share_out(const Grid& grid, const std::vector<Point<Space>>& f,
                        std::vector<Point<Space>>& out) {
    out.resize(f.size(), Point<Space>::Zero());
    for (int j = 0; j < grid.edges(); ++j) out[j] += grid.h(j) / 2 * f[j];
  }
};

}  // namespace pyrod
