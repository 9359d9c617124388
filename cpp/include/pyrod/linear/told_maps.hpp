// SPDX-License-Identifier: BSD-3-Clause
/// \file How what is told of an equilibrium changes with its state and its numbers, at nodes and
/// ends of rods. Edges and what is between them: see `Chains`.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/free_ends.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/rotation/space.hpp>
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

  /// `at` must stay where it is.
  explicit ToldMaps(const AtState<Space>& at)
      : at_(at), terms_(CellTerms<Space>(at.net).under(at.x.tensions)) {
    const Cells<Space> cells(at.layout, at.x);
    cells.for_each_half([&](const auto& cell) { tell(cell); });
    cells.for_each_driven([&](const auto& cell) { tell_driven(cell); });
    for (int rod = 0; rod < int(at.net.rods.size()); ++rod) tell_rod(rod);
    for (int v = 0; v < int(at.net.nodes.size()); ++v) tell_node(v);
    for (int i = 0; i < int(at.net.tendons.size()); ++i)
      add_tension(at.told.tension(i), i, Mat<1>(1));
  }

  const ItemMap<Space>& of_state() const { return of_state_; }
  const ItemMap<Space>& of_numbers() const { return of_numbers_; }
  /// Items whose derivative is not known here.
  const std::vector<int>& unknown() const { return unknown_; }

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
    tell_tensions(c, to, Block(of * T));
  }

  /// `of`: of the moment in the cell.
  void tell_tensions(const CellOfNetwork<Space>& c, int to, const Block& of) {
    terms_.for_each_tendon(c.rod, c.vertex, c.kind, c.u, [&](int i, double, const auto& length) {
      add_tension(to, i, of * length.slope);
    });
  }

  /// Of a tension, which is a number or a part of the state.
  template <class Change>
  void add_tension(int to, int tendon, const Change& change) {
    const bool given = at_.layout.tendon_block(tendon) < 0;
    (given ? of_numbers_ : of_state_)
        .add(to, given ? at_.numbers.tendon(tendon) : at_.state.tendon(tendon), change);
  }

  void tell_tendons(const CellOfNetwork<Space>& c) {
    terms_.for_each_tendon(c.rod, c.vertex, c.kind, c.u, [&](int i, double, const auto& length) {
      const int to = at_.told.tendon_length(i);
      of_state_.add(to, c.a, Row(-(c.T() * length.slope).transpose()));
      of_state_.add(to, c.b, Row(length.slope.transpose() * c.T()));
    });
  }

  /// The same in space: the frame takes the moment along.
  void tell_spatial(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet, int to, double sign) {
    const Block R = sign * spin_matrix<Space>(c.frame_a);
    tell_moment(c, jet, to, R);
    of_state_.add(to, c.a, Block(R * spin_skew(jet.a)));
  }

  void tell_elastic(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet) {
    of_state_.add(at_.told.energy(), c.a, Row(jet.a.transpose()));
    of_state_.add(at_.told.energy(), c.b, Row(jet.b.transpose()));
    of_numbers_.add(at_.told.energy(), c.stiffness, Row(c.strain().cwiseAbs2().transpose() / 2));
    of_numbers_.add(at_.told.energy(), c.rest, Row(-c.m().transpose()));
  }

  /// Of a cell between two edges, what tendons add to that of `Chains`.
  void tell_driven(const CellOfNetwork<Space>& c) {
    tell_tendons(c);
    const Block R = spin_matrix<Space>(c.frame_a);
    tell_tensions(c, at_.told.moment(at_.told.vertex(c.rod, c.vertex)), Block(R * c.T()));
  }

  void tell(const CellOfNetwork<Space>& c) {
    tell_elastic(c, c.jet());
    tell_tendons(c);
    const auto jet = c.whole();
    const auto& rod = at_.net.rods[c.rod];
    const bool at_end = !rod.grid.closed() && c.vertex == rod.edges();
    const int vertex = at_.told.vertex(c.rod, c.vertex);
    if (c.kind != CellKind::before || at_end) {
      tell_spatial(c, jet, at_.told.moment(vertex), 1);
      tell_curvature(c, jet, at_.told.curvature(vertex));
    }
    const auto& on = at_.layout.attached(c.rod);
    const auto a = std::ranges::find(on, c.vertex, &Attachment<Space>::vertex);
    tell_spatial(c, jet, at_.told.reaction_moment(a->node), c.kind == CellKind::before ? 1 : -1);
  }

  /// The mean of a cell. Of one that a held frame cuts, what the moment there makes of the half
  /// behind, theory (21).
  void tell_curvature(const CellOfNetwork<Space>& c, const TurnJet<Space>& jet, int to) {
    const auto& grid = at_.net.rods[c.rod].grid;
    const bool inside = c.vertex > 0 && c.vertex < grid.edges();
    Spin<Space> K = c.u / c.length;
    if (c.driven && c.kind != CellKind::whole) {
      unknown_.push_back(to);  // it is told by what tendons leave of the moment, theory (37)
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
      if (e >= 0) of_numbers_.add(to, at_.numbers.length(e), Spin<Space>(-K / (2 * c.length)));
  }

  void tell_rod(int rod) {
    const auto& r = at_.net.rods[rod];
    const auto& on = at_.layout.attached(rod);
    for (int i = 0; i < int(on.size()); ++i) {
      if (!on[i].rigid) continue;
      const int vertex = at_.told.vertex(rod, on[i].vertex),
                held = at_.state.held(at_.attached.of(rod, i));
      of_state_.add(at_.told.vertex_turn(vertex), held, 1);
      of_state_.add(at_.told.rotation(vertex), held, spin_matrix<Space>(held_frame(at_.x, on[i])));
    }
    const auto ends_in = [&](const auto& a) { return a.rigid; };
    if (!r.grid.closed() && !ends_in(on.front())) tell_end(rod, true);
    if (!r.grid.closed() && !ends_in(on.back())) tell_end(rod, false);
    for (const auto& jump : r.jumps)
      forget(rod, jump.vertex, at_.told.vertex_turn(0), at_.told.curvature(0));
    for (const auto& c : at_.net.loads[rod].vertex_moments) {
      if (c.on_node) continue;
      forget(rod, c.vertex, at_.told.vertex_turn(0), at_.told.curvature(0));
      unknown_.push_back(at_.told.moment(at_.told.vertex(rod, c.vertex)));
      unknown_.push_back(at_.told.energy());
    }
  }

  void forget(int rod, int vertex, int turns, int curvatures) {
    const int number = at_.told.vertex(rod, vertex);
    unknown_.push_back(turns + number), unknown_.push_back(curvatures + number);
  }

  void tell_end(int rod, bool start) {
    const auto& r = at_.net.rods[rod];
    const int n = r.edges(), e = at_.layout.edge(rod, start ? 0 : n - 1);
    const auto& q = at_.x.frames[e];
    const FreeEnd<Space> end(r, at_.net.loads[rod], terms_, rod, start, q);
    const Side side = start ? Side::before : Side::behind;
    const int vertex = at_.told.vertex(rod, start ? 0 : n), turn = at_.told.vertex_turn(vertex),
              K = at_.told.curvature(vertex);
    const double sign = start ? -1 : 1;
    of_state_.add(turn, at_.state.turn(e), end.of_edge);
    tell_end_turn(rod, side, end, e, turn, end.of_turn);
    const Block R = spin_matrix<Space>(q * exp(end.w));
    of_state_.add(at_.told.rotation(vertex), at_.state.turn(e), Block(R * end.of_edge));
    tell_end_turn(rod, side, end, e, at_.told.rotation(vertex), Block(R * end.of_turn));
    tell_end_turn(rod, side, end, e, K, Block(sign / end.length * Block::Identity()));
    of_numbers_.add(K, at_.numbers.length(e),
                    Spin<Space>(-sign * end.w / (end.length * end.length) / 2));
    tell_end_turn(rod, side, end, e, at_.told.energy(), Row(end.m.transpose()));
    for (const auto& [i, slope] : end.tendons)
      tell_end_turn(rod, side, end, e, at_.told.tendon_length(i), Row(slope.transpose()));
    if (!end.tendons.empty()) unknown_.push_back(K);
    const Spin<Space> strain = end.w - end.rest;
    of_numbers_.add(at_.told.energy(), at_.numbers.end_stiffness(rod, side),
                    Row(strain.cwiseAbs2().transpose() / 2));
    of_numbers_.add(at_.told.energy(), at_.numbers.end_rest(rod, side),
                    Row(-sign * end.m.transpose()));
    const int moment = at_.told.moment(vertex);
    if (!end.follows) {
      of_numbers_.add(moment, at_.numbers.end_moment(rod, side), sign);
      return;
    }
    const Block by_turn = -R * spin_skew(end.M);
    of_numbers_.add(moment, at_.numbers.end_following(rod), R);
    of_state_.add(moment, at_.state.turn(e), Block(by_turn * end.of_edge));
    tell_end_turn(rod, side, end, e, moment, Block(by_turn * end.of_turn));
  }

  /// Adds A δw to an item.
  template <class A>
  void tell_end_turn(int rod, Side side, const FreeEnd<Space>& end, int e, int to, const A& of) {
    using Out = Eigen::Matrix<double, A::RowsAtCompileTime, spin>;
    const double sign = end.start ? -1 : 1;
    of_numbers_.add(to, at_.numbers.end_stiffness(rod, side), Out(of * end.by_k));
    of_numbers_.add(to, at_.numbers.end_rest(rod, side), Out(sign * of * end.by_rest));
    for (const auto& [i, slope] : end.tendons) add_tension(to, i, -of * end.by_total * slope);
    if (end.follows) {
      of_numbers_.add(to, at_.numbers.end_following(rod), Out(of * end.by_moment));
      return;
    }
    const Block back = spin_matrix<Space>(at_.x.frames[e].conjugate());
    of_numbers_.add(to, at_.numbers.end_moment(rod, side), Out(of * end.by_moment * back));
    of_state_.add(to, at_.state.turn(e), Out(of * end.by_moment * spin_skew(end.M)));
  }

  /// What is missing to the balance there.
  void tell_node(int v) {
    const int force = at_.told.reaction_force(v), moment = at_.told.reaction_moment(v);
    of_state_.add(force, at_.state.load(v), -1);
    for (const auto& [p, end] : at_.layout.spans_at(v))
      of_state_.add(force,
                    at_.state.force(end ? at_.layout.last_edge(p) : at_.layout.first_edge(p)),
                    end ? 1 : -1);
    const Block R = spin_matrix<Space>(at_.x.node_frames[v]);
    const Spin<Space>& follows = at_.loads.node_follower_moments()[v];
    of_numbers_.add(moment, at_.numbers.node_moment(v), -1);
    of_numbers_.add(moment, at_.numbers.node_following(v), Block(-R));
    of_state_.add(moment, at_.state.node_turn(v), Block(R * spin_skew(follows)));
  }

  const AtState<Space>& at_;
  CellTerms<Space> terms_;
  std::vector<int> unknown_;
  ItemMap<Space> of_state_, of_numbers_;
};

}  // namespace pyrod
