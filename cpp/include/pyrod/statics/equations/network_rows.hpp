// SPDX-License-Identifier: BSD-3-Clause
/// \file How the parts of a network add to its energy, gradient and Hessian.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cstdlib>

namespace pyrod {

inline void add_energy(double energy, Linearisation<BlockSymmetric>& out) {
  out.energy += energy;
  out.magnitude += std::abs(energy);
}

/// The leading part, as much as the block has, goes to the gradient.
template <class Space, int N>
void add_to_rows(const Layout<Space>& layout, int block, const Vec<N>& part,
                 Linearisation<BlockSymmetric>& out) {
  const int size = layout.sizes()[block];
  out.gradient.segment(layout.row(block), size) += part.head(size);
}

/// Directions as a matrix of fixed size: columns that are missing are zero.
template <int N>
Mat<N> padded(const Directions<N>& A) {
  Mat<N> out = Mat<N>::Zero();
  out.leftCols(A.cols()) = A;
  return out;
}

/// The rod's own frame at the node turns by Eᵀ φ if the node turns by φ, E leading from the one
/// to the other.
template <class Space>
Mat<Space::spin> own_turns(const Network<Space>& net, const NetworkState<Space>& x,
                           const Attachment<Space>& a) {
  const auto back = held_frame(x, a).conjugate() * x.node_frames[a.node];
  Mat<Space::spin> out = padded(net.nodes[a.node].turns);
  for (int i = 0; i < Space::spin; ++i) out.col(i) = rotate_spin(back, Spin<Space>(out.col(i)));
  return out;
}

}  // namespace pyrod
