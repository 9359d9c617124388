// SPDX-License-Identifier: BSD-3-Clause
/// \file How what is told of an equilibrium changes with its state and its numbers.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/edge_maps.hpp>
#include <pyrod/linear/free_ends.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

template <class Space>
class ToldMaps {
 public:
  using Rotation = typename Space::Rotation;
  static constexpr int dim = Space::dim, spin = Space::spin;

  ToldMaps(const Layout<Space>& layout, const NetworkLoads<Space>& loads,
           const EdgeColumns<Space>& columns, const NetworkState<Space>& x,
           const std::vector<Point<Space>>& sections)
      : layout_(layout),
        net_(layout.network()),
        loads_(loads),
        columns_(columns),
        x_(x),
        sections_(sections),
        state_(layout),
        numbers_(layout),
        told_(layout),
        attached_(layout),
        terms_(CellTerms<Space>(net_).under(x.tensions)),
        unknown_(told_.count(), false) {
    Cells<Space>(layout, x).for_each([&](const auto& cell) { tell(cell); });
    for (int e = 0; e < layout.edges(); ++e) tell_edge(e);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) tell_rod(rod);
    for (int v = 0; v < int(net_.nodes.size()); ++v) tell_node(v);
    for (int i = 0; i < int(net_.tendons.size()); ++i) add_tension(told_.tension(i), i, Mat<1>(1));
  }

  const ItemMap<Space>& of_state() const { return of_state_; }
  const ItemMap<Space>& of_numbers() const { return of_numbers_; }
  /// Items whose derivative is not known here.
  const std::vector<char>& unknown() const { return unknown_; }

 private:
  using Block = Mat<spin>;
  using Row = Eigen::Matrix<double, 1, spin>;

  /// Adds A times the change of −∂ψ/∂φ_a, in the components of frame a, to an item.
  template <class A>
  void tell_moment(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet, int to, const A& of) {
    const Block T = c.T();
    of_state_.add(to, c.a, Block(of * (-jet.aa - spin_skew(jet.a) / 2)));
    of_state_.add(to, c.b, Block(of * -jet.ab));
    of_numbers_.add(to, c.stiffness, Block(of * T * c.strain().asDiagonal()));
    of_numbers_.add(to, c.rest, Block(-of * T * c.k.asDiagonal()));
    terms_.for_each_tendon(c.rod, c.vertex, c.kind, c.u, [&](int i, double, const auto& length) {
      add_tension(to, i, of * T * length.slope);
    });
  }

  /// Of a tension, which is a number or a part of the state.
  template <class Change>
  void add_tension(int to, int tendon, const Change& change) {
    if (layout_.tendon_block(tendon) < 0)
      return of_numbers_.add(to, numbers_.tendon(tendon), change);
    of_state_.add(to, state_.tendon(tendon), change);
  }

  void tell_tendons(const CellOfNetwork<Space>& c) {
    terms_.for_each_tendon(c.rod, c.vertex, c.kind, c.u, [&](int i, double, const auto& length) {
      of_state_.add(told_.tendon_length(i), c.a, Row(-(c.T() * length.slope).transpose()));
      of_state_.add(told_.tendon_length(i), c.b, Row(length.slope.transpose() * c.T()));
    });
  }

  /// The same in space: the frame takes the moment along.
  void tell_spatial(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet, int to, double sign) {
    const Block R = sign * spin_matrix<Space>(c.frame_a);
    tell_moment(c, jet, to, R);
    of_state_.add(to, c.a, Block(R * spin_skew(jet.a)));
  }

  void tell_elastic(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet) {
    const int to = told_.energy();
    of_state_.add(to, c.a, Row(jet.a.transpose())), of_state_.add(to, c.b, Row(jet.b.transpose()));
    of_numbers_.add(to, c.stiffness, Row(c.strain().cwiseAbs2().transpose() / 2));
    of_numbers_.add(to, c.rest, Row(-c.m().transpose()));
  }

  void tell(const CellOfNetwork<Space>& c) {
    tell_elastic(c, c.jet());
    tell_tendons(c);
    const auto jet = c.whole();
    const auto& rod = net_.rods[c.rod];
    const bool at_end = !rod.grid.closed() && c.vertex == rod.edges();
    const int vertex = told_.vertex(c.rod, c.vertex);
    if (c.kind != CellKind::before || at_end) {
      tell_spatial(c, jet, told_.moment(vertex), 1);
      tell_curvature(c, jet, told_.curvature(vertex));
    }
    if (c.kind == CellKind::whole) {
      tell_rotation(c, told_.rotation(vertex));
      return tell_frame_between(c, told_.vertex_turn(vertex));
    }
    const auto& on = layout_.attached(c.rod);
    const auto a = std::ranges::find(on, c.vertex, &Attachment<Space>::vertex);
    tell_spatial(c, jet, told_.reaction_moment(a->node), c.kind == CellKind::before ? 1 : -1);
  }

  /// The mean of a cell; of the half behind a held frame, what the moment there makes, theory (21).
  void tell_curvature(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet, int to) {
    const auto& grid = net_.rods[c.rod].grid;
    const bool inside = c.vertex > 0 && c.vertex < grid.edges();
    Spin<Space> K = c.u / c.length;
    if (c.driven && c.kind != CellKind::whole) {
      unknown_[to] = true;  // it is told by what tendons leave of the moment, theory (37)
      return;
    }
    if (c.kind == CellKind::behind && (inside || grid.closed())) {
      const Spin<Space> give = (c.k * c.length).cwiseInverse();
      K = (c.u0 - jet.a.cwiseQuotient(c.k)) / c.length;
      tell_moment(c, jet, to, Block(give.asDiagonal()));
      of_numbers_.add(to, c.rest, 1 / c.length);
      of_numbers_.add(to, c.stiffness,
                      Block(jet.a.cwiseProduct(give).cwiseQuotient(c.k).asDiagonal()));
    } else {
      of_state_.add(to, c.a, Block(-c.T().transpose() / c.length));
      of_state_.add(to, c.b, Block(c.T() / c.length));
    }
    for (const int e : {c.edge_a, c.edge_b})
      if (e >= 0) of_numbers_.add(to, numbers_.length(e), Spin<Space>(-K / (2 * c.length)));
  }

  /// Of the edges beside, which share a moment as by a lever.
  void tell_rotation(const CellOfNetwork<Space>& c, int to) {
    const auto& grid = net_.rods[c.rod].grid;
    const double part = grid.h(c.vertex == 0 ? grid.edges() - 1 : c.vertex - 1) / (2 * c.length);
    of_state_.add(to, c.a, Block((1 - part) * spin_matrix<Space>(x_.frames[c.edge_a])));
    of_state_.add(to, c.b, Block(part * spin_matrix<Space>(x_.frames[c.edge_b])));
  }

  /// Between two edges, as far as their lengths say.
  void tell_frame_between(const CellOfNetwork<Space>& c, int to) {
    const auto& grid = net_.rods[c.rod].grid;
    const double h = grid.h(c.vertex == 0 ? grid.edges() - 1 : c.vertex - 1),
                 part = h / (2 * c.length);
    const Spin<Space> u = part * c.u;
    const Block D = turn_differential(u);
    of_state_.add(to, c.a,
                  Block(spin_matrix<Space>(exp(Spin<Space>(-u))) - part * D * c.T().transpose()));
    of_state_.add(to, c.b, Block(part * D * c.T()));
    const double l = 2 * c.length;
    of_numbers_.add(to, numbers_.length(c.edge_a), Spin<Space>(D * c.u * (l - h) / (l * l)));
    of_numbers_.add(to, numbers_.length(c.edge_b), Spin<Space>(-D * c.u * h / (l * l)));
  }

  void tell_edge(int e) {
    const EdgeMaps<Space> edge(x_.frames[e], sections_[e], columns_.compliance[e],
                               columns_.lengths[e][0]);
    const int turn = state_.turn(e), force = state_.force(e), S = numbers_.compliance(e);
    of_state_.add(told_.reach(e), turn, edge.reach_of_turn());
    of_state_.add(told_.reach(e), force, edge.reach_of_force());
    of_numbers_.add(told_.reach(e), S, edge.reach_of_compliance());
    of_numbers_.add(told_.reach(e), numbers_.length(e), edge.reach_of_length());
    const Mat<dim, spin> strain = edge.S.asDiagonal() * edge.force_of_turn();
    const Mat<dim> by_force = edge.S.asDiagonal() * edge.R.transpose();
    of_state_.add(told_.strain(e), turn, strain);
    of_state_.add(told_.strain(e), force, by_force);
    of_numbers_.add(told_.strain(e), S, Mat<dim>(edge.b.asDiagonal()));
    const int energy = told_.energy();
    of_state_.add(energy, turn, Row(edge.h * edge.b.transpose() * strain));
    of_state_.add(energy, force,
                  Eigen::Matrix<double, 1, dim>(edge.h * edge.b.transpose() * by_force));
    of_numbers_.add(energy, S,
                    Eigen::Matrix<double, 1, dim>(edge.h / 2 * edge.b.cwiseAbs2().transpose()));
    of_numbers_.add(energy, numbers_.length(e),
                    Mat<1>(edge.b.dot(edge.S.cwiseProduct(edge.b)) / 2));
  }

  void tell_rod(int rod) {
    const auto& r = net_.rods[rod];
    const auto& on = layout_.attached(rod);
    for (int i = 0; i < int(on.size()); ++i) {
      if (!on[i].rigid) continue;
      const int vertex = told_.vertex(rod, on[i].vertex), held = state_.held(attached_.of(rod, i));
      of_state_.add(told_.vertex_turn(vertex), held, 1);
      of_state_.add(told_.rotation(vertex), held, spin_matrix<Space>(held_frame(x_, on[i])));
    }
    const auto ends_in = [&](const auto& a) { return a.rigid; };
    if (!r.grid.closed() && !ends_in(on.front())) tell_end(rod, true);
    if (!r.grid.closed() && !ends_in(on.back())) tell_end(rod, false);
    for (const auto& jump : r.jumps)
      forget(rod, jump.vertex, told_.vertex_turn(0), told_.curvature(0));
    for (const auto& c : net_.loads[rod].vertex_moments) {
      if (c.on_node) continue;
      forget(rod, c.vertex, told_.vertex_turn(0), told_.curvature(0));
      unknown_[told_.moment(told_.vertex(rod, c.vertex))] = unknown_[told_.energy()] = true;
    }
  }

  void forget(int rod, int vertex, int turns, int curvatures) {
    const int number = told_.vertex(rod, vertex);
    unknown_[turns + number] = unknown_[curvatures + number] = true;
  }

  void tell_end(int rod, bool start) {
    const auto& r = net_.rods[rod];
    const int n = r.edges(), e = layout_.edge(rod, start ? 0 : n - 1);
    const auto& q = x_.frames[e];
    const FreeEnd<Space> end(r, net_.loads[rod], terms_, rod, start, q);
    const Side side = start ? Side::before : Side::behind;
    const int vertex = told_.vertex(rod, start ? 0 : n), turn = told_.vertex_turn(vertex),
              K = told_.curvature(vertex);
    const double sign = start ? -1 : 1;
    of_state_.add(turn, state_.turn(e), end.of_edge);
    tell_end_turn(rod, side, end, e, turn, end.of_turn);
    const Block R = spin_matrix<Space>(q * exp(end.w));
    of_state_.add(told_.rotation(vertex), state_.turn(e), Block(R * end.of_edge));
    tell_end_turn(rod, side, end, e, told_.rotation(vertex), Block(R * end.of_turn));
    tell_end_turn(rod, side, end, e, K, Block(sign / end.length * Block::Identity()));
    of_numbers_.add(K, numbers_.length(e),
                    Spin<Space>(-sign * end.w / (end.length * end.length) / 2));
    tell_end_turn(rod, side, end, e, told_.energy(), Row(end.m.transpose()));
    for (const auto& [i, slope] : end.tendons)
      tell_end_turn(rod, side, end, e, told_.tendon_length(i), Row(slope.transpose()));
    if (!end.tendons.empty()) unknown_[K] = true;
    const Spin<Space> strain = end.w - end.rest;
    of_numbers_.add(told_.energy(), numbers_.end_stiffness(rod, side),
                    Row(strain.cwiseAbs2().transpose() / 2));
    of_numbers_.add(told_.energy(), numbers_.end_rest(rod, side), Row(-sign * end.m.transpose()));
    const int moment = told_.moment(vertex);
    if (!end.follows) {
      of_numbers_.add(moment, numbers_.end_moment(rod, side), sign);
      return;
    }
    const Block by_turn = -R * spin_skew(end.M);
    of_numbers_.add(moment, numbers_.end_following(rod), R);
    of_state_.add(moment, state_.turn(e), Block(by_turn * end.of_edge));
    tell_end_turn(rod, side, end, e, moment, Block(by_turn * end.of_turn));
  }

  /// Adds A δw to an item.
  template <class A>
  void tell_end_turn(int rod, Side side, const FreeEnd<Space>& end, int e, int to, const A& of) {
    using Out = Eigen::Matrix<double, A::RowsAtCompileTime, spin>;
    const double sign = end.start ? -1 : 1;
    of_numbers_.add(to, numbers_.end_stiffness(rod, side), Out(of * end.by_k));
    of_numbers_.add(to, numbers_.end_rest(rod, side), Out(sign * of * end.by_rest));
    for (const auto& [i, slope] : end.tendons) add_tension(to, i, -of * end.by_total * slope);
    if (end.follows) {
      of_numbers_.add(to, numbers_.end_following(rod), Out(of * end.by_moment));
      return;
    }
    const Block back = spin_matrix<Space>(x_.frames[e].conjugate());
    of_numbers_.add(to, numbers_.end_moment(rod, side), Out(of * end.by_moment * back));
    of_state_.add(to, state_.turn(e), Out(of * end.by_moment * spin_skew(end.M)));
  }

  /// What is missing to the balance there.
  void tell_node(int v) {
    const int force = told_.reaction_force(v), moment = told_.reaction_moment(v);
    of_state_.add(force, state_.load(v), -1);
    for (const auto& [p, end] : layout_.spans_at(v))
      of_state_.add(force, state_.force(end ? layout_.last_edge(p) : layout_.first_edge(p)),
                    end ? 1 : -1);
    const Block R = spin_matrix<Space>(x_.node_frames[v]);
    const Spin<Space>& follows = loads_.node_follower_moments()[v];
    of_numbers_.add(moment, numbers_.node_moment(v), -1);
    of_numbers_.add(moment, numbers_.node_following(v), Block(-R));
    of_state_.add(moment, state_.node_turn(v), Block(R * spin_skew(follows)));
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkLoads<Space>& loads_;
  const EdgeColumns<Space>& columns_;
  const NetworkState<Space>& x_;
  const std::vector<Point<Space>>& sections_;
  StateItems<Space> state_;
  NumberItems<Space> numbers_;
  ToldItems<Space> told_;
  AttachmentNumbers<Space> attached_;
  CellTerms<Space> terms_;
  std::vector<char> unknown_;
  ItemMap<Space> of_state_, of_numbers_;
};

}  // namespace pyrod
