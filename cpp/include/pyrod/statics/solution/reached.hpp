// SPDX-License-Identifier: BSD-3-Clause
/// \file What a climb has reached.
#pragma once

#include <pyrod/statics/solution/quantity.hpp>

#include <array>
#include <cstddef>
#include <limits>
#include <string_view>

namespace pyrod {

/// What ended a climb.
enum class Ended { reached, interrupted, edges, rounding, time, failed };

constexpr std::string_view name(Ended ended) {
  constexpr std::array<std::string_view, 6> names{"reached",  "interrupted", "edges",
                                                  "rounding", "time",        "failed"};
  return names[std::size_t(ended)];
}

/// What a climb has reached so far.
struct SoFar {
  int grids = 0, edges = 0;                                ///< edges: of the finest grid
  double error = std::numeric_limits<double>::infinity();  ///< the largest, of the best grids
};

struct Reached {
  std::array<double, quantities> errors;  ///< estimates, relative; see `ErrorScales`
  double order = 0;                       ///< of the grids' own errors, as observed
  bool regular = false;                   ///< whether that is two, so that extrapolation holds
  int levels = 0, edges = 0;              ///< solves, and edges of the finest grid
  Ended ended = Ended::reached;
};

}  // namespace pyrod
