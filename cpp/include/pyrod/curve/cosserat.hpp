// SPDX-License-Identifier: BSD-3-Clause
/// \file The discrete Cosserat curve: strains from positions and frames, and back.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/measure.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <utility>
#include <vector>

namespace pyrod {

/// Positions on the vertices, frames on the edges, and the frames that the two ends are held by.
/// An end that nothing holds has the frame of its edge: its half cell does not turn. On a closed
/// curve, which has n positions, `start_frame` is the last edge's, see `closed`.
template <class Space>
struct CosseratCurve {
  std::vector<Point<Space>> positions;              ///< r_j, n + 1 (closed: n)
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

/// W_j = q*_{j-1/2} q_{j+1/2}, the difference rotation at vertex j.
template <class Space>
typename Space::Rotation difference(const CosseratCurve<Space>& curve, int j) {
  return curve.frame_before(j).conjugate() * curve.frame_behind(j);
}

/// u_j = 2 log W_j: the turn at vertex j, |u| < 2π.
template <class Space>
Spin<Space> turn(const CosseratCurve<Space>& curve, int j) {
  return log(difference(curve, j));
}

/// Joins the last frame to the first. The sign before vertex 0 is the one with the smaller turn:
/// where the frames have gone round an odd number of times, the quaternions cannot close.
inline CosseratCurve<Spatial> closed(std::vector<Vec3> positions, std::vector<Quaternion> frames) {
  Quaternion last = frames.back();
  if (last.dot(frames.front()) < 0) last.coeffs() *= -1;
  return {std::move(positions), std::move(frames), last, last};
}

/// K_j = u_j/Δs_j, Linn (48), and Γ_{j-1/2} = Rᵀ (r_j − r_{j-1})/h, Linn (50); theory (1) and (2).
/// Another measure than `log` replaces 2 log W in (48).
template <class Space>
Strains<Space> strains(const Grid& grid, const CosseratCurve<Space>& curve,
                       Measure measure = Measure::log) {
  Strains<Space> out{std::vector<Spin<Space>>(grid.vertices()),
                     std::vector<Point<Space>>(grid.edges())};
  for (int j = 0; j < grid.vertices(); ++j)
    out.K[j] = measured(difference(curve, j), measure) / grid.Δs(j);
  for (int j = 0; j < grid.edges(); ++j) {
    const Point<Space> edge = curve.positions[grid.next(j)] - curve.positions[j];
    out.Γ[j] = unrotate(curve.frames[j], edge) / grid.h(j);
  }
  return out;
}

/// K(s) at the vertices and Γ(s) at the edge centres: what makes the reconstruction of a smooth
/// curve second order.
template <class Space, class Curvature, class Stretch>
Strains<Space> sampled(const Grid& grid, const Curvature& K, const Stretch& Γ) {
  Strains<Space> out;
  for (int j = 0; j < grid.vertices(); ++j) out.K.push_back(K(grid.s(j)));
  for (int j = 0; j < grid.edges(); ++j) out.Γ.push_back(Γ(grid.centre(j)));
  return out;
}

/// The inverse of `strains` on an open grid: the one curve with these strains that starts at r_0 in
/// the frame q_0.
template <class Space>
CosseratCurve<Space> reconstruct(const Grid& grid, const Strains<Space>& strains,
                                 const Point<Space>& r0, const typename Space::Rotation& q0,
                                 Measure measure = Measure::log) {
  const int n = grid.edges();
  CosseratCurve<Space> curve{{r0}, {}, q0, q0};
  curve.positions.reserve(n + 1);
  curve.frames.reserve(n);
  for (int j = 0; j < n; ++j) {
    curve.frames.push_back(turned(curve.frame_before(j), grid.Δs(j) * strains.K[j], measure));
    curve.positions.push_back(curve.positions[j] +
                              grid.h(j) * rotate(curve.frames[j], strains.Γ[j]));
  }
  curve.end_frame = turned(curve.frames[n - 1], grid.Δs(n) * strains.K[n], measure);
  return curve;
}

/// The frame at vertex j, on the way between its two neighbours where the arc length says.
template <class Space>
typename Space::Rotation vertex_frame(const Grid& grid, const CosseratCurve<Space>& curve, int j) {
  if (j == grid.edges()) return curve.end_frame;
  if (j == 0 && !grid.closed()) return curve.start_frame;
  const double before = grid.h(j == 0 ? grid.edges() - 1 : j - 1);
  return between(curve.frame_before(j), curve.frame_behind(j), before / (2 * grid.Δs(j)));
}

template <class Space>
std::vector<typename Space::Rotation> vertex_frames(const Grid& grid,
                                                    const CosseratCurve<Space>& curve) {
  std::vector<typename Space::Rotation> out;
  out.reserve(grid.vertices());
  for (int j = 0; j < grid.vertices(); ++j) out.push_back(vertex_frame(grid, curve, j));
  return out;
}

/// Refuses a turn that the measure loses (Linn, note 9): 2π for `log`, since a quaternion says so
/// much and no more; π for the others. `j` names the place.
inline void check_turn(const Quaternion& W, int j, Measure measure) {
  if (measure == Measure::log)
    require(W.w() > 0 || W.vec().norm() > 5e-7, "frames[", j,
            "]: turned by 2 pi from its neighbour, so that the axis of the turn is lost; use the "
            "other sign of the quaternion, or more edges");
  else
    require(W.w() > 5e-10, "frames[", j, "]: turned by pi or more from its neighbour, which the ",
            name(measure),
            " measure cannot tell; use measure log, the other sign of the "
            "quaternion, or more edges");
}

}  // namespace pyrod
