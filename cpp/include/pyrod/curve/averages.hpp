// SPDX-License-Identifier: BSD-3-Clause
/// \file Kinematic post-processing: values of edges at vertices and of vertices at edge centres,
/// the "bar" quantities of Linn (note 6).
#pragma once

#include <pyrod/curve/grid.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// x̄_{j+1/2}, the mean of the values at the two vertices.
template <class T>
std::vector<T> at_centres(const Grid& grid, const std::vector<T>& x) {
  std::vector<T> out;
  for (int j = 0; j < grid.edges(); ++j) out.push_back((x[j] + x[grid.next(j)]) / 2);
  return out;
}

/// Where vertex j stands between the centres of two edges: at `before` for fraction 0, at `behind`
/// for 1, and beyond them at the ends of an open grid.
struct BetweenCentres {
  int before, behind;
  double fraction;
};

inline BetweenCentres between_centres(const Grid& grid, int j) {
  const int n = grid.edges();
  if (n == 1) return {0, 0, 0};
  int before = j - 1;
  if (!grid.closed())
    before = std::clamp(before, 0, n - 2);
  else if (j == 0)
    before = n - 1;
  const int behind = before == n - 1 ? 0 : before + 1;
  const double from_centre = j == before                ? -grid.h(before) / 2
                             : j > behind && behind > 0 ? grid.h(before) / 2 + grid.h(behind)
                                                        : grid.h(before) / 2;
  return {before, behind, from_centre / ((grid.h(before) + grid.h(behind)) / 2)};
}

/// x̄_j, on the straight line through the values at the two neighbouring edge centres; at the ends
/// of an open grid on its continuation. Second order on any grid.
template <class T>
std::vector<T> at_vertices(const Grid& grid, const std::vector<T>& x) {
  std::vector<T> out;
  for (int j = 0; j < grid.vertices(); ++j) {
    const auto [before, behind, fraction] = between_centres(grid, j);
    out.push_back((1 - fraction) * x[before] + fraction * x[behind]);
  }
  return out;
}

}  // namespace pyrod
