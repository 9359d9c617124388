// SPDX-License-Identifier: BSD-3-Clause
/// \file Places on the rods of a scene.
#pragma once

#include <pyrod/curve/grid.hpp>

#include <variant>

namespace pyrod {

enum class End { start, end };

/// An end, or an arc length [m]; of rod 0 unless another is named.
struct Place {
  int rod = 0;
  std::variant<End, double> at;

  Place(End end) : at(end) {}
  Place(double arc_length) : at(arc_length) {}
  Place(int number, End end) : rod(number), at(end) {}
  Place(int number, double arc_length) : rod(number), at(arc_length) {}

  bool operator==(const Place&) const = default;

  /// The arc length on a rod with this grid; refuses what is not on it.
  double on(const Grid& grid) const {
    if (const auto* end = std::get_if<End>(&at)) return *end == End::start ? 0 : grid.length();
    return grid.on_rod(std::get<double>(at));
  }
};

}  // namespace pyrod
