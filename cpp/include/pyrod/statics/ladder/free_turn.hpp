// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibria that may turn freely about an axis: which of them a grid finds is chance, so
/// that a rung is turned back onto the one before.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/statics/ladder/rung.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pyrod {

namespace detail {

/// The axis about which everything turns in a mode of the edges of all rods, if it is such a turn.
inline std::optional<Vec3> free_axis(const Rung& rung, const std::vector<Vec3>& mode) {
  Vec3 sum = Vec3::Zero();
  std::vector<Vec3> turns;
  std::size_t edge = 0;
  for (const auto& rod : rung.rods)
    for (const auto& q : rod.curve.frames) {
      if (edge == mode.size()) return std::nullopt;
      turns.push_back(rotate(q, mode[edge++]));
      sum += turns.back();
    }
  const Vec3 mean = sum / double(std::max<std::size_t>(turns.size(), 1));
  for (const auto& turn : turns)
    if ((turn - mean).norm() > 1e-3) return std::nullopt;
  return mean.norm() > 0.5 ? std::optional<Vec3>(mean.normalized()) : std::nullopt;
}

inline void turn(Rung& rung, const Quaternion& by, const Vec3& centre) {
  for (auto& rod : rung.rods) {
    for (auto& r : rod.curve.positions) r = centre + rotate(by, Vec3(r - centre));
    for (auto* list : {&rod.vertex_force, &rod.moment, &rod.force})
      for (auto& v : *list) v = rotate(by, v);
    for (auto& b : rod.before) b.force = rotate(by, b.force), b.moment = rotate(by, b.moment);
    for (auto* list : {&rod.vertex_frames, &rod.curve.frames})
      for (auto& q : *list) q = by * q;
  }
  for (auto& node : rung.nodes) {
    node.position = centre + rotate(by, Vec3(node.position - centre));
    node.frame = by * node.frame;
    node.reaction_force = rotate(by, node.reaction_force);
    node.reaction_moment = rotate(by, node.reaction_moment);
  }
}

}  // namespace detail

/// Turns the rung about the free axis, through the start of the first rod, to where it is nearest
/// to the rung before. `mode`: that of a neutral equilibrium.
inline void undo_free_turn(Rung& rung, const Rung& before, const std::vector<Vec3>& mode) {
  const auto axis = detail::free_axis(rung, mode);
  if (!axis) return;
  const Vec3 centre = rung.rods[0].curve.positions[0];
  double sine = 0, cosine = 0;
  for (std::size_t i = 0; i < rung.rods.size(); ++i)
    for (std::size_t j = 0; j < rung.rods[i].curve.positions.size(); ++j) {
      const Vec3 a = rung.rods[i].curve.positions[j] - centre;
      const Vec3 b = before.rods[i].curve.positions[j] - centre;
      const Vec3 across = a - axis->dot(a) * *axis;
      sine += axis->dot(across.cross(b));
      cosine += across.dot(b);
    }
  if (sine == 0 && cosine == 0) return;
  detail::turn(rung, exp(Vec3(std::atan2(sine, cosine) * *axis)), centre);
}

}  // namespace pyrod
