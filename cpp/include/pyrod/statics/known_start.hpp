// SPDX-License-Identifier: BSD-3-Clause
/// \file The shape that a user knows, as a start on the edges of a scene.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod::detail {

using Start = std::optional<NetworkStart>;

/// Frames of the edges of `plain`, on those of `ready`, where that has more vertices; none if it
/// has not, or the frames are others.
inline std::vector<Quaternion> on_more_edges(const std::vector<Quaternion>& frames,
                                             const ReadyScene& plain, const ReadyScene& ready) {
  std::vector<Quaternion> out;
  if (int(frames.size()) != plain.edges() || ready.edges() == plain.edges()) return out;
  std::size_t first = 0;
  for (std::size_t i = 0; i < plain.scene().rods.size(); ++i) {
    const auto &old = plain.grid().rod(int(i)).grid, &now = ready.grid().rod(int(i)).grid;
    for (const double s : centres(now.arc_lengths()))
      out.push_back(frames[first + std::size_t(edge_at(old, s))]);
    first += std::size_t(old.edges());
  }
  return out;
}

/// A turn of the first cell may reach 2π: the signs go on from where the rod is held.
inline void continue_signs(std::vector<Quaternion>& frames, const ReadyScene& ready) {
  const auto& held = ready.network().held;
  Quaternion before = held.empty() ? frames[0] : held[0].frame;
  for (auto& q : frames) {
    if (before.dot(q) < 0) q.coeffs() *= -1;
    before = q;
  }
}

inline Start known_start(const Settings& settings, const ReadyScene& plain,
                         const ReadyScene& ready) {
  const bool frames = !settings.frames.empty();
  require(!frames || !settings.start, "start: give it or frames, not both");
  if (!settings.start && !frames) return std::nullopt;
  NetworkStart out;
  out.frames = settings.frames;
  if (settings.start)
    for (const auto& rod : settings.start->rods())
      out.frames.insert(out.frames.end(), rod.curve.frames.begin(), rod.curve.frames.end());
  else if (ready.scene().rods.size() == 1)
    continue_signs(out.frames, ready);
  if (auto more = on_more_edges(out.frames, plain, ready); !more.empty()) {
    out.frames = std::move(more);
    return out;
  }
  if (settings.start) return start_from(settings.start->rods(), ready.network().network);
  return out;
}

}  // namespace pyrod::detail
