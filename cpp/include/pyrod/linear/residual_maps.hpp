// SPDX-License-Identifier: BSD-3-Clause
/// \file How the residual of a network changes with its numbers, and with that part of its state
/// which they move: held frames, places, section forces.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/edge_maps.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
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

  /// `sections`: section forces on all edges.
  ResidualMaps(const Layout<Space>& layout, const NetworkLoads<Space>& loads,
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
        attached_(layout) {
    const Cells<Space> cells(layout, x);
    cells.for_each([&](const auto& cell) { add(cell), add_tensions(cell, cells.terms()); });
    for (int p = 0; p < int(layout.spans().size()); ++p) add_span(p);
    for (int v = 0; v < int(net_.nodes.size()); ++v) add_place(v), add_turn(v), move_node(v);
    for (int i = 0; i < int(net_.tendons.size()); ++i)
      if (layout.tendon_block(i) >= 0) add_length(i, cells.terms().tension(i));
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const auto& on = layout.attached(rod);
      for (int i = 0; i < int(on.size()); ++i) add_attachment(on[i], attached_.of(rod, i));
    }
    for (const auto& [e, m] : loads.edge_moments())
      skew_.add(state_.turn(e), state_.turn(e),
                half_skew(-rotate_spin(x.frames[e].conjugate(), m)));
    for (const auto& [e, m] : loads.follower_moments())
      skew_.add(state_.turn(e), state_.turn(e), half_skew(m));
  }

  /// Residual ← the state's held frames, places, section forces, loads of nodes.
  const ItemMap<Space>& of_state() const { return of_state_; }
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
      if (layout_.tendon_block(i) < 0) {
        of_numbers_.add(c.a, numbers_.tendon(i), of_a);
        of_numbers_.add(c.b, numbers_.tendon(i), of_b);
      } else if (!TendonRows<Space>::is_slack(x_, i)) {  // held frames move it as well
        if (c.edge_a < 0) of_state_.add(state_.tendon(i), c.a, Row(of_a.transpose()));
        if (c.edge_b < 0) of_state_.add(state_.tendon(i), c.b, Row(of_b.transpose()));
      }
    });
  }

  /// The gap of a tendon, ℓ less its length under tension. Of one that is slack there is none.
  void add_length(int i, double tension) {
    if (TendonRows<Space>::is_slack(x_, i)) return;
    of_numbers_.add(state_.tendon(i), numbers_.tendon(i),
                    Mat<1>(-(1 + net_.tendons[i].softness * tension)));
  }

  /// The moment g on a held frame, first moved by ψ and then looked at: H ψ + ½ g × ψ. If the frame
  /// turns against the node, its components there change as well.
  void add_held(int held, int attachment, const Mat<spin>& H, const Spin<Space>& g) {
    of_state_.add(held, held, Mat<spin>(H + half_skew(g)));
    of_numbers_.add(held, numbers_.relative(attachment), Mat<spin>(-spin_skew(g)));
  }

  void add_span(int p) {
    const auto& span = layout_.spans()[p];
    const int gap = span.block >= 0 ? state_.gap(p) : -1;
    for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e) {
      const EdgeMaps<Space> edge(x_.frames[e], sections_[e], columns_.compliance[e],
                                 columns_.lengths[e][0]);
      const int turn = state_.turn(e);
      of_state_.add(turn, state_.force(e), edge.moment_of_force());
      of_numbers_.add(turn, numbers_.compliance(e), edge.moment_of_compliance());
      of_numbers_.add(turn, numbers_.length(e), edge.moment_of_length());
      of_numbers_.add(turn, numbers_.moment(e), -spin_matrix<Space>(x_.frames[e].conjugate()));
      of_numbers_.add(turn, numbers_.following(e), -Mat<spin>::Identity());
      if (gap < 0) continue;
      of_state_.add(gap, state_.force(e), -edge.reach_of_force());
      of_numbers_.add(gap, numbers_.compliance(e), -edge.reach_of_compliance());
      of_numbers_.add(gap, numbers_.length(e), -edge.reach_of_length());
    }
    of_state_.add(gap, state_.place(span.end), 1);
    of_state_.add(gap, state_.place(span.start), -1);
    for (const auto& [v, e, sign] : {std::tuple(span.end, layout_.last_edge(p), 1.),
                                     std::tuple(span.start, layout_.first_edge(p), -1.)})
      if (layout_.place_block(v) >= 0) of_state_.add(state_.place(v), state_.force(e), sign);
  }

  void add_place(int v) {
    if (layout_.place_block(v) < 0) return;
    const auto& node = net_.nodes[v];
    const int place = state_.place(v);
    of_state_.add(place, state_.load(v), -1);
    if (node.spring == 0) return;
    of_state_.add(place, place, node.spring);
    of_numbers_.add(place, numbers_.position(v), -node.spring);
    of_numbers_.add(place, numbers_.spring(v), Point<Space>(x_.positions[v] - node.position));
  }

  void add_turn(int v) {
    if (layout_.turn_block(v) < 0) return;
    const auto& node = net_.nodes[v];
    const int turn = state_.node_turn(v);
    const auto q = x_.node_frames[v].conjugate();
    const Spin<Space> dead = rotate_spin(q, loads_.node_moments()[v]),
                      follows = loads_.node_follower_moments()[v];
    of_numbers_.add(turn, numbers_.node_moment(v), -spin_matrix<Space>(q));
    of_numbers_.add(turn, numbers_.node_following(v), -Mat<spin>::Identity());
    of_state_.add(turn, turn, Mat<spin>(-spin_skew(dead)));
    skew_.add(turn, turn, half_skew(follows - dead));
    if (node.torsion_spring > 0 && node.turns.cols() == spin) add_torsion(v);
  }

  void add_torsion(int v) {
    const auto& node = net_.nodes[v];
    const Spin<Space> u = log(principal(node.frame.conjugate() * x_.node_frames[v]));
    const Spin<Space> C = Spin<Space>::Constant(node.torsion_spring), none = Spin<Space>::Zero();
    const auto jet = bend_twist<Hessian::exact>(u, typename Space::Differential(u), C, none);
    of_numbers_.add(state_.node_turn(v), numbers_.frame(v), jet.ab.transpose());
    of_numbers_.add(state_.node_turn(v), numbers_.torsion(v),
                    Spin<Space>(jet.b / node.torsion_spring));
  }

  /// A support takes its node along, but where that is free: there the spring is drawn.
  void move_node(int v) {
    const auto& node = net_.nodes[v];
    const double unit = layout_.unit_length(v);
    const Mat<dim> F = padded(node.free) / unit;
    if (node.free.cols() < dim)
      moves_.add(state_.place(v), numbers_.position(v),
                 Mat<dim>(Mat<dim>::Identity() - F * F.transpose()));
    if (node.turns.cols() < spin)
      moves_.add(state_.node_turn(v), numbers_.frame(v),
                 spin_matrix<Space>(x_.node_frames[v].conjugate() * node.frame));
  }

  void add_attachment(const Attachment<Space>& a, int number) {
    if (!a.rigid) return;
    const Rotation back = held_frame(x_, a).conjugate() * x_.node_frames[a.node];
    holds_.add(state_.held(number), state_.node_turn(a.node), spin_matrix<Space>(back));
    if (a.hinge)
      holds_.add(state_.held(number), state_.hinge(a.hinge_number),
                 rotate_spin(a.relative.conjugate(), *a.hinge));
    moves_.add(state_.held(number), numbers_.relative(number), 1);
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkLoads<Space>& loads_;
  const EdgeColumns<Space>& columns_;
  const NetworkState<Space>& x_;
  const std::vector<Point<Space>>& sections_;
  StateItems<Space> state_;
  NumberItems<Space> numbers_;
  AttachmentNumbers<Space> attached_;
  ItemMap<Space> of_state_, of_numbers_, moves_, holds_, skew_;
};

}  // namespace pyrod
