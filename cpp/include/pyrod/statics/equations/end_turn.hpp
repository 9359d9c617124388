// SPDX-License-Identifier: BSD-3-Clause
/// \file The turn of the half cell at an end that nothing holds in its frame, as theory
/// (10) has it without tendons: theory (35).
#pragma once

#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>

namespace pyrod {

/// From the edge beside to the end. `M`: the moment on the end, in the frame of that edge; or, at
/// the end of the rod, if it `follows`, in that of the end.
template <class Space>
Spin<Space> turn_of_end(const CellTerms<Space>& terms, const Rod<Space>& r, int rod, End end,
                        const Spin<Space>& M, bool follows) {
  const bool start = end == End::start;
  const int j = start ? 0 : r.edges();
  const Spin<Space> K0 = start ? Spin<Space>(-r.K0[j]) : r.K0[j];
  const Spin<Space> u = follows ? turn_under_moment_behind<Space>(M, r.bending[j], K0, r.grid.Δs(j))
                                : turn_under_moment<Space>(M, r.bending[j], K0, r.grid.Δs(j));
  const CellKind kind = start ? CellKind::behind : CellKind::before;
  if (terms.none(rod, j, kind)) return u;
  const auto law = [&](const Spin<Space>& turn) { return terms.whole(rod, j, kind, turn); };
  if (start) return turn_under_moment<Space>(M, mirrored<Space>(law), u);
  return follows ? turn_under_moment_behind<Space>(M, law, u) : turn_under_moment<Space>(M, law, u);
}

}  // namespace pyrod
