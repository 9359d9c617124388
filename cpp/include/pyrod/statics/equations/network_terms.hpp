// SPDX-License-Identifier: BSD-3-Clause
/// \file What terms besides the diagonal law add to the rows of a network, cell by cell.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/turn_potential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/network_cells.hpp>
#include <pyrod/statics/equations/tendon_rows.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// Calls visit(vertex, kind, attachment or null) for the cells of an open rod that its energy has:
/// those at ends that turn freely are no part of it.
template <class Space, class Visit>
void for_each_cell(const Layout<Space>& layout, int rod, const Visit& visit) {
  const int n = layout.network().rods[rod].edges();
  auto a = layout.attached(rod).begin();
  const auto end = layout.attached(rod).end();
  for (int j = 0; j <= n; ++j) {
    const Attachment<Space>* on = a != end && a->vertex == j ? &*a++ : nullptr;
    if (on && on->rigid) {
      if (j > 0) visit(j, CellKind::before, on);
      if (j < n) visit(j, CellKind::behind, on);
    } else if (j > 0 && j < n) {
      visit(j, CellKind::whole, on);
    }
  }
}

/// The turn of a cell of an open rod; `a`: what holds it, for the halves.
template <class Space>
Spin<Space> turn_of_cell(const Layout<Space>& layout, const NetworkState<Space>& x, int rod, int j,
                         CellKind kind, const Attachment<Space>* a) {
  const auto frame = [&](int edge) -> const auto& { return x.frames[layout.edge(rod, edge)]; };
  switch (kind) {
    case CellKind::before:
      return log(principal(frame(j - 1).conjugate() * held_frame(x, *a)));
    case CellKind::behind:
      return log(principal(held_frame(x, *a).conjugate() * frame(j)));
    default:
      return log(frame(j - 1).conjugate() * frame(j));
  }
}

template <class Space>
class NetworkTerms {
 public:
  NetworkTerms(const Layout<Space>& layout, const CellTerms<Space>& terms)
      : layout_(layout), terms_(terms), cells_(layout) {}

  /// Adds to rows that are there.
  template <Hessian kind>
  void add(const NetworkState<Space>& x, typename NetworkCells<Space>::Storage& out) const {
    TendonRows<Space> rows(layout_, terms_, x, out);
    for (int rod = 0; rod < int(layout_.network().rods.size()); ++rod) {
      if (terms_.none(rod)) continue;
      for_each_cell(layout_, rod, [&](int j, CellKind of, const Attachment<Space>* a) {
        if (!terms_.none(rod, j, of)) add_cell<kind>(x, rod, j, of, a, rows, out);
      });
    }
    rows.finish();
  }

 private:
  template <Hessian kind>
  void add_cell(const NetworkState<Space>& x, int rod, int j, CellKind of,
                const Attachment<Space>* a, TendonRows<Space>& rows,
                typename NetworkCells<Space>::Storage& out) const {
    const Spin<Space> u = turn_of_cell(layout_, x, rod, j, of, a);
    const auto jet = turn_potential<kind>(u, terms_.at(rod, j, of, u));
    const bool whole = of == CellKind::whole, before = of == CellKind::before;
    const int e = layout_.edge(rod, before ? j - 1 : j);
    if (whole)
      cells_.put_turn(jet, e - 1, e, out);
    else
      cells_.template put_half<kind>(jet, x, *a, e, before, out);
    terms_.for_each_tendon(rod, j, of, u, [&](int i, double, const auto& tendon) {
      if (!rows.holds(i)) return;
      const Mat<Space::spin> T = typename Space::Differential(u).T();
      if (whole)
        rows.put_turn(i, tendon.slope, T, tendon.length, e - 1, e);
      else
        rows.put_half(i, tendon.slope, T, tendon.length, *a, e, before);
    });
  }

  const Layout<Space>& layout_;
  const CellTerms<Space>& terms_;
  NetworkCells<Space> cells_;
};

}  // namespace pyrod
