// SPDX-License-Identifier: BSD-3-Clause
/// \file The same rod on halved edges.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>

#include <cstddef>
#include <string_view>

namespace pyrod {

/// Every edge cut in two.
inline Grid halved(const Grid& grid) {
  Vector h(2 * grid.edges());
  for (int j = 0; j < grid.edges(); ++j) h[2 * j] = h[2 * j + 1] = grid.h(j) / 2;
  return Grid(h);
}

/// A level of a climb has the edges of level 0, each cut in 2ᵏ, and `given` numbers for them.
inline void require_level(Eigen::Index given, Eigen::Index level0, int level,
                          std::string_view what) {
  require(given == level0 << level, "level ", level, ": expected ", level0 << level, " ", what,
          ", got ", given);
}

/// Compliance and rest curvature are linear between the vertices, stretching stiffness is that of
/// the edge. Of a rod without jumps.
template <class Space>
Rod<Space> halved(const Rod<Space>& rod) {
  Rod<Space> out{halved(rod.grid), {}, {}, {}};
  const int n = rod.edges();
  out.bending.reserve(2 * std::size_t(n) + 1), out.K0.reserve(2 * std::size_t(n) + 1);
  out.stretching.reserve(2 * std::size_t(n));
  for (int j = 0; j < n; ++j) {
    const auto &C = rod.bending[j], &D = rod.bending[j + 1];
    out.bending.push_back(C);
    out.bending.push_back(2 * C.cwiseProduct(D).cwiseQuotient(C + D));
    out.K0.push_back(rod.K0[j]);
    out.K0.push_back((rod.K0[j] + rod.K0[j + 1]) / 2);
    out.stretching.insert(out.stretching.end(), 2, rod.stretching[j]);
  }
  out.bending.push_back(rod.bending[n]);
  out.K0.push_back(rod.K0[n]);
  return out;
}

}  // namespace pyrod
