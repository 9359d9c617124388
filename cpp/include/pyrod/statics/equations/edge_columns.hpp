// SPDX-License-Identifier: BSD-3-Clause
/// \file What does not change of the edges of a problem, as packs are read.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <vector>

namespace pyrod {

/// What the evaluation of a problem's edges, each with the vertex at its start, needs to know of
/// its rods. All models are one: a strain that is forbidden has the compliance 0.
template <class Space>
struct EdgeColumns {
  Columns<Space::spin> stiffness, rest;  ///< C/Δs and Δs K0 at the vertices
  Columns<1> lengths;
  Columns<Space::dim> compliance;
};

/// Of a rod that is clamped at vertex 0.
template <class Space>
EdgeColumns<Space> edge_columns(const Rod<Space>& rod) {
  constexpr int dim = Space::dim, spin = Space::spin;
  const int n = rod.edges();
  const auto& grid = rod.grid;
  return {Columns<spin>(n, [&](int j) { return rod.bending[j] / grid.Δs(j); }),
          Columns<spin>(n, [&](int j) { return grid.Δs(j) * rod.K0[j]; }),
          Columns<1>(n, [&](int j) { return Vec1(grid.h(j)); }),
          Columns<dim>(n, [&](int j) { return compliance(rod.stretching[j]); })};
}

/// Of the rods of a network. Of the vertices at which spans start, those are stiff that are
/// clamped: by the half of their cell behind them.
template <class Space>
EdgeColumns<Space> edge_columns(const Layout<Space>& layout) {
  using Turn = Spin<Space>;
  std::vector<Turn> stiffness(layout.edges(), Turn::Zero()), rest = stiffness;
  std::vector<Vec1> lengths(layout.edges());
  std::vector<Point<Space>> compliances(layout.edges());
  for (const auto& span : layout.spans()) {
    const auto& rod = layout.network().rods[span.rod];
    for (int j = span.first; j < span.last; ++j) {
      const int e = layout.edge(span.rod, j);
      lengths[e][0] = rod.grid.h(j);
      compliances[e] = compliance(rod.stretching[j]);
      if (j == span.first) continue;
      stiffness[e] = rod.bending[j] / rod.grid.Δs(j);
      rest[e] = rod.grid.Δs(j) * rod.K0[j];
    }
    if (!layout.clamp_of(span)) continue;
    const auto sides = rod.sides(span.first);
    const int e = layout.edge(span.rod, span.first);
    const double half = rod.grid.h(span.first) / 2;
    stiffness[e] = sides.bending_behind / half;
    rest[e] = half * sides.K0_behind;
  }
  const auto of = [](const auto& list) { return [&list](int e) { return list[e]; }; };
  const int n = layout.edges();
  return {{n, of(stiffness)}, {n, of(rest)}, {n, of(lengths)}, {n, of(compliances)}};
}

}  // namespace pyrod
