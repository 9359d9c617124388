// SPDX-License-Identifier: BSD-3-Clause
/// \file The cells of the vertices of a network, Linn (49): between two edges, or between an edge
/// and the node or hinge that holds it.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/network_rows.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

template <class Space>
class NetworkCells {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;
  using Storage = Linearisation<BlockSymmetric>;
  static constexpr int spin = Space::spin;

  explicit NetworkCells(const Layout<Space>& layout) : layout_(layout), net_(layout.network()) {}

  /// The cells at an attached vertex: one from edge to edge, or two halves that meet in the node.
  /// The half behind a clamp is in the rows of its span.
  template <Hessian kind>
  void add(const State& x, const Attachment<Space>& a, Storage& out) const {
    const auto& rod = net_.rods[a.rod];
    const int n = rod.edges();
    const bool closed = rod.grid.closed();
    const int before = a.vertex > 0 ? a.vertex - 1 : closed ? n - 1 : -1;
    const int behind = a.vertex < n ? a.vertex : -1;
    if (a.rigid) {
      if (before >= 0) add_half<kind>(x, a, before, true, out);
      if (behind >= 0 && !layout_.clamps(a)) add_half<kind>(x, a, behind, false, out);
    } else if (before >= 0 && behind >= 0) {
      add_turn<kind>(x, layout_.edge(a.rod, before), layout_.edge(a.rod, behind), rod, a.vertex,
                     rod.grid.Δs(a.vertex), out);
    }
  }

  /// What a cell between two edges adds.
  void put_turn(const TurnJet<Space>& jet, int before, int behind, Storage& out) const {
    const int a = layout_.frame_block(before), b = layout_.frame_block(behind);
    add_energy(jet.energy, out);
    out.gradient.template segment<spin>(layout_.row(a)) += jet.a;
    out.gradient.template segment<spin>(layout_.row(b)) += jet.b;
    out.hessian.add_diagonal(a, jet.aa);
    out.hessian.add_diagonal(b, jet.bb);
    if (a < b)
      out.hessian.add(a, b, jet.ab);
    else if (b < a)
      out.hessian.add(b, a, transposed(jet.ab));
    else
      out.hessian.add_diagonal(a, Mat<spin>(jet.ab + transposed(jet.ab)));
  }

  /// What half a cell adds, that lies before the vertex or behind it.
  template <Hessian kind>
  void put_half(const TurnJet<Space>& jet, const State& x, const Attachment<Space>& a, int e,
                bool before, Storage& out) const {
    const int q = layout_.frame_block(e), v = layout_.turn_block(a.node);
    add_energy(jet.energy, out);
    out.gradient.template segment<spin>(layout_.row(q)) += before ? jet.a : jet.b;
    out.hessian.add_diagonal(q, before ? jet.aa : jet.bb);
    const Spin<Space>& g = before ? jet.b : jet.a;
    const Mat<spin>& H = before ? jet.bb : jet.aa;
    const Mat<spin> mixed = before ? jet.ab : transposed(jet.ab);  // edge × node
    const Mat<spin> turns =
        own_turns<Space>(net_, x, a);  // of the held frame, per unknown of the node
    if (a.hinge) add_hinge<kind>(a, g, H, mixed, turns, q, v, out);
    if (v < 0) return;
    add_to_rows(layout_, v, Spin<Space>(turns.transpose() * g), out);
    out.hessian.add_diagonal(v, Mat<spin>(turns.transpose() * H * turns));
    out.hessian.add(q, v, Mat<spin>(mixed * turns));
  }

 private:
  /// Number by number: g++ takes what Eigen makes of it for uninitialised.
  static Mat<spin> transposed(const Mat<spin>& m) {
    Mat<spin> out;
    for (int k = 0; k < spin; ++k)
      for (int i = 0; i < spin; ++i) out(i, k) = m(k, i);
    return out;
  }

  /// The cell of vertex j between two edges.
  template <Hessian kind>
  void add_turn(const State& x, int before, int behind, const Rod<Space>& rod, int j, double Δs,
                Storage& out) const {
    Rotation W = x.frames[before].conjugate() * x.frames[behind];
    if (behind < before) W = principal(W);  // the frames of a closed rod need not close their signs
    const Spin<Space> u = log(W);
    put_turn(bend_twist<kind>(u, typename Space::Differential(u), rod.bending[j], rod.K0[j], Δs),
             before, behind, out);
  }

  /// Half a cell between an edge and the node it is fixed to. It turns by less than π.
  template <Hessian kind>
  void add_half(const State& x, const Attachment<Space>& a, int j, bool before,
                Storage& out) const {
    const auto& rod = net_.rods[a.rod];
    const int e = layout_.edge(a.rod, j);
    const Rotation held = held_frame(x, a);
    const Spin<Space> u =
        log(principal(before ? x.frames[e].conjugate() * held : held.conjugate() * x.frames[e]));
    const auto sides = rod.sides(a.vertex);
    const auto jet = bend_twist<kind>(
        u, typename Space::Differential(u), before ? sides.bending_before : sides.bending_behind,
        before ? sides.K0_before : sides.K0_behind, rod.grid.h(j) / 2);
    put_half<kind>(jet, x, a, e, before, out);
  }

  /// The held frame F moves as F ← F exp(α) exp(β) with α from the node and β = δ b from the hinge,
  /// whose logarithm is α + β + ½ α × β: the product couples the two by what the cell exerts.
  template <Hessian kind>
  void add_hinge(const Attachment<Space>& a, const Spin<Space>& g, const Mat<spin>& H,
                 const Mat<spin>& mixed, const Mat<spin>& turns, int q, int v, Storage& out) const {
    const int w = layout_.hinge_block(a.hinge_number);
    const Spin<Space> b = rotate_spin(a.relative.conjugate(), *a.hinge), Hb = H * b;
    out.gradient[layout_.row(w)] += b.dot(g);
    out.hessian.add_diagonal(w, Mat<1>(b.dot(Hb)));
    out.hessian.add(q, w, Spin<Space>(mixed * b));
    if (v < 0) return;
    Spin<Space> coupling = Hb;
    if constexpr (kind == Hessian::exact) coupling += spin_skew(b) * g / 2;
    out.hessian.add(w, v, Eigen::Matrix<double, 1, spin>(coupling.transpose() * turns));
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
};

}  // namespace pyrod
