// SPDX-License-Identifier: BSD-3-Clause
/// \file Frames on a grid of halved edges from those on coarser ones.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pyrod {

namespace detail {

inline Vec<4> components(const Quaternion& q) { return q.coeffs(); }
inline Vec1 components(Angle a) { return Vec1(a.radians); }
inline Quaternion rotation(const Vec<4>& q) { return Quaternion(q).normalized(); }
inline Angle rotation(const Vec1& a) { return {a[0]}; }

using Weights = std::array<double, 4>;

/// Lagrange's weights at s of the centres of the edges first … first + 3.
inline Weights weights(const Grid& grid, int first, double s) {
  Weights out;
  for (int a = 0; a < 4; ++a) {
    out[a] = 1;
    for (int b = 0; b < 4; ++b)
      if (b != a)
        out[a] *= (s - grid.centre(first + b)) / (grid.centre(first + a) - grid.centre(first + b));
  }
  return out;
}

/// Those of four equal edges, at a quarter before (side 0) and behind (1) the centre of each.
inline const std::array<std::array<Weights, 2>, 4>& equal_weights() {
  static const auto table = [] {
    const Grid unit(Vector::Ones(4));
    std::array<std::array<Weights, 2>, 4> out;
    for (int j = 0; j < 4; ++j)
      for (int side = 0; side < 2; ++side)
        out[j][side] = weights(unit, 0, unit.centre(j) + (side ? 0.25 : -0.25));
    return out;
  }();
  return table;
}

/// Calls put(j, side, first, weights) for the halves of every edge j, side 0 before side 1.
template <class Put>
void for_each_half(const Grid& grid, const Put& put) {
  const auto& equal = equal_weights();
  for (int j = 0; j < grid.edges(); ++j)
    for (int side = 0; side < 2; ++side) {
      const int first = std::clamp(j - (side ? 1 : 2), 0, grid.edges() - 4);
      const double h = grid.h(first);
      if (grid.h(first + 1) == h && grid.h(first + 2) == h && grid.h(first + 3) == h)
        put(j, side, first, equal[j - first][side]);
      else
        put(j, side, first, weights(grid, first, grid.centre(j) + (side ? 1 : -1) * grid.h(j) / 4));
    }
}

}  // namespace detail

/// What is known on a grid: its frames, and how they differ from those of the coarser grid.
template <class Rotation>
struct Prolonged {
  using Components = decltype(detail::components(Rotation{}));
  std::vector<Rotation> start;      ///< the frames expected on the finer grid
  std::vector<Components> between;  ///< those of the coarser grid, in between and no more
};

/// From `frames` on `grid` to the grid of halved edges: cubic through the four nearest frames,
/// quaternions component by component and brought back to unit length; their signs must be
/// continued. `last` is what this function returned for the grid before, if anything: errors of
/// second order fall to a quarter from grid to grid, and so does what changes next.
template <class Rotation>
Prolonged<Rotation> prolonged(const Grid& grid, const std::vector<Rotation>& frames,
                              const Prolonged<Rotation>& last = {}) {
  require_count(Eigen::Index(frames.size()), grid.edges(), "frames", "one per edge");
  Prolonged<Rotation> out;
  out.start.reserve(2 * frames.size());
  if (grid.edges() < 4) {
    for (const auto& q : frames) out.start.insert(out.start.end(), 2, q);
    return out;
  }
  using Components = typename Prolonged<Rotation>::Components;
  std::vector<Components> now, change;
  now.reserve(frames.size());
  for (const auto& q : frames) now.push_back(detail::components(q));
  if (last.between.size() == now.size())
    for (std::size_t j = 0; j < now.size(); ++j) change.push_back((now[j] - last.between[j]) / 4);
  out.between.reserve(2 * frames.size());
  detail::for_each_half(grid, [&](int, int, int first, const detail::Weights& w) {
    const auto mean = [&](const std::vector<Components>& of) -> Components {
      return w[0] * of[first] + w[1] * of[first + 1] + w[2] * of[first + 2] + w[3] * of[first + 3];
    };
    out.between.push_back(mean(now));
    out.start.push_back(detail::rotation(
        change.empty() ? out.between.back() : Components(out.between.back() + mean(change))));
  });
  return out;
}

}  // namespace pyrod
