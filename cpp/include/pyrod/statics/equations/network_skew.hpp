// SPDX-License-Identifier: BSD-3-Clause
/// \file What is not symmetric in the tangent of a network: moments without a potential, and forces
/// that follow frames.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/force_change.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

template <class Space>
class NetworkSkew {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;
  static constexpr int spin = Space::spin;

  NetworkSkew(const Layout<Space>& layout, const NetworkLoads<Space>& loads,
              const EdgeColumns<Space>& columns)
      : layout_(layout), net_(layout.network()), loads_(loads), columns_(columns) {}

  /// w = (tangent − its symmetric part) v: moments that do not follow a potential, and the change
  /// of forces that follow frames.
  void multiply(const State& x, const Vector& v, Vector& out) const {
    out.setZero(v.size());
    for (const auto& [edge, m] : loads_.edge_moments())
      add_moment_skew(x.frames[edge], m, layout_.frame_row(edge), v, out);
    for (int node = 0; node < int(net_.nodes.size()); ++node)
      if (const int b = layout_.turn_block(node); b >= 0 && spin == 3) {
        const auto& T = net_.nodes[node].turns;
        const Spin<Space> φ = T * v.segment(layout_.row(b), T.cols());
        const Spin<Space> m =
            rotate_spin(x.node_frames[node].conjugate(), loads_.node_moments()[node]) -
            loads_.node_follower_moments()[node];
        out.segment(layout_.row(b), T.cols()) += T.transpose() * (spin_skew(φ) * m / 2);
      }
    if (loads_.follow()) add_follower_skew(x, v, out);
  }

 private:
  /// −½ [Rᵀm], theory (11): with it the tangent is that of the residual in the coordinates exp(φ).
  void add_moment_skew(const Rotation& q, const Spin<Space>& m, int first, const Vector& v,
                       Vector& out) const {
    out.segment<spin>(first) +=
        spin_skew(Spin<Space>(v.segment<spin>(first))) * rotate_spin(q.conjugate(), m) / 2;
  }

  void add_follower_skew(const State& x, const Vector& v, Vector& out) const {
    typename NetworkLoads<Space>::Acting change;
    change.vertices = loads_.dead_forces();
    for (auto& rod : change.vertices) std::fill(rod.begin(), rod.end(), Point<Space>::Zero());
    const auto turn_of = [&](int e) { return Spin<Space>(v.segment<spin>(layout_.frame_row(e))); };
    for (const auto& f : loads_.follower_forces())
      change.vertices[f.rod][f.vertex] -=
          rotate(x.frames[f.edge], Point<Space>(skew(f.force) * turn_of(f.edge)));
    for (const auto& [edge, m] : loads_.follower_moments())  // +½ [M]
      out.segment<spin>(layout_.frame_row(edge)) -= spin_skew(turn_of(edge)) * m / 2;
    loads_.find_sections(change, 0);
    typename NetworkLoads<Space>::Acting changed;
    ForceChange<Space>(layout_, columns_).add(x, loads_.acting(x, changed), change, out);
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkLoads<Space>& loads_;
  const EdgeColumns<Space>& columns_;
};

}  // namespace pyrod
