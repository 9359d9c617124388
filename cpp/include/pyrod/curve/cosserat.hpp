// SPDX-License-Identifier: BSD-3-Clause
/// \file The discrete Cosserat curve: strains from positions and frames, and back.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>

#include <vector>

namespace pyrod {

/// Positions on the vertices, frames on the edges, and the frames that the two ends are held by.
/// An end that nothing holds has the frame of its edge: its half cell does not turn.
template <class Space>
struct CosseratCurve {
  std::vector<Point<Space>> positions;              ///< r_j, n + 1
  std::vector<typename Space::Rotation> frames;     ///< q_{j-1/2}, n
  typename Space::Rotation start_frame, end_frame;  ///< q_0, q_n

  int edges() const { return int(frames.size()); }
  /// The frame before vertex j, and the one behind it.
  const auto& frame_before(int j) const { return j == 0 ? start_frame : frames[j - 1]; }
  const auto& frame_behind(int j) const { return j == edges() ? end_frame : frames[j]; }
};

/// Material strains: K_j on the vertices, Γ_{j-1/2} on the edges.
template <class Space>
struct Strains {
  std::vector<Spin<Space>> K;
  std::vector<Point<Space>> Γ;
};

/// u_j = 2 log W_j with W_j = q*_{j-1/2} q_{j+1/2}: the turn at vertex j, |u| < 2π.
template <class Space>
Spin<Space> turn(const CosseratCurve<Space>& curve, int j) {
  return log(curve.frame_before(j).conjugate() * curve.frame_behind(j));
}

/// K_j = u_j/Δs_j, Linn (48), and Γ_{j-1/2} = Rᵀ (r_j − r_{j-1})/h, Linn (50).
template <class Space>
Strains<Space> strains(const Grid& grid, const CosseratCurve<Space>& curve) {
  const int n = grid.edges();
  Strains<Space> out{std::vector<Spin<Space>>(n + 1), std::vector<Point<Space>>(n)};
  for (int j = 0; j <= n; ++j) out.K[j] = turn(curve, j) / grid.Δs(j);
  for (int j = 0; j < n; ++j) {
    const Point<Space> edge = curve.positions[j + 1] - curve.positions[j];
    out.Γ[j] = unrotate(curve.frames[j], edge) / grid.h(j);
  }
  return out;
}

/// The inverse of `strains`: the one curve with these strains that starts at r_0 in the frame q_0.
template <class Space>
CosseratCurve<Space> reconstruct(const Grid& grid, const Strains<Space>& strains,
                                 const Point<Space>& r0, const typename Space::Rotation& q0) {
  const int n = grid.edges();
  CosseratCurve<Space> curve{{r0}, {}, q0, q0};
  curve.positions.reserve(n + 1);
  curve.frames.reserve(n);
  for (int j = 0; j < n; ++j) {
    curve.frames.push_back(moved(curve.frame_before(j), grid.Δs(j) * strains.K[j]));
    curve.positions.push_back(curve.positions[j] +
                              grid.h(j) * rotate(curve.frames[j], strains.Γ[j]));
  }
  curve.end_frame = moved(curve.frames[n - 1], grid.Δs(n) * strains.K[n]);
  return curve;
}

/// The frame at vertex j, on the way between its two neighbours where the arc length says.
template <class Space>
typename Space::Rotation vertex_frame(const Grid& grid, const CosseratCurve<Space>& curve, int j) {
  if (j == 0) return curve.start_frame;
  if (j == grid.edges()) return curve.end_frame;
  return between(curve.frames[j - 1], curve.frames[j], grid.h(j - 1) / (2 * grid.Δs(j)));
}

}  // namespace pyrod
