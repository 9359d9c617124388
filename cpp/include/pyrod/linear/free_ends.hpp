// SPDX-License-Identifier: BSD-3-Clause
/// \file The last half cell of an end that turns freely, theory (10): how it changes with the
/// moment on it.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>

#include <Eigen/LU>

namespace pyrod {

inline Mat3 turn_differential(const Vec3& u) { return exp_differential(u); }
inline Mat<1> turn_differential(const Vec1&) { return Mat<1>::Identity(); }

/// The end of a rod is its edge's frame, turned on by w: at the end of the rod w is the turn of the
/// half cell, at its start what the half cell would turn back.
template <class Space>
struct FreeEnd {
  static constexpr int spin = Space::spin;
  using Block = Mat<spin>;
  using Rotation = typename Space::Rotation;

  bool start, follows;
  double length;
  Spin<Space> k, rest, w, m;       ///< rest: as w counts
  Block by_moment, by_k, by_rest;  ///< δw: of the moment as the law has it, and of k and rest
  Block of_edge, of_turn;          ///< the frame's turn: of the edge's, of δw
  Spin<Space> M;                   ///< moment on the end, in the edge's frame, or following

  FreeEnd(const Rod<Space>& rod, const Loads<Space>& loads, bool at_start, const Rotation& q)
      : start(at_start), follows(!at_start && !loads.follower_end_moment.isZero(0)) {
    const int j = start ? 0 : rod.edges();
    const double sign = start ? -1 : 1;
    length = rod.grid.Δs(j);
    k = rod.bending[j] / length;
    rest = sign * length * rod.K0[j];
    M = follows ? loads.follower_end_moment
                : rotate_spin(q.conjugate(), start ? loads.start_moment : loads.end_moment);
    const Spin<Space> K0 = sign * rod.K0[j];
    w = follows ? turn_under_moment_behind<Space>(M, rod.bending[j], K0, length)
                : turn_under_moment<Space>(M, rod.bending[j], K0, length);
    m = k.cwiseProduct(w - rest);
    linearise();
  }

 private:
  /// dead: T m = M; following: Tᵀ m = M.
  void linearise() {
    const typename Space::Differential dlog(w);
    Block T = dlog.T();
    Block slope = dlog.N(m) - spin_skew(m) / 2;
    if (follows) T.transposeInPlace(), slope += spin_skew(m);
    slope += T * k.asDiagonal();
    by_moment = slope.inverse();
    by_k = -by_moment * T * (w - rest).asDiagonal();
    by_rest = by_moment * T * k.asDiagonal();
    of_turn = turn_differential(w);
    const auto back = exp(Spin<Space>(-w));
    for (int i = 0; i < spin; ++i)
      of_edge.col(i) = rotate_spin(back, Spin<Space>(Spin<Space>::Unit(i)));
  }
};

}  // namespace pyrod
