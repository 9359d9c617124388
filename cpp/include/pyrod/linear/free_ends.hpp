// SPDX-License-Identifier: BSD-3-Clause
/// \file The last half cell of an end that turns freely, theory (10): how it changes with the
/// moment on it.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rod/tension.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/end_turn.hpp>

#include <Eigen/LU>

#include <utility>
#include <vector>

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
  Block by_total;                  ///< −δw: of what else acts in the half cell
  /// Tendons in it, and how their lengths grow with w.
  std::vector<std::pair<int, Spin<Space>>> tendons;
  Block of_edge, of_turn;  ///< the frame's turn: of the edge's, of δw
  Spin<Space> M;           ///< moment on the end, in the edge's frame, or following

  FreeEnd(const Rod<Space>& rod, const Loads<Space>& loads, const CellTerms<Space>& terms,
          int number, bool at_start, const Rotation& q)
      : start(at_start), follows(!at_start && !loads.follower_end_moment.isZero(0)) {
    const int j = start ? 0 : rod.edges();
    const double sign = start ? -1 : 1;
    length = rod.grid.Δs(j);
    k = rod.bending[j] / length;
    rest = sign * length * rod.K0[j];
    M = follows ? loads.follower_end_moment
                : rotate_spin(q.conjugate(), start ? loads.start_moment : loads.end_moment);
    w = turn_of_end<Space>(terms, rod, number, start ? End::start : End::end, M, follows);
    m = k.cwiseProduct(w - rest);
    TurnPotential<Space> others;
    terms.for_each_tendon(number, j, start ? CellKind::behind : CellKind::before,
                          Spin<Space>(sign * w), [&](int i, double T, const auto& tendon) {
                            add_tension<Space>(T, tendon, others);
                            tendons.emplace_back(i, sign * tendon.slope);
                          });
    linearise(sign * others.m, others.k);
  }

 private:
  /// dead: T m = M; following: Tᵀ m = M.
  void linearise(const Spin<Space>& other_m, const Block& other_k) {
    const Spin<Space> all = m + other_m;
    const typename Space::Differential dlog(w);
    Block T = dlog.T();
    Block slope = dlog.N(all) - spin_skew(all) / 2;
    if (follows) T.transposeInPlace(), slope += spin_skew(all);
    slope += T * k.asDiagonal();
    slope += T * other_k;
    by_moment = slope.inverse();
    by_total = by_moment * T;
    by_k = -by_moment * T * (w - rest).asDiagonal();
    by_rest = by_moment * T * k.asDiagonal();
    of_turn = turn_differential(w);
    const auto back = exp(Spin<Space>(-w));
    for (int i = 0; i < spin; ++i)
      of_edge.col(i) = rotate_spin(back, Spin<Space>(Spin<Space>::Unit(i)));
  }
};

}  // namespace pyrod
