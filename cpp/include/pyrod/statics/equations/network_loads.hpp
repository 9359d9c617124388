// SPDX-License-Identifier: BSD-3-Clause
/// \file What acts on a network, dead or following it, and the section forces that belong to it.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/unknowns/known_forces.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
class NetworkLoads {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;
  static constexpr int dim = Space::dim, spin = Space::spin;

  explicit NetworkLoads(const Layout<Space>& layout) : layout_(layout), net_(layout.network()) {
    for (const auto& loads : net_.loads) {
      follows_ = follows_ || !loads.following_forces.empty() || !loads.following_couples.empty() ||
                 !loads.following_end_couple.isZero(0);
      couples_ = couples_ || loads.has_couples() || !loads.start_couple.isZero(0);
    }
    for (const auto& node : net_.nodes) {
      couples_ = couples_ || !node.moment.isZero(0);
      follows_ = follows_ || !node.following_moment.isZero(0);
    }
    load(1);
  }

  /// Lets only a part of all loads act.
  void load(double part) {
    part_ = part;
    dead_.vertices = layout_.known().dead_forces();
    for (auto& rod : dead_.vertices)
      for (auto& F : rod) F *= part;
    tell(dead_, part);
    set_columns(dead_);
    find_couples();
  }

  bool conservative() const { return !follows_ && (spin == 1 || !couples_); }

  /// What acts, and what it makes of the section forces.
  struct Forces {
    VertexForces<Space> vertices;
    std::vector<Point<Space>> nodes, sections;  ///< sections: n on every edge
  };

  Forces forces(const State& x) const {
    Acting changed;
    const Acting& now = acting(x, changed);
    Forces out{now.vertices, now.nodes, now.told};
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
        out.sections[e] += x.forces[p];
    return out;
  }

  const Layout<Space>& layout() const { return layout_; }

  /// Forces on vertices and nodes, and what they tell of the section force in every edge.
  struct Acting {
    VertexForces<Space> vertices;
    std::vector<Point<Space>> nodes, told;
    Columns<dim> columns;  ///< of what is told, for packs
  };

  /// What acts at x: it is kept in `changed` if it is more than the dead loads.
  const Acting& acting(const State& x, Acting& changed) const {
    if (!follows_) return dead_;
    changed.vertices = dead_.vertices;
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& f : net_.loads[rod].following_forces)
        changed.vertices[rod][f.vertex] +=
            part_ * rotate(x.frames[layout_.edge(rod, f.edge)], f.force);
    tell(changed, part_);
    set_columns(changed);
    return changed;
  }

  /// Finds what the forces on vertices make of nodes and spans, of the nodes' own loads `own`.
  void tell(Acting& now, double own) const {
    now.nodes = layout_.known().on_nodes(now.vertices, own);
    const auto known = layout_.known().known_forces(now.vertices, own);
    now.told.resize(layout_.edges());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      Point<Space> f = known[p];
      for (int j = span.first; j < span.last; ++j) {
        if (j > span.first) f -= now.vertices[span.rod][j];
        now.told[layout_.edge(span.rod, j)] = f;
      }
    }
  }

  using Couples = std::vector<std::pair<int, Spin<Space>>>;

  /// Spatial, on edges, with those of ends that turn freely.
  const Couples& edge_couples() const { return edge_couples_; }
  /// Material, on edges.
  const Couples& following_couples() const { return following_couples_; }
  /// Spatial, and material, on nodes.
  const std::vector<Spin<Space>>& node_moments() const { return node_moment_; }
  const std::vector<Spin<Space>>& following_moments() const { return node_following_; }
  const VertexForces<Space>& dead_forces() const { return dead_.vertices; }
  bool follow() const { return follows_; }
  /// Of all loads, the part that acts.
  double part() const { return part_; }

 private:
  static void set_columns(Acting& now) {
    now.columns.assign(int(now.told.size()), [&](int e) { return now.told[e]; });
  }

  void find_couples() {
    edge_couples_.clear();
    following_couples_.clear();
    node_moment_.clear();
    node_following_.clear();
    for (const auto& node : net_.nodes) {
      node_moment_.push_back(part_ * node.moment);
      node_following_.push_back(part_ * node.following_moment);
    }
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const auto& loads = net_.loads[rod];
      const int n = net_.rods[rod].edges();
      const auto& on = layout_.attached(rod);
      const bool closed = net_.rods[rod].grid.closed();
      for (int j = 0; j < n; ++j) {
        Spin<Space> m = loads.couple[j];
        if (!closed && j == 0 && !on.front().rigid) m += loads.start_couple;
        if (!closed && j == n - 1 && !on.back().rigid) m += loads.end_couple;
        if (!m.isZero(0)) edge_couples_.emplace_back(layout_.edge(rod, j), part_ * m);
      }
      for (const auto& c : loads.following_couples)
        following_couples_.emplace_back(layout_.edge(rod, c.edge), part_ * c.couple);
      if (!closed && !loads.following_end_couple.isZero(0)) find_following_end(rod, on.back());
      for (const auto& a : on) {
        if (!a.rigid || closed) continue;
        if (a.vertex == 0) node_moment_[a.node] += part_ * loads.start_couple;
        if (a.vertex == n) node_moment_[a.node] += part_ * loads.end_couple;
      }
    }
  }

  /// A moment that follows the end: on the node that the end is fixed to, or on the last edge what
  /// the half cell hands on.
  void find_following_end(int rod, const Attachment<Space>& end) {
    const auto& r = net_.rods[rod];
    const int n = r.edges();
    const Spin<Space> M = part_ * net_.loads[rod].following_end_couple;
    if (end.rigid) {
      node_following_[end.node] += rotate_spin(end.relative, M);
      return;
    }
    const Spin<Space> u = turn_under_moment_behind<Space>(M, r.bending[n], r.K0[n], r.grid.Δs(n));
    following_couples_.emplace_back(
        layout_.edge(rod, n - 1),
        transmitted_moment<Space>(u, r.bending[n], r.K0[n], r.grid.Δs(n)));
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  Acting dead_;
  Couples edge_couples_, following_couples_;
  std::vector<Spin<Space>> node_moment_, node_following_;
  double part_ = 1;
  bool follows_ = false, couples_ = false;
};

}  // namespace pyrod
