// SPDX-License-Identifier: BSD-3-Clause
/// \file What a path of equilibria may meet, and how it may end, in words.
#pragma once

#include <cstddef>

namespace pyrod {

enum class Singularity { fold, transcritical, supercritical, subcritical, multiple, unresolved };

/// The third and the fourth are of a pitchfork. `multiple`: several modes have no stiffness;
/// `unresolved`: the index changes, and why was not found.
constexpr const char* name(Singularity kind) {
  constexpr const char* names[] = {
      "fold",   "transcritical", "supercritical pitchfork", "subcritical pitchfork",
      "double", "unresolved"};
  return names[std::size_t(kind)];
}

enum class PathEnd { reached, turned_back, most_points, lost, interrupted };

constexpr const char* name(PathEnd ended) {
  constexpr const char* names[] = {"reached", "turned back", "max_points", "lost", "interrupted"};
  return names[std::size_t(ended)];
}

}  // namespace pyrod
