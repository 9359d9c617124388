// SPDX-License-Identifier: BSD-3-Clause
/// \file The rod: grid, stiffness along it, and the curvature it has at rest.
#pragma once

#include <pyrod/curve/cosserat.hpp>

namespace pyrod {

/// What a rod is made of. Stiffness and rest curvature may differ from place to place.
template <class Space>
struct Rod {
  Grid grid;
  std::vector<Spin<Space>> bending;      ///< C_bt = (EI1, EI2, GJ) at the n + 1 vertices; plane: EI2
  std::vector<Point<Space>> stretching;  ///< C_es = (GA1, GA2, EA) on the n edges; plane: (GA1, EA)
  std::vector<Spin<Space>> K0;           ///< rest curvature at the n + 1 vertices

  /// The same everywhere, and straight at rest unless `K0` says otherwise.
  static Rod uniform(Grid grid, const Spin<Space>& bending, const Point<Space>& stretching,
                     const Spin<Space>& K0 = Spin<Space>::Zero()) {
    const int n = grid.edges();
    return {std::move(grid), std::vector<Spin<Space>>(n + 1, bending),
            std::vector<Point<Space>>(n, stretching), std::vector<Spin<Space>>(n + 1, K0)};
  }

  int edges() const { return grid.edges(); }

  /// The stress-free shape, placed with its start at r0 in the frame q0.
  CosseratCurve<Space> at_rest(const Point<Space>& r0, const typename Space::Rotation& q0) const {
    return reconstruct<Space>(grid, {K0, std::vector<Point<Space>>(edges(), axis<Space>())}, r0, q0);
  }
};

}  // namespace pyrod
