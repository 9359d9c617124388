// SPDX-License-Identifier: BSD-3-Clause
/// \file What is not symmetric in the tangent of a network: couples without a potential, and forces
/// that follow frames.
#pragma once

#include <pyrod/rod/model.hpp>
#include <pyrod/statics/edge_columns.hpp>
#include <pyrod/statics/network_loads.hpp>

namespace pyrod {

template <class Space>
class NetworkSkew : public NetworkLoads<Space> {
 public:
  using Base = NetworkLoads<Space>;
  using Base::dim, Base::spin;
  using typename Base::Rotation, typename Base::State;

  explicit NetworkSkew(const Layout<Space>& layout) : Base(layout), columns_(edge_columns(layout)) {
    first_.assign(1, 0);
    for (const int size : layout_.sizes()) first_.push_back(first_.back() + size);
  }

  /// w = (tangent − its symmetric part) v: couples that do not follow a potential, and the change
  /// of forces that follow frames.
  void multiply_skew(const State& x, const Vector& v, Vector& out) const {
    out.setZero(v.size());
    for (const auto& [edge, m] : edge_couples_)
      add_couple_skew(x.frames[edge], m, first_[layout_.frame_block(edge)], v, out);
    for (int node = 0; node < int(net_.nodes.size()); ++node)
      if (const int b = layout_.turn_block(node); b >= 0 && spin == 3) {
        const auto& T = net_.nodes[node].turns;
        const Spin<Space> φ = T * v.segment(first_[b], T.cols());
        const Spin<Space> m = rotate_spin(x.node_frames[node].conjugate(), node_moment_[node]) -
                              node_following_[node];
        out.segment(first_[b], T.cols()) += T.transpose() * (spin_skew(φ) * m / 2);
      }
    if (follows_) add_following_skew(x, v, out);
  }

  /// Of the unknowns that turn the frame of an edge.
  int first_row(int edge) const { return first_[layout_.frame_block(edge)]; }
  int first_row_of(int block) const { return first_[block]; }
  Point<Space> compliance(int edge) const { return columns_.compliance[edge]; }

 protected:
  using Base::forces, Base::tell;
  using Base::layout_, Base::net_, Base::dead_, Base::edge_couples_, Base::following_couples_;
  using Base::node_moment_, Base::node_following_, Base::part_, Base::follows_, Base::couples_;

  EdgeColumns<Space> columns_;
  std::vector<int> first_;  ///< row of every block

 private:
  /// −½ [Rᵀm]: with it the tangent is that of the residual in the coordinates exp(φ).
  void add_couple_skew(const Rotation& q, const Spin<Space>& m, int first, const Vector& v,
                       Vector& out) const {
    out.segment<spin>(first) +=
        spin_skew(Spin<Space>(v.segment<spin>(first))) * rotate_spin(q.conjugate(), m) / 2;
  }

  void add_following_skew(const State& x, const Vector& v, Vector& out) const {
    typename Base::Acting change;
    change.vertices = dead_.vertices;
    for (auto& rod : change.vertices) std::fill(rod.begin(), rod.end(), Point<Space>::Zero());
    const auto turn_of = [&](int e) {
      return Spin<Space>(v.segment<spin>(first_[layout_.frame_block(e)]));
    };
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      for (const auto& f : net_.loads[rod].following_forces) {
        const int e = layout_.edge(rod, f.edge);
        change.vertices[rod][f.vertex] -=
            part_ * rotate(x.frames[e], Point<Space>(skew(f.force) * turn_of(e)));
      }
    }
    for (const auto& [edge, m] : following_couples_)  // +½ [M]
      out.segment<spin>(first_[layout_.frame_block(edge)]) -= spin_skew(turn_of(edge)) * m / 2;
    tell(change, 0);
    const auto &dn = change.told, n = forces(x).sections;
    for (const auto& span : layout_.spans()) {
      Point<Space> reach = Point<Space>::Zero();
      for (int j = span.first; j < span.last; ++j) {
        const int e = layout_.edge(span.rod, j);
        const double h = net_.rods[span.rod].grid.h(j);
        const Point<Space> S = columns_.compliance[e], b = unrotate(x.frames[e], n[e]);
        const Point<Space> db = unrotate(x.frames[e], dn[e]), dΓ = S.cwiseProduct(db);
        out.segment<spin>(first_[layout_.frame_block(e)]) +=
            h * (cross(db, Point<Space>(axis<Space>() + S.cwiseProduct(b))) + cross(b, dΓ));
        reach += h * rotate(x.frames[e], dΓ);
      }
      if (span.block >= 0)
        out.segment(first_[span.block], span.open.cols()) -= span.open.transpose() * reach;
    }
    for (int node = 0; node < int(net_.nodes.size()); ++node)
      if (const int b = layout_.place_block(node); b >= 0) {
        Point<Space> balance = -change.nodes[node];
        for (const auto& [p, end] : layout_.spans_at(node)) {
          const auto& span = layout_.spans()[p];
          if (end)
            balance += dn[layout_.edge(span.rod, span.last - 1)];
          else
            balance -= dn[layout_.edge(span.rod, span.first)];
        }
        const auto& F = net_.nodes[node].free;
        out.segment(first_[b], F.cols()) += F.transpose() * balance;
      }
  }
};

}  // namespace pyrod
