// SPDX-License-Identifier: BSD-3-Clause
/// \file The cells of a network one by one, with what holds them: all that bends and twists.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/turn_potential.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <type_traits>

namespace pyrod {

/// A cell between the frames `a` and `b`.
template <class Space>
struct CellOfNetwork {
  int rod, vertex;
  CellKind kind;
  int a, b;             ///< items of what turns, edges or held frames
  int edge_a, edge_b;   ///< −1: a held frame
  int attachment;       ///< number of what holds or cuts it; −1: nothing
  int stiffness, rest;  ///< items of its numbers
  double length;        ///< at rest
  typename Space::Rotation frame_a;
  Spin<Space> u, k, u0;         ///< turn, stiffness, turn at rest
  TurnPotential<Space> others;  ///< what acts in it besides, if it is
  bool driven = false;

  Spin<Space> strain() const { return u - u0; }
  Spin<Space> m() const { return k.cwiseProduct(u - u0); }
  Mat<Space::spin> T() const { return typename Space::Differential(u).T(); }
  TurnJet<Space> jet() const {
    return bend_twist<Hessian::exact>(u, typename Space::Differential(u), k, u0);
  }
  /// With all that acts in it.
  TurnJet<Space> whole() const {
    auto out = jet();
    if (!driven) return out;
    const auto more = turn_potential<Hessian::exact>(u, others);
    out.a += more.a, out.b += more.b;
    out.aa += more.aa, out.ab += more.ab, out.bb += more.bb;
    return out;
  }
};

namespace detail {

/// Of two spaces, stiffness and rest: C, K0 over a length.
template <class Space>
void set_numbers(CellOfNetwork<Space>& c, const Spin<Space>& C, const Spin<Space>& K0) {
  c.k = C / c.length;
  c.u0 = c.length * K0;
}

}  // namespace detail

/// Finds all that the energy has but free ends.
template <class Space>
class Cells {
 public:
  using Rotation = typename Space::Rotation;
  using Cell = CellOfNetwork<Space>;

  Cells(const Layout<Space>& layout, const NetworkState<Space>& x)
      : layout_(layout),
        net_(layout.network()),
        x_(x),
        state_(layout),
        numbers_(layout),
        attached_(layout),
        terms_(CellTerms<Space>(net_).under(x.tensions)) {}

  const CellTerms<Space>& terms() const { return terms_; }

  /// Calls visit(cell) for those between two edges of a span.
  template <class Visit>
  void for_each_inside(const Span<Space>& span, Visit&& visit) const {
    for (int j = span.first + 1; j < span.last; ++j) visit(driven(inner(span.rod, j)));
  }

  /// Calls visit(cell) for those between the last edge of a span and the first of the next.
  template <class Visit>
  void for_each_between(Visit&& visit) const {
    for_each_attached([&](int rod, int i, int before, int behind) {
      if (!layout_.attached(rod)[i].rigid && before >= 0 && behind >= 0)
        visit(driven(turn(rod, i, before, behind)));
    });
  }

  /// Calls visit(cell) for those of both kinds in which something acts besides.
  template <class Visit>
  void for_each_driven(Visit&& visit) const {
    if (terms_.none()) return;
    const auto see = [&](const Cell& c) {
      if (c.driven) visit(c);
    };
    for (const auto& span : layout_.spans()) for_each_inside(span, see);
    for_each_between(see);
  }

  /// Calls visit(cell) for the halves beside frames that are held.
  template <class Visit>
  void for_each_half(Visit&& look) const {
    const auto visit = [&](const Cell& c) { look(driven(c)); };
    for (const auto& span : layout_.spans())
      if (layout_.clamp_of(span)) visit(clamped(span));
    for_each_attached([&](int rod, int i, int before, int behind) {
      const auto& a = layout_.attached(rod)[i];
      if (!a.rigid) return;
      if (before >= 0) visit(half(rod, i, before, Side::before));
      if (behind >= 0 && !layout_.clamps(a)) visit(half(rod, i, behind, Side::behind));
    });
  }

 private:
  /// With what acts in it besides.
  Cell driven(Cell c) const {
    if (terms_.none(c.rod, c.vertex, c.kind)) return c;
    c.others = terms_.at(c.rod, c.vertex, c.kind, c.u);
    c.driven = true;
    return c;
  }

  Cell inner(int rod, int j) const {
    const int e = layout_.edge(rod, j);
    const auto& r = net_.rods[rod];
    Cell c{rod,
           j,
           CellKind::whole,
           state_.turn(e - 1),
           state_.turn(e),
           e - 1,
           e,
           -1,
           numbers_.stiffness(e),
           numbers_.rest(e),
           r.grid.Δs(j),
           x_.frames[e - 1],
           {},
           {},
           {},
           {}};
    c.u = log(x_.frames[e - 1].conjugate() * x_.frames[e]);
    detail::set_numbers<Space>(c, r.bending[j], r.K0[j]);
    return c;
  }

  Cell clamped(const Span<Space>& span) const {
    const int e = layout_.edge(span.rod, span.first), a = attached_.of(span.rod, span.attachment);
    const auto& r = net_.rods[span.rod];
    const Rotation held = nearest(held_frame(x_, *layout_.clamp_of(span)), x_.frames[e]);
    Cell c{span.rod,
           span.first,
           CellKind::behind,
           state_.held(a),
           state_.turn(e),
           -1,
           e,
           a,
           numbers_.stiffness(e),
           numbers_.rest(e),
           r.grid.h(span.first) / 2,
           held,
           {},
           {},
           {},
           {}};
    c.u = log(held.conjugate() * x_.frames[e]);
    const auto sides = r.sides(span.first);
    detail::set_numbers<Space>(c, sides.bending_behind, sides.K0_behind);
    return c;
  }

  /// With the edges beside, as `NetworkCells` finds them.
  template <class Visit>
  void for_each_attached(Visit&& visit) const {
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const auto& on = layout_.attached(rod);
      const auto& grid = net_.rods[rod].grid;
      for (int i = 0; i < int(on.size()); ++i) {
        const int n = grid.edges(), j = on[i].vertex;
        visit(rod, i, j > 0 ? j - 1 : grid.closed() ? n - 1 : -1, j < n ? j : -1);
      }
    }
  }

  Cell half(int rod, int i, int j, Side side) const {
    const auto& a = layout_.attached(rod)[i];
    const auto& r = net_.rods[rod];
    const int e = layout_.edge(rod, j), number = attached_.of(rod, i);
    const bool before = side == Side::before;
    const Rotation held = held_frame(x_, a);
    const auto sides = r.sides(a.vertex);
    Cell c{rod,
           a.vertex,
           before ? CellKind::before : CellKind::behind,
           before ? state_.turn(e) : state_.held(number),
           before ? state_.held(number) : state_.turn(e),
           before ? e : -1,
           before ? -1 : e,
           number,
           numbers_.stiffness(number, side),
           numbers_.rest(number, side),
           r.grid.h(j) / 2,
           before ? x_.frames[e] : held,
           {},
           {},
           {},
           {}};
    c.u =
        log(principal(before ? x_.frames[e].conjugate() * held : held.conjugate() * x_.frames[e]));
    before ? detail::set_numbers<Space>(c, sides.bending_before, sides.K0_before)
           : detail::set_numbers<Space>(c, sides.bending_behind, sides.K0_behind);
    return c;
  }

  Cell turn(int rod, int i, int before, int behind) const {
    const int a = layout_.edge(rod, before), b = layout_.edge(rod, behind),
              number = attached_.of(rod, i), j = layout_.attached(rod)[i].vertex;
    const auto& r = net_.rods[rod];
    Cell c{rod,
           j,
           CellKind::whole,
           state_.turn(a),
           state_.turn(b),
           a,
           b,
           number,
           numbers_.stiffness(number, Side::before),
           numbers_.rest(number, Side::before),
           r.grid.Δs(j),
           x_.frames[a],
           {},
           {},
           {},
           {}};
    Rotation W = x_.frames[a].conjugate() * x_.frames[b];
    if (b < a) W = principal(W);
    c.u = log(W);
    detail::set_numbers<Space>(c, r.bending[j], r.K0[j]);
    return c;
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkState<Space>& x_;
  StateItems<Space> state_;
  NumberItems<Space> numbers_;
  AttachmentNumbers<Space> attached_;
  CellTerms<Space> terms_;
};

}  // namespace pyrod
