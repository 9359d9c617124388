// SPDX-License-Identifier: BSD-3-Clause
/// \file Small changes of an equilibrium, or weights of them, as users know them: in space.
#pragma once

#include <pyrod/core/types.hpp>

#include <vector>

namespace pyrod {

/// Of one rod. Frames change by R ← R exp(φ): by rotation vectors in the components of the frame.
struct RodChange {
  std::vector<Vec3> positions;  ///< of the vertices
  std::vector<Vec3> frames;     ///< of the edges
  std::vector<Vec3> vertex_frames;
  std::vector<Vec3> rotations;  ///< of the vertices, in space: what moments work on
  std::vector<Vec3> K, moment;  ///< at the vertices
  std::vector<Vec3> Γ, force;   ///< on the edges

  explicit RodChange(int edges = 0)
      : positions(edges + 1, Vec3::Zero()),
        frames(edges, Vec3::Zero()),
        vertex_frames(positions),
        rotations(positions),
        K(positions),
        moment(positions),
        Γ(frames),
        force(frames) {}
};

/// Of a scene; reactions of its supports, in their order.
struct SceneChange {
  std::vector<RodChange> rods;
  std::vector<Vec3> reaction_forces, reaction_moments;
  /// Section forces with which spans begin, rod by rod: what is unknown of them are the
  /// multipliers.
  std::vector<Vec3> multipliers;
  std::vector<double> tendon_lengths, tensions;  ///< in the order of the actuators
  double energy = 0;
};

/// A list for each kind of number that a rod has along it, in space.
struct RodFields {
  std::vector<Vec3> bending, K0;  ///< at the n + 1 vertices
  std::vector<Vec3> stretching;   ///< of the n edges
};

}  // namespace pyrod
