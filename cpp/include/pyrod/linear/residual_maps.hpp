// SPDX-License-Identifier: BSD-3-Clause
/// \file How the residual of a network changes at its nodes with its numbers, and with that part of
/// its state which they move: held frames, places. Edges and what is between them: see `Chains`.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/network_rows.hpp>
#include <pyrod/statics/equations/tendon_rows.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <vector>

namespace pyrod {

/// The rotation of turns by q as a matrix.
template <class Space>
Mat<Space::spin> spin_matrix(const typename Space::Rotation& q) {
  Mat<Space::spin> out;
  for (int i = 0; i < Space::spin; ++i)
    out.col(i) = rotate_spin(q, Spin<Space>(Spin<Space>::Unit(i)));
  return out;
}

template <class Space>
class ResidualMaps {
 public:
  using Rotation = typename Space::Rotation;
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `at` must stay where it is.
  explicit ResidualMaps(const AtState<Space>& at) : at_(at) {
    const Cells<Space> cells(at.layout, at.x);
    const auto tensions = [&](const auto& cell) { add_tensions(cell, cells.terms()); };
    cells.for_each_half([&](const auto& cell) { add(cell), tensions(cell); });
    cells.for_each_driven(tensions);
    for (int p = 0; p < int(at.layout.spans().size()); ++p) add_span(p);
    for (int v = 0; v < int(at.net.nodes.size()); ++v) add_place(v), add_turn(v), move_node(v);
    for (int i = 0; i < int(at.net.tendons.size()); ++i)
      if (at.layout.tendon_block(i) >= 0) add_length(i, cells.terms().tension(i));
    for (int rod = 0; rod < int(at.net.rods.size()); ++rod) {
      const auto& on = at.layout.attached(rod);
      for (int i = 0; i < int(on.size()); ++i) add_attachment(on[i], at.attached.of(rod, i));
    }
    for (const auto& [e, m] : at.loads.edge_moments())
      skew_.add(at.state.turn(e), at.state.turn(e),
                half_skew(-rotate_spin(at.x.frames[e].conjugate(), m)));
    for (const auto& [e, m] : at.loads.follower_moments())
      skew_.add(at.state.turn(e), at.state.turn(e), half_skew(m));
  }

  /// Residual ← the state's held frames, places and loads at nodes.
  const ItemMap<Space>& of_state() const { return of_state_; }
  /// Residual ← the state's section forces, at nodes.
  const ItemMap<Space>& balance() const { return balance_; }
  /// Residual ← numbers, the state staying as it is.
  const ItemMap<Space>& of_numbers() const { return of_numbers_; }
  /// State ← numbers: what supports move by themselves.
  const ItemMap<Space>& moves() const { return moves_; }
  /// Held frames ← nodes and hinges; the transpose brings moments from the ones to the others.
  const ItemMap<Space>& holds() const { return holds_; }
  /// Residual ← turns: what dead and following moments add to the tangent, theory (11).
  const ItemMap<Space>& skew() const { return skew_; }

 private:
  using Row = Eigen::Matrix<double, 1, spin>;

  static Mat<spin> half_skew(const Spin<Space>& m) { return spin_skew(m) / 2; }

  /// ∓T δm with theory (30), and what held frames exert on each other.
  void add(const CellOfNetwork<Space>& c) {
    const auto jet = c.whole();
    const Mat<spin> T = c.T(), by_k = T * c.strain().asDiagonal(), by_rest = T * c.k.asDiagonal(),
                    Tt = T.transpose(), b_by_k = Tt * c.strain().asDiagonal(),
                    b_by_rest = Tt * c.k.asDiagonal();
    of_numbers_.add(c.a, c.stiffness, -by_k), of_numbers_.add(c.a, c.rest, by_rest);
    of_numbers_.add(c.b, c.stiffness, b_by_k), of_numbers_.add(c.b, c.rest, -b_by_rest);
    if (c.edge_a < 0) {
      of_state_.add(c.b, c.a, jet.ab.transpose());
      add_held(c.a, c.attachment, jet.aa, jet.a);
    }
    if (c.edge_b < 0) {
      of_state_.add(c.a, c.b, jet.ab);
      add_held(c.b, c.attachment, jet.bb, jet.b);
    }
  }

  void add_tensions(const CellOfNetwork<Space>& c, const CellTerms<Space>& terms) {
    terms.for_each_tendon(c.rod, c.vertex, c.kind, c.u, [&](int i, double, const auto& length) {
      const Mat<spin> T = c.T();
      const Spin<Space> of_a = -T * length.slope, of_b = T.transpose() * length.slope;
      if (at_.layout.tendon_block(i) < 0) {
        of_numbers_.add(c.a, at_.numbers.tendon(i), of_a);
        of_numbers_.add(c.b, at_.numbers.tendon(i), of_b);
      } else if (!TendonRows<Space>::is_slack(at_.x, i)) {  // held frames move it as well
        if (c.edge_a < 0) of_state_.add(at_.state.tendon(i), c.a, Row(of_a.transpose()));
        if (c.edge_b < 0) of_state_.add(at_.state.tendon(i), c.b, Row(of_b.transpose()));
      }
    });
  }

  /// The gap of a tendon, ℓ less its length under tension. Of one that is slack there is none.
  void add_length(int i, double tension) {
    if (TendonRows<Space>::is_slack(at_.x, i)) return;
    of_numbers_.add(at_.state.tendon(i), at_.numbers.tendon(i),
                    Mat<1>(-(1 + at_.net.tendons[i].softness * tension)));
  }

  /// The moment g on a held frame, first moved by ψ and then looked at: H ψ + ½ g × ψ. If the frame
  /// turns against the node, its components there change as well.
  void add_held(int held, int attachment, const Mat<spin>& H, const Spin<Space>& g) {
    of_state_.add(held, held, Mat<spin>(H + half_skew(g)));
    of_numbers_.add(held, at_.numbers.relative(attachment), Mat<spin>(-spin_skew(g)));
  }

  void add_span(int p) {
    const auto& span = at_.layout.spans()[p];
    const int gap = span.block >= 0 ? at_.state.gap(p) : -1;
    of_state_.add(gap, at_.state.place(span.end), 1);
    of_state_.add(gap, at_.state.place(span.start), -1);
    for (const auto& [v, e, sign] : {std::tuple(span.end, at_.layout.last_edge(p), 1.),
                                     std::tuple(span.start, at_.layout.first_edge(p), -1.)})
      if (at_.layout.place_block(v) >= 0)
        balance_.add(at_.state.place(v), at_.state.force(e), sign);
  }

  void add_place(int v) {
    if (at_.layout.place_block(v) < 0) return;
    const auto& node = at_.net.nodes[v];
    const int place = at_.state.place(v);
    of_state_.add(place, at_.state.load(v), -1);
    if (node.spring == 0) return;
    of_state_.add(place, place, node.spring);
    of_numbers_.add(place, at_.numbers.position(v), -node.spring);
    of_numbers_.add(place, at_.numbers.spring(v), Point<Space>(at_.x.positions[v] - node.position));
  }

  void add_turn(int v) {
    if (at_.layout.turn_block(v) < 0) return;
    const auto& node = at_.net.nodes[v];
    const int turn = at_.state.node_turn(v);
    const auto q = at_.x.node_frames[v].conjugate();
    const Spin<Space> dead = rotate_spin(q, at_.loads.node_moments()[v]),
                      follows = at_.loads.node_follower_moments()[v];
    of_numbers_.add(turn, at_.numbers.node_moment(v), -spin_matrix<Space>(q));
    of_numbers_.add(turn, at_.numbers.node_following(v), -Mat<spin>::Identity());
    of_state_.add(turn, turn, Mat<spin>(-spin_skew(dead)));
    skew_.add(turn, turn, half_skew(follows - dead));
    if (node.torsion_spring > 0 && node.turns.cols() == spin) add_torsion(v);
  }

  void add_torsion(int v) {
    const auto& node = at_.net.nodes[v];
    const Spin<Space> u = log(principal(node.frame.conjugate() * at_.x.node_frames[v]));
    const Spin<Space> C = Spin<Space>::Constant(node.torsion_spring), none = Spin<Space>::Zero();
    const auto jet = bend_twist<Hessian::exact>(u, typename Space::Differential(u), C, none);
    of_numbers_.add(at_.state.node_turn(v), at_.numbers.frame(v), jet.ab.transpose());
    of_numbers_.add(at_.state.node_turn(v), at_.numbers.torsion(v),
                    Spin<Space>(jet.b / node.torsion_spring));
  }

  /// A support takes its node along, but where that is free: there the spring is drawn.
  void move_node(int v) {
    const auto& node = at_.net.nodes[v];
    const double unit = at_.layout.unit_length(v);
    const Mat<dim> F = padded(node.free) / unit;
    if (node.free.cols() < dim)
      moves_.add(at_.state.place(v), at_.numbers.position(v),
                 Mat<dim>(Mat<dim>::Identity() - F * F.transpose()));
    if (node.turns.cols() < spin)
      moves_.add(at_.state.node_turn(v), at_.numbers.frame(v),
                 spin_matrix<Space>(at_.x.node_frames[v].conjugate() * node.frame));
  }

  void add_attachment(const Attachment<Space>& a, int number) {
    if (!a.rigid) return;
    const Rotation back = held_frame(at_.x, a).conjugate() * at_.x.node_frames[a.node];
    holds_.add(at_.state.held(number), at_.state.node_turn(a.node), spin_matrix<Space>(back));
    if (a.hinge)
      holds_.add(at_.state.held(number), at_.state.hinge(a.hinge_number),
                 rotate_spin(a.relative.conjugate(), *a.hinge));
    moves_.add(at_.state.held(number), at_.numbers.relative(number), 1);
  }

  const AtState<Space>& at_;
  ItemMap<Space> of_state_, balance_, of_numbers_, moves_, holds_, skew_;
};

}  // namespace pyrod
