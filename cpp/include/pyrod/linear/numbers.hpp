// SPDX-License-Identifier: BSD-3-Clause
/// \file The numbers of a network that is like another one: what may differ between the two.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cstddef>

namespace pyrod {

namespace detail {

template <class A, class B>
bool alike(const A& a, const B& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a - b).norm() <= 1e-9 * b.norm();
}

/// Refuses what differs from `base` in more than numbers.
template <class Space>
void require_alike(const Layout<Space>& layout, const Layout<Space>& base) {
  const auto &net = layout.network(), &like = base.network();
  require(layout.unknowns() == base.unknowns() && net.rods.size() == like.rods.size() &&
              net.nodes.size() == like.nodes.size() && layout.spans().size() == base.spans().size(),
          "linear: what changes the rods' edges, or what supports hold, has no derivative");
  for (std::size_t i = 0; i < net.rods.size(); ++i) {
    const auto &a = net.loads[i], &b = like.loads[i];
    const bool same =
        net.rods[i].edges() == like.rods[i].edges() &&
        std::ranges::equal(a.follower_forces, b.follower_forces, [](const auto& f, const auto& g) {
          return f.edge == g.edge && f.vertex == g.vertex;
        });
    require(same, "linear: what changes the rods' edges, or places of loads, has no derivative");
    const auto same_place = [](const auto& f, const auto& g) {
      return f.vertex == g.vertex && f.rigid == g.rigid &&
             f.hinge.has_value() == g.hinge.has_value() && (!f.hinge || alike(*f.hinge, *g.hinge));
    };
    require(std::ranges::equal(layout.attached(int(i)), base.attached(int(i)), same_place),
            "linear: a change of the axis of a hinge, or of a place, has no derivative here");
  }
  for (int v = 0; v < int(net.nodes.size()); ++v) {
    const auto &a = net.nodes[v], &b = like.nodes[v];
    require(alike(a.free / layout.unit_length(v), b.free / base.unit_length(v)) &&
                alike(a.turns, b.turns) && a.force == b.force,
            "linear: a change of the directions in which a support lets rods move, or turn, has no "
            "derivative here");
  }
}

/// Tendons may differ in their tensions only, and their rods not in the lengths of edges.
template <class Space>
void require_same_tendons(const Network<Space>& net, const Network<Space>& like) {
  const auto same = [](const RoutedTendon& a, const RoutedTendon& b) { return a.runs_like(b); };
  require(
      std::ranges::equal(net.tendons, like.tendons, same),
      "linear: a change of the offset of a tendon, of its ends, or of its EA, has no derivative "
      "here");
  for (const auto& tendon : net.tendons)
    require(net.rods[tendon.rod].grid.edge_lengths() == like.rods[tendon.rod].grid.edge_lengths(),
            "linear: a change of the length of a rod with tendons has no derivative here");
}

}  // namespace detail

/// Of a network whose layout is like `base`, at the state x of that. Frames as turns from those of
/// `base`; forces that follow rods as they are at x.
template <class Space>
class NumbersOf {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  NumbersOf(const Layout<Space>& layout, const Layout<Space>& base, const NetworkState<Space>& x)
      : layout_(layout),
        net_(layout.network()),
        base_(base),
        x_(x),
        items_(base),
        out_(Items<Space>::Zero(item_width<Space>, items_.count())) {
    detail::require_alike(layout, base);
    detail::require_same_tendons(net_, base.network());
    set_edges();
    for (int i = 0; i < int(net_.tendons.size()); ++i)
      out_(0, items_.tendon(i)) = net_.tendons[i].length.value_or(net_.tendons[i].tension);
    const NetworkLoads<Space> loads(layout);
    for (const auto& [e, m] : loads.edge_moments()) add(items_.moment(e), m);
    for (const auto& [e, m] : loads.follower_moments()) add(items_.following(e), m);
    for (int v = 0; v < int(net_.nodes.size()); ++v) set_node(v, loads);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) set_rod(rod);
    set_attachments();
  }

  const Items<Space>& values() const { return out_; }

 private:
  template <class Value>
  void add(int item, const Value& value) {
    out_.col(item).head(value.size()) += value;
  }

  void set_edges() {
    const auto columns = edge_columns(layout_);
    for (int e = 0; e < layout_.edges(); ++e) {
      add(items_.stiffness(e), columns.stiffness[e]), add(items_.rest(e), columns.rest[e]);
      add(items_.length(e), columns.lengths[e]), add(items_.compliance(e), columns.compliance[e]);
    }
  }

  void set_node(int v, const NetworkLoads<Space>& loads) {
    const auto &node = net_.nodes[v], &base = base_.network().nodes[v];
    add(items_.position(v), node.position);
    add(items_.frame(v), log(principal(base.frame.conjugate() * node.frame)));
    add(items_.node_moment(v), loads.node_moments()[v]);
    add(items_.node_following(v), loads.node_follower_moments()[v]);
    out_(0, items_.spring(v)) = node.spring;
    out_(0, items_.torsion(v)) = node.torsion_spring;
  }

  void set_rod(int rod) {
    const auto& r = net_.rods[rod];
    const auto& loads = net_.loads[rod];
    for (int j = 0; j <= r.edges(); ++j) add(items_.force(rod, j), loads.force[j]);
    for (const auto& f : loads.follower_forces)
      add(items_.force(rod, f.vertex), rotate(x_.frames[layout_.edge(rod, f.edge)], f.force));
    if (r.grid.closed()) return;
    for (const auto& [side, j] : {std::pair(Side::before, 0), std::pair(Side::behind, r.edges())}) {
      add(items_.end_stiffness(rod, side), Spin<Space>(r.bending[j] / r.grid.Δs(j)));
      add(items_.end_rest(rod, side), Spin<Space>(r.grid.Δs(j) * r.K0[j]));
    }
    add(items_.end_moment(rod, Side::before), loads.start_moment);
    add(items_.end_moment(rod, Side::behind), loads.end_moment);
    add(items_.end_following(rod), loads.follower_end_moment);
  }

  void set_attachments() {
    int number = 0;
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const auto &on = layout_.attached(rod), &like = base_.attached(rod);
      for (std::size_t i = 0; i < on.size(); ++i, ++number) set(rod, on[i], like[i], number);
    }
  }

  void set(int rod, const Attachment<Space>& a, const Attachment<Space>& like, int number) {
    const auto& r = net_.rods[rod];
    const int n = r.edges(), j = a.vertex;
    const bool closed = r.grid.closed();
    add(items_.relative(number), log(principal(like.relative.conjugate() * a.relative)));
    const auto put = [&](Side side, const Spin<Space>& C, const Spin<Space>& K0, double length) {
      add(items_.stiffness(number, side), Spin<Space>(C / length));
      add(items_.rest(number, side), Spin<Space>(length * K0));
    };
    if (!a.rigid) {
      if (closed || (j > 0 && j < n)) put(Side::before, r.bending[j], r.K0[j], r.grid.Δs(j));
      return;
    }
    const auto sides = r.sides(j);
    if (closed || j > 0)
      put(Side::before, sides.bending_before, sides.K0_before, r.grid.h(j > 0 ? j - 1 : n - 1) / 2);
    if (j < n) put(Side::behind, sides.bending_behind, sides.K0_behind, r.grid.h(j) / 2);
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const Layout<Space>& base_;
  const NetworkState<Space>& x_;
  NumberItems<Space> items_;
  Items<Space> out_;
};

}  // namespace pyrod
