// SPDX-License-Identifier: BSD-3-Clause
/// \file What errors are told of.
#pragma once

#include <array>

namespace pyrod {

/// What an error is told of. Those up to `reaction_moments` are of vertices and sums; those up to
/// `strains` of edges, at their centres; the last of the largest values along rods.
enum class Quantity {
  unjudged = -1,
  positions,
  frames,
  curvatures,
  forces,
  moments,
  energy,
  reactions,
  reaction_moments,
  edge_frames,
  edge_forces,
  strains,
  extremes
};
constexpr int vertex_quantities = 8, edge_quantities = 3, quantities = 12;
constexpr std::array<const char*, quantities> quantity_names{
    "positions", "frames",           "curvatures",  "forces",      "moments", "energy",
    "reactions", "reaction_moments", "edge_frames", "edge_forces", "strains", "extremes"};

}  // namespace pyrod
