// SPDX-License-Identifier: BSD-3-Clause
/// \file The rows of the spans of a network: turning inside a span, the section force in it, and
/// how far it reaches.
///
/// They are written, not added to, as they are nearly all of the matrix; so they come first.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/sparse/chain_columns.hpp>
#include <pyrod/statics/equations/chain.hpp>
#include <pyrod/statics/equations/chain_reach.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_rows.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <array>

namespace pyrod {

template <class Space>
class NetworkSpans {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;
  using Storage = Linearisation<BlockSymmetric>;
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `known`: what the loads tell of the section forces.
  NetworkSpans(const Layout<Space>& layout, const EdgeColumns<Space>& columns,
               const Columns<dim>& known)
      : layout_(layout), columns_(columns), known_(known) {}

  /// Writes the rows of span p.
  template <Hessian kind>
  void set(const State& x, int p, Storage& out) const {
    const auto& span = layout_.spans()[p];
    const int apart = layout_.apart(p), first = layout_.first_edge(p), e = first + apart;
    const Rotation* frames = x.frames.data() + e;
    const Rotation before = apart ? x.frames[first] : frame_before(x, span, frames[0]);
    const Chain<Space> chain{
        span.last - span.first - apart, e, columns_, known_, x.forces[p], before, frames};
    const auto rows = set_rows<kind>(chain, out);
    if (apart) set_first<kind>(x, p, rows, out);
    if (span.block >= 0) set_force(x, chain, p, out);
  }

 private:
  template <Hessian kind>
  ChainRows<Space> set_rows(const Chain<Space>& chain, Storage& out) const {
    const int row = layout_.frame_row(chain.first), last = row + spin * (chain.edges - 1);
    for (const int r : {row, last}) out.hessian.set_zero(r, r + spin);
    ChainRows<Space> rows{out.gradient.data() + row,
                          out.hessian.template chain<spin>(row, chain.edges)};
    dispatch(ChainLinearisation<Space, kind>(chain, rows));
    out.energy += rows.energy;
    out.magnitude += rows.magnitude;
    return rows;
  }

  /// The first edge of a span, if it stands by itself. No clamp is before it.
  Chain<Space> first_alone(const State& x, int p) const {
    const Rotation* frame = x.frames.data() + layout_.first_edge(p);
    return {1, layout_.first_edge(p), columns_, known_, x.forces[p], *frame, frame};
  }

  /// Its rows. `behind`: of the rest of the span, whose first cell turns this frame as well.
  template <Hessian kind>
  void set_first(const State& x, int p, const ChainRows<Space>& behind, Storage& out) const {
    const int e = layout_.first_edge(p), block = layout_.frame_block(e);
    set_rows<kind>(first_alone(x, p), out);
    out.gradient.template segment<spin>(layout_.row(block)) += behind.start;
    out.hessian.add_diagonal(block, behind.start_twice);
    out.hessian.add(layout_.frame_block(e + 1), block, behind.start_first.transpose());
  }

  /// The frame that the start is clamped in, by the smaller turn; else what turns nothing.
  Rotation frame_before(const State& x, const Span<Space>& span, const Rotation& first) const {
    const auto* clamp = layout_.clamp_of(span);
    return clamp ? nearest(held_frame(x, *clamp), first) : first;
  }

  /// The rows of the force: the span reaches from node to node.
  void set_force(const State& x, const Chain<Space>& chain, int p, Storage& out) const {
    const auto& span = layout_.spans()[p];
    const int row = layout_.row(span.block), open = int(span.open.cols());
    const Mat<dim> C = padded(span.open);
    const BlockColumns to = out.hessian.columns(row);
    std::array<double*, dim> levers{};
    for (int k = 0; k < open; ++k) levers[k] = to[k];
    Reach<Space> reach;
    dispatch(ChainReach<Space>(chain, C, open, levers, reach));
    if (layout_.apart(p)) add_first(x, p, C, reach, out);
    const Point<Space> apart = x.positions[span.end] - x.positions[span.start];
    out.gradient.segment(row, open) =
        (C.transpose() * (apart - reach.rigid - reach.strained)).head(open);
    const Mat<dim> give = reach.give.template selfadjointView<Eigen::Upper>();
    for (int k = 0; k < open; ++k)
      for (int i = 0; i <= k; ++i) to[k][to.above + i] = -C.col(i).dot(give * C.col(k));
    out.energy += x.forces[p].dot(apart);
  }

  /// What the first edge, which stands by itself, adds to these rows.
  void add_first(const State& x, int p, const Mat<dim>& C, Reach<Space>& reach,
                 Storage& out) const {
    const auto& span = layout_.spans()[p];
    Mat<spin, dim> levers = Mat<spin, dim>::Zero();
    std::array<double*, dim> to;
    for (int k = 0; k < dim; ++k) to[k] = levers.col(k).data();
    Reach<Space> own;
    const Chain<Space> edge = first_alone(x, p);
    dispatch(ChainReach<Space>(edge, C, int(span.open.cols()), to, own));
    reach.rigid += own.rigid;
    reach.strained += own.strained;
    reach.give += own.give;
    out.hessian.add(span.block, layout_.frame_block(edge.first), levers.transpose());
  }

  const Layout<Space>& layout_;
  const EdgeColumns<Space>& columns_;
  const Columns<dim>& known_;
};

}  // namespace pyrod
