// SPDX-License-Identifier: BSD-3-Clause
/// \file What acts on a network, dead or following it, and the section forces that belong to it.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/end_turn.hpp>
#include <pyrod/statics/unknowns/known_forces.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <cstddef>
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
    renew();
  }

  /// The loads of the layout have changed.
  void renew() {
    follows_ = moments_ = false;
    for (const auto& loads : net_.loads) {
      follows_ = follows_ || !loads.follower_forces.empty() || !loads.follower_moments.empty() ||
                 !loads.follower_end_moment.isZero(0);
      moments_ = moments_ || loads.has_moments() || !loads.start_moment.isZero(0);
    }
    for (const auto& node : net_.nodes) {
      moments_ = moments_ || !node.moment.isZero(0);
      follows_ = follows_ || !node.follower_moment.isZero(0);
    }
    load(1, 1);
  }

  /// Lets only a part of all loads act.
  void load(double forces, double moments) {
    const double part = part_ = forces;
    moments_part_ = moments;
    dead_.vertices = layout_.known().dead_forces();
    for (auto& rod : dead_.vertices)
      for (auto& F : rod) F *= part;
    find_sections(dead_, part);
    set_columns(dead_);
    find_followers();
    find_moments();
  }

  /// Lets α times what acts in the one act together with β times what acts in the other, both on
  /// networks that have the same unknowns as this one.
  void blend(const NetworkLoads& a, double α, const NetworkLoads& b, double β) {
    follows_ = a.follows_ || b.follows_, moments_ = a.moments_ || b.moments_;
    part_ = α * a.part_ + β * b.part_, moments_part_ = α * a.moments_part_ + β * b.moments_part_;
    dead_.vertices.resize(a.dead_.vertices.size());
    for (std::size_t i = 0; i < dead_.vertices.size(); ++i)
      add(a.dead_.vertices[i], α, b.dead_.vertices[i], β, dead_.vertices[i]);
    add(a.dead_.nodes, α, b.dead_.nodes, β, dead_.nodes);
    add(a.dead_.known, α, b.dead_.known, β, dead_.known);
    set_columns(dead_);
    add(a.node_moment_, α, b.node_moment_, β, node_moment_);
    add(a.node_follower_, α, b.node_follower_, β, node_follower_);
    join(a.edge_moments_, α, b.edge_moments_, β, edge_moments_);
    join(a.follower_moments_, α, b.follower_moments_, β, follower_moments_);
    follower_forces_.clear();
    for (const auto& [of, part] : {std::pair(&a, α), std::pair(&b, β)})
      for (auto f : of->follower_forces_) f.force *= part, follower_forces_.push_back(f);
  }

  bool conservative() const { return !follows_ && (spin == 1 || !moments_); }

  const Layout<Space>& layout() const { return layout_; }

  /// Forces on vertices and nodes, and what they tell of the section force in every edge.
  struct Acting {
    VertexForces<Space> vertices;
    std::vector<Point<Space>> nodes, known;
    Columns<dim> columns;  ///< of what is known, for packs
  };

  /// What acts at x: it is kept in `changed` if it is more than the dead loads.
  const Acting& acting(const State& x, Acting& changed) const {
    if (!follows_) return dead_;
    changed.vertices = dead_.vertices;
    for (const auto& f : follower_forces_)
      changed.vertices[f.rod][f.vertex] += rotate(x.frames[f.edge], f.force);
    find_sections(changed, part_);
    set_columns(changed);
    return changed;
  }

  /// The section forces of all edges, of which `now` tells a part.
  std::vector<Point<Space>> sections(const State& x, const Acting& now) const {
    std::vector<Point<Space>> n = now.known;
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      if (layout_.spans()[p].block < 0) continue;
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e) n[e] += x.forces[p];
    }
    return n;
  }

  /// Finds what the forces on vertices make of nodes and spans, of the nodes' own loads `own`.
  void find_sections(Acting& now, double own) const {
    now.nodes = layout_.known().on_nodes(now.vertices, own);
    const auto known = layout_.known().known_forces(now.vertices, own);
    now.known.resize(layout_.edges());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      const auto& force = now.vertices[span.rod];
      Point<Space>* f = now.known.data() + layout_.edge(span.rod, 0);
      if (ends_freely(span)) {
        f[span.last - 1] = now.nodes[span.end];
        for (int j = span.last - 1; j > span.first; --j) f[j - 1] = f[j] + force[j];
      } else {
        f[span.first] = known[p];
        for (int j = span.first + 1; j < span.last; ++j) f[j] = f[j - 1] - force[j];
      }
    }
  }

  /// A force on a vertex of a rod, in the frame of that edge of all.
  struct Following {
    int rod, vertex, edge;
    Point<Space> force;
  };
  /// The parts of them that act.
  const std::vector<Following>& follower_forces() const { return follower_forces_; }

  using Moments = std::vector<std::pair<int, Spin<Space>>>;

  /// Spatial, on edges, with those of ends that turn freely.
  const Moments& edge_moments() const { return edge_moments_; }
  /// Material, on edges.
  const Moments& follower_moments() const { return follower_moments_; }
  /// Spatial, and material, on nodes.
  const std::vector<Spin<Space>>& node_moments() const { return node_moment_; }
  const std::vector<Spin<Space>>& node_follower_moments() const { return node_follower_; }
  const VertexForces<Space>& dead_forces() const { return dead_.vertices; }
  bool follow() const { return follows_; }

 private:
  /// Then sums from there do not lose what is small to what acts elsewhere.
  bool ends_freely(const Span<Space>& span) const {
    const auto& end = net_.nodes[span.end];
    return span.open.cols() == 0 && layout_.derived(span.end) && end.free.cols() == dim &&
           end.spring == 0 && layout_.spans_at(span.end).size() == 1;
  }

  static void set_columns(Acting& now) {
    now.columns.assign(int(now.known.size()), [&](int e) { return now.known[e]; });
  }

  template <class List>
  static void add(const List& a, double α, const List& b, double β, List& out) {
    out.resize(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) out[i] = α * a[i] + β * b[i];
  }
  static void join(const Moments& a, double α, const Moments& b, double β, Moments& out) {
    out.clear();
    for (const auto& [edge, m] : a) out.emplace_back(edge, α * m);
    for (const auto& [edge, m] : b) out.emplace_back(edge, β * m);
  }

  void find_followers() {
    follower_forces_.clear();
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& f : net_.loads[rod].follower_forces)
        follower_forces_.push_back({rod, f.vertex, layout_.edge(rod, f.edge), part_ * f.force});
  }

  void find_moments() {
    edge_moments_.clear();
    follower_moments_.clear();
    node_moment_.clear();
    node_follower_.clear();
    for (const auto& node : net_.nodes) {
      node_moment_.push_back(moments_part_ * node.moment);
      node_follower_.push_back(moments_part_ * node.follower_moment);
    }
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const auto& loads = net_.loads[rod];
      const int n = net_.rods[rod].edges();
      const auto& on = layout_.attached(rod);
      const bool closed = net_.rods[rod].grid.closed();
      for (int j = 0; j < n; ++j) {
        Spin<Space> m = loads.moment[j];
        if (!closed && j == 0 && !on.front().rigid) m += loads.start_moment;
        if (!closed && j == n - 1 && !on.back().rigid) m += loads.end_moment;
        if (!m.isZero(0)) edge_moments_.emplace_back(layout_.edge(rod, j), moments_part_ * m);
      }
      for (const auto& c : loads.follower_moments)
        follower_moments_.emplace_back(layout_.edge(rod, c.edge), moments_part_ * c.moment);
      if (!closed && !loads.follower_end_moment.isZero(0)) find_follower_end(rod, on.back());
      for (const auto& a : on) {
        if (!a.rigid || closed) continue;
        if (a.vertex == 0) node_moment_[a.node] += moments_part_ * loads.start_moment;
        if (a.vertex == n) node_moment_[a.node] += moments_part_ * loads.end_moment;
      }
    }
  }

  /// A moment that follows the end: on the node that the end is fixed to, or on the last edge what
  /// the half cell hands on.
  void find_follower_end(int rod, const Attachment<Space>& end) {
    const auto& r = net_.rods[rod];
    const int n = r.edges();
    const Spin<Space> M = moments_part_ * net_.loads[rod].follower_end_moment;
    if (end.rigid) {
      node_follower_[end.node] += rotate_spin(end.relative, M);
      return;
    }
    const CellTerms<Space> terms(net_);
    const Spin<Space> u = turn_of_end<Space>(terms, r, rod, End::end, M, true);
    Spin<Space> handed_on = transmitted_moment<Space>(u, r.bending[n], r.K0[n], r.grid.Δs(n));
    if (!terms.none(rod, n, CellKind::before))
      handed_on += typename Space::Differential(u).T() * terms.at(rod, n, CellKind::before, u).m;
    follower_moments_.emplace_back(layout_.edge(rod, n - 1), handed_on);
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  Acting dead_;
  Moments edge_moments_, follower_moments_;
  std::vector<Following> follower_forces_;
  std::vector<Spin<Space>> node_moment_, node_follower_;
  double part_ = 1, moments_part_ = 1;
  bool follows_ = false, moments_ = false;
};

}  // namespace pyrod
