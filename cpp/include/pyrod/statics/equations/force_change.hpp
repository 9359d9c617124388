// SPDX-License-Identifier: BSD-3-Clause
/// \file What a change of the forces does to the rows of a network, at fixed unknowns.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

template <class Space>
class ForceChange {
 public:
  using Acting = typename NetworkLoads<Space>::Acting;
  using State = NetworkState<Space>;
  static constexpr int spin = Space::spin;

  ForceChange(const Layout<Space>& layout, const EdgeColumns<Space>& columns)
      : layout_(layout), columns_(columns) {}

  /// Adds it; `now`: what acts at x, `change`: to first order, what more.
  void add(const State& x, const Acting& now, const Acting& change, Vector& out) const {
    for (int p = 0; p < int(layout_.spans().size()); ++p) add_span(x, now, change, p, out);
    for (int node = 0; node < int(x.positions.size()); ++node)
      if (layout_.place_block(node) >= 0) add_node(change, node, out);
  }

 private:
  void add_span(const State& x, const Acting& now, const Acting& change, int p, Vector& out) const {
    const auto& span = layout_.spans()[p];
    const auto& grid = layout_.network().rods[span.rod].grid;
    Point<Space> reach = Point<Space>::Zero();
    for (int j = span.first; j < span.last; ++j) {
      const int e = layout_.edge(span.rod, j);
      const double h = grid.h(j);
      const Point<Space> n =
          span.block < 0 ? now.known[e] : Point<Space>(now.known[e] + x.forces[p]);
      const Mat<Space::dim> R = matrix(x.frames[e]);
      const Point<Space> S = columns_.compliance[e], b = R.transpose() * n;
      const Point<Space> db = R.transpose() * change.known[e], dΓ = S.cwiseProduct(db);
      out.segment<spin>(layout_.frame_row(e)) +=
          h * (cross(db, Point<Space>(axis<Space>() + S.cwiseProduct(b))) + cross(b, dΓ));
      reach += h * (R * dΓ);
    }
    if (span.block >= 0)
      out.segment(layout_.row(span.block), span.open.cols()) -= span.open.transpose() * reach;
  }

  void add_node(const Acting& change, int node, Vector& out) const {
    Point<Space> balance = -change.nodes[node];
    for (const auto& [p, end] : layout_.spans_at(node))
      if (end)
        balance += change.known[layout_.last_edge(p)];
      else
        balance -= change.known[layout_.first_edge(p)];
    const auto& F = layout_.network().nodes[node].free;
    out.segment(layout_.row(layout_.place_block(node)), F.cols()) += F.transpose() * balance;
  }

  const Layout<Space>& layout_;
  const EdgeColumns<Space>& columns_;
};

}  // namespace pyrod
