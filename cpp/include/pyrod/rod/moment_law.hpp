// SPDX-License-Identifier: BSD-3-Clause
/// \file The moment that a vertex cell transmits, and the turn that a given moment makes.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/turn_potential.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <Eigen/LU>

namespace pyrod {

/// M = T m with m = C (u/Δs − K0): the moment from the edge behind on the edge before the vertex,
/// in the components of the frame before. It is what the energy of the cell exerts, exactly.
template <class Space>
Spin<Space> transmitted_moment(const Spin<Space>& u, const Spin<Space>& C, const Spin<Space>& K0,
                               double Δs) {
  const Spin<Space> m = C.cwiseProduct(u / Δs - K0);
  return typename Space::Differential(u).T() * m;
}

/// The inverse: the turn u at which the cell transmits M. Newton, from the turn that M would make
/// if moments did not change direction within the cell.
template <class Space>
Spin<Space> turn_under_moment(const Spin<Space>& M, const Spin<Space>& C, const Spin<Space>& K0,
                              double Δs) {
  const Spin<Space> k = C / Δs;
  Spin<Space> u = Δs * (K0 + M.cwiseQuotient(C));
  if constexpr (Space::spin == 3) {
    for (int i = 0; i < 30; ++i) {
      const LogDifferential dlog(u);
      const Vec3 m = k.cwiseProduct(u - Δs * K0);
      const Mat3 T = dlog.T();
      Mat3 slope = T * k.asDiagonal();
      slope += dlog.N(m) - skew(m) / 2;
      const Vec3 δ = slope.inverse() * (M - T * m);
      u += δ;
      if (!(δ.norm() > 1e-15 * (1 + u.norm()))) break;
    }
  }
  return u;
}

/// The turn u at which the cell transmits a moment that is M in the components of the frame behind:
/// Tᵀ m = M, theory (10).
template <class Space>
Spin<Space> turn_under_moment_behind(const Spin<Space>& M, const Spin<Space>& C,
                                     const Spin<Space>& K0, double Δs) {
  return -turn_under_moment<Space>(-M, C, -K0, Δs);
}

/// A law seen from the other end of its cell.
template <class Space, class Law>
auto mirrored(const Law& law) {
  return [law](const Spin<Space>& u) {
    auto ψ = law(Spin<Space>(-u));
    ψ.m = -ψ.m;
    return ψ;
  };
}

/// The same under any law u ↦ ψ, from a turn that is near.
template <class Space, class Law>
Spin<Space> turn_under_moment(const Spin<Space>& M, const Law& law, Spin<Space> u) {
  for (int i = 0; i < 50; ++i) {
    const typename Space::Differential dlog(u);
    const TurnPotential<Space> ψ = law(u);
    Mat<Space::spin> slope = dlog.T() * ψ.k + dlog.N(ψ.m) - spin_skew(ψ.m) / 2;
    const Spin<Space> δ = slope.inverse() * (M - dlog.T() * ψ.m);
    u += δ;
    if (!(δ.norm() > 1e-15 * (1 + u.norm()))) break;
  }
  return u;
}
template <class Space, class Law>
Spin<Space> turn_under_moment_behind(const Spin<Space>& M, const Law& law, const Spin<Space>& u) {
  return -turn_under_moment<Space>(Spin<Space>(-M), mirrored<Space>(law), Spin<Space>(-u));
}

}  // namespace pyrod
