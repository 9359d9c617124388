// SPDX-License-Identifier: BSD-3-Clause
/// \file The unknowns of a network, as they stand.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

template <class Space>
struct NetworkState {
  std::vector<typename Space::Rotation> frames;       ///< of all edges
  std::vector<typename Space::Rotation> node_frames;  ///< of all nodes
  std::vector<Point<Space>> forces;     ///< of all spans: what the loads do not tell of them
  std::vector<Point<Space>> positions;  ///< of all nodes; meaningless where they are derived
  std::vector<double> hinge_angles;     ///< of all hinges
  std::vector<double> tensions = {};    ///< of all tendons, where they are found; none: zero
  std::vector<char> slack = {};         ///< of all tendons: too long to bear anything; none: none

  /// Memory it takes.
  std::size_t bytes() const {
    const auto of = [](const auto& list) { return list.capacity() * sizeof(list[0]); };
    return of(frames) + of(node_frames) + of(forces) + of(positions) + of(hinge_angles) +
           of(tensions);
  }
};

/// The frame in which a node, or a hinge in it, holds a rod.
template <class Space>
typename Space::Rotation held_frame(const NetworkState<Space>& x, const Attachment<Space>& a) {
  if (!a.hinge) return x.node_frames[a.node] * a.relative;
  const Spin<Space> turn = x.hinge_angles[a.hinge_number] * *a.hinge;
  return x.node_frames[a.node] * exp(turn) * a.relative;
}

}  // namespace pyrod
