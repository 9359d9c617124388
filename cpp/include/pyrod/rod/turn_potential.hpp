// SPDX-License-Identifier: BSD-3-Clause
/// \file A vertex cell with any potential of its turn, with gradient and Hessian: the general form
/// of `bend_twist`, which is quicker for the diagonal law.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// ψ(u), or a part of it: what it is at one turn.
template <class Space>
struct TurnPotential {
  double energy = 0;
  Spin<Space> m = Spin<Space>::Zero();            ///< ψ'
  Mat<Space::spin> k = Mat<Space::spin>::Zero();  ///< ψ'', symmetric
};

/// As a function of the frames a and b beside the vertex, theory (32). Convex: without k and all
/// that the change of T adds. It is for what is added to the diagonal law, whose stiffness is
/// enough for a first step.
template <Hessian kind>
TurnJet<Planar> turn_potential(const Vec1&, const TurnPotential<Planar>& ψ) {
  using One = Mat<1>;
  const One k = kind == Hessian::exact ? ψ.k : One(One::Zero());
  return {ψ.energy, Vec1(-ψ.m), ψ.m, k, One(-k), k};
}

template <Hessian kind>
TurnJet<Spatial> turn_potential(const Vec3& u, const TurnPotential<Spatial>& ψ) {
  const LogDifferential dlog(u);
  const Mat3 T = dlog.T();
  TurnJet<Spatial> jet{ψ.energy,     Vec3(-T * ψ.m), Vec3(T.transpose() * ψ.m),
                       Mat3::Zero(), Mat3::Zero(),   Mat3::Zero()};
  if constexpr (kind == Hessian::exact) {
    const Mat3 N = dlog.N(ψ.m), M = skew(ψ.m) / 2;
    const Mat3 before = T * ψ.k - M + N, behind = T.transpose() * ψ.k + M + N;
    const auto symmetric = [](const Mat3& A) -> Mat3 { return (A + A.transpose()) / 2; };
    jet.bb = symmetric(behind * T);
    jet.aa = symmetric(before * T.transpose());
    jet.ab = -before * T;
  }
  return jet;
}

}  // namespace pyrod
