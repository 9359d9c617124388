// SPDX-License-Identifier: BSD-3-Clause
/// \file Tendons of given length: the rows of their tensions, which hold their lengths.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/end_turn.hpp>
#include <pyrod/statics/equations/network_rows.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <Eigen/LU>

#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

/// L has the terms T (ℓ − ℓ⁰) − ½ c T², theory (36). Of one that is slack there is −½ T² instead,
/// in its unit, and nothing else.
template <class Space>
class TendonRows {
 public:
  static constexpr int spin = Space::spin;
  using State = NetworkState<Space>;
  using Storage = Linearisation<BlockSymmetric>;

  /// `terms`: at the state.
  TendonRows(const Layout<Space>& layout, const CellTerms<Space>& terms, const State& x,
             Storage& out)
      : layout_(layout), net_(layout.network()), terms_(terms), x_(x), out_(out) {}

  /// Whether the row of a tendon is that of its length.
  bool holds(int tendon) const {
    return layout_.tendon_block(tendon) >= 0 && !is_slack(x_, tendon);
  }

  /// What the length of a tendon in a cell between two edges changes by.
  void put_turn(int tendon, const Spin<Space>& slope, const Mat<spin>& T, double length, int before,
                int behind) {
    put(tendon, layout_.frame_block(before), Spin<Space>(-T * slope));
    put(tendon, layout_.frame_block(behind), Spin<Space>(T.transpose() * slope));
    row(tendon) += layout_.unit_tension(tendon) * length;
  }

  /// The same of half a cell that an attachment holds; e: the edge.
  void put_half(int tendon, const Spin<Space>& slope, const Mat<spin>& T, double length,
                const Attachment<Space>& a, int e, bool before) {
    const Spin<Space> of_a = -T * slope, of_b = T.transpose() * slope;
    put(tendon, layout_.frame_block(e), before ? of_a : of_b);
    const Spin<Space>& held = before ? of_b : of_a;
    if (a.hinge)
      put(tendon, layout_.hinge_block(a.hinge_number),
          Vec1(rotate_spin(a.relative.conjugate(), *a.hinge).dot(held)));
    if (const int v = layout_.turn_block(a.node); v >= 0)
      put(tendon, v, Spin<Space>(own_turns<Space>(net_, x_, a).transpose() * held));
    row(tendon) += layout_.unit_tension(tendon) * length;
  }

  /// What is left: lengths at rest, stretch, and half cells at ends that turn freely.
  void finish() {
    for (int i = 0; i < int(net_.tendons.size()); ++i) {
      const int b = layout_.tendon_block(i);
      if (b < 0) continue;
      const auto& tendon = net_.tendons[i];
      const double unit = layout_.unit_tension(i), T = terms_.tension(i);
      if (!holds(i)) {
        const double stiffness = layout_.rod_moment(tendon.rod);
        row(i) = -stiffness * T / unit;
        out_.hessian.add_diagonal(b, Mat<1>(-stiffness));
        continue;
      }
      row(i) -= unit * tendon.length_under(T);
      out_.hessian.add_diagonal(b, Mat<1>(-unit * unit * *tendon.length * tendon.softness));
      add_energy(-T * tendon.length_under(T / 2), out_);
    }
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      if (terms_.none(rod)) continue;
      if (!layout_.attached(rod).front().rigid) put_end(rod, End::start);
      if (!layout_.attached(rod).back().rigid) put_end(rod, End::end);
    }
  }

  static bool is_slack(const State& x, int tendon) {
    return !x.slack.empty() && x.slack[std::size_t(tendon)];
  }

 private:
  double& row(int tendon) { return out_.gradient[layout_.row(layout_.tendon_block(tendon))]; }

  template <int N>
  void put(int tendon, int with, const Vec<N>& change) {
    const int b = layout_.tendon_block(tendon);
    const Vec<N> scaled = layout_.unit_tension(tendon) * change;
    if (with < b)
      out_.hessian.add(with, b, scaled);
    else
      out_.hessian.add(b, with, scaled.transpose());
  }

  /// The half cell is in equilibrium by itself, under no moment, and its turn changes with the
  /// tensions alone.
  void put_end(int rod, End end) {
    const auto& r = net_.rods[rod];
    const int j = end == End::start ? 0 : r.edges();
    const CellKind kind = end == End::start ? CellKind::behind : CellKind::before;
    if (terms_.none(rod, j, kind)) return;
    const Spin<Space> none = Spin<Space>::Zero(),
                      w = turn_of_end<Space>(terms_, r, rod, end, none, false),
                      u = end == End::start ? Spin<Space>(-w) : w;
    const auto ψ = terms_.whole(rod, j, kind, u);
    const Mat<spin> give = ψ.k.inverse();
    std::vector<std::pair<int, Spin<Space>>> seen;
    terms_.for_each_tendon(rod, j, kind, u, [&](int i, double, const auto& length) {
      if (!holds(i)) return;
      if (seen.empty()) add_energy(ψ.energy, out_);
      const double unit = layout_.unit_tension(i);
      row(i) += unit * length.length;
      seen.emplace_back(i, unit * length.slope);
      for (const auto& [k, slope] : seen) {
        const Mat<1> value(-slope.dot(give * seen.back().second));
        const int a = layout_.tendon_block(k), b = layout_.tendon_block(i);
        k == i ? out_.hessian.add_diagonal(b, value) : out_.hessian.add(a, b, value);
      }
    });
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const CellTerms<Space>& terms_;
  const State& x_;
  Storage& out_;
};

}  // namespace pyrod
