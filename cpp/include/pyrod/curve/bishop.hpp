// SPDX-License-Identifier: BSD-3-Clause
/// \file Discrete parallel transport (Linn 6.2.1, A.4.3).
#pragma once

#include <pyrod/curve/arc.hpp>
#include <pyrod/curve/framing.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace pyrod {

/// Bishop frames of the edges: each is the one before, turned by B_j. `start` is adapted to the
/// direction before vertex 0 (closed arc: the frame of edge 0).
///
/// B_j turns from the frame's own a3, which is the tangent but for rounding: so frames stay
/// orthonormal and adapted to rounding, however many edges there are.
inline std::vector<Quaternion> bishop_frames(const Arc& arc, const Quaternion& start) {
  std::vector<Quaternion> out;
  out.reserve(arc.edges());
  for (int j = 0; j < arc.edges(); ++j)
    out.push_back(adapted(j > 0 ? out[j - 1] : start, arc.edge(j)));
  return out;
}

/// The angle in (−π, π] about the first edge by which parallel transport once around a closed arc
/// turns a frame.
inline double holonomy(const Arc& arc) {
  Quaternion start = adapted(Quaternion::Identity(), arc.edge(0));
  const Quaternion once_around = adapted(bishop_frames(arc, start).back(), arc.edge(0));
  const Quaternion W = start.conjugate() * once_around;
  return std::remainder(twist_angle(W), 2 * std::numbers::pi);
}

}  // namespace pyrod
