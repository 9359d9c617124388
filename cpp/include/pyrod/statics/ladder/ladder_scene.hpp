// SPDX-License-Identifier: BSD-3-Clause
/// \file What the accuracy ladder needs, and what it returns.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/solution/reached.hpp>
#include <pyrod/statics/solution/solution.hpp>

#include <functional>
#include <span>

namespace pyrod {

/// What the ladder needs of a scene. On level k every edge is cut in 2ᵏ; the solution of a level is
/// that told at the vertices and edges of level 0, see `Recovery`.
struct LadderScene {
  std::span<const Rod<Spatial>> rods;  ///< on level 0
  /// tolerance: the last step [rad] that Newton's method may leave unfollowed.
  std::function<Solution<Spatial>(int level, bool from_below, double tolerance)> solve;
  std::function<bool(const SoFar&)> has_time = {};  ///< for another grid; none: always
  /// Rods turn by finite angles in single cells. Where the moment is not along such a turn, its
  /// cell gives way a little otherwise than its two halves would: errors begin with h.
  bool corners = false;
};

struct Climbed {
  Solution<Spatial> solution;  ///< at the vertices and edges of the coarsest grid
  Reached reached;
};

}  // namespace pyrod
