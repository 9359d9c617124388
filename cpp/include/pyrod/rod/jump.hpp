// SPDX-License-Identifier: BSD-3-Clause
/// \file A vertex at which the stiffness, or the curvature at rest, is not the same on both sides.
#pragma once

#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// The halves of the vertex cell turn one after the other: the cell's compliance is the mean of
/// theirs, and so is its curvature at rest. They matter for the frame at the vertex, and for a node
/// that holds it.
template <class Space>
struct Jump {
  int vertex;
  Spin<Space> bending_before, K0_before;  ///< of the edge before the vertex
  Spin<Space> bending_behind, K0_behind;

  Spin<Space> K_before(const Spin<Space>& M) const {
    return K0_before + M.cwiseQuotient(bending_before);
  }
  Spin<Space> K_behind(const Spin<Space>& M) const {
    return K0_behind + M.cwiseQuotient(bending_behind);
  }

  /// The part of the turn u of the cell that belongs to the half before the vertex. `M`: moments of
  /// the halves, which differ by what acts on the vertex; h: lengths of the edges.
  Spin<Space> turn_before(const Spin<Space>& u, const Spin<Space>& M_before,
                          const Spin<Space>& M_behind, double h_before, double h_behind) const {
    const Spin<Space> before = h_before / 2 * K_before(M_before),
                      behind = h_behind / 2 * K_behind(M_behind);
    return before + (u - before - behind) / 2;
  }
};

}  // namespace pyrod
