// SPDX-License-Identifier: BSD-3-Clause
/// \file Bending and twisting energy of one vertex cell, Linn (49), with gradient and Hessian.
#pragma once

#include <pyrod/core/curvature.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// ½ Δs (K − K0)·C(K − K0) as a function of the frames a before and b behind the vertex. Of the
/// symmetric blocks the upper triangle is filled.
template <class Space>
struct TurnJet {
  double energy;
  Spin<Space> a, b;             ///< gradient
  Mat<Space::spin> aa, ab, bb;  ///< Hessian: ∂²/∂φ_a∂φ_a, ∂²/∂φ_a∂φ_b, ∂²/∂φ_b∂φ_b
};

/// `u` = 2 log W is the turn at the vertex, `C` = EI2 there, `K0` its rest curvature.
template <Curvature>
TurnJet<Planar> bend_twist(const Vec1& u, const PlanarLogDifferential&, const Vec1& C,
                           const Vec1& K0, double Δs) {
  const double k = C[0] / Δs, strain = u[0] - Δs * K0[0], m = k * strain;
  using One = Mat<1>;
  return {m * strain / 2, Vec1(-m), Vec1(m), One(k), One(-k), One(k)};
}

/// `u` = 2 log W is the turn at the vertex, `C` = (EI1, EI2, GJ) there, `K0` its rest curvature.
///
/// With du = T φ_b − Tᵀφ_a and m = C (u/Δs − K0) the gradient is (−T m, Tᵀ m). The Hessian is
/// Tᵀ (C/Δs) T, and so on, plus what the change of T adds; that part is written here in closed form:
/// T has u as eigenvector, so all its products with m collapse to the vectors u, m and u × m.
template <Curvature kind>
TurnJet<Spatial> bend_twist(const Vec3& u, const LogDifferential& dlog, const Vec3& C,
                            const Vec3& K0, double Δs) {
  const Mat3 T = dlog.T();
  const Vec3 k = C / Δs, strain = u - Δs * K0, m = k.cwiseProduct(strain);

  TurnJet<Spatial> jet;
  jet.energy = m.dot(strain) / 2;
  jet.a = -(T * m);
  jet.b = T.transpose() * m;
  const Mat3 kT = k.asDiagonal() * T, kTt = k.asDiagonal() * T.transpose();
  for (int i = 0; i < 3; ++i) {
    for (int l = 0; l < 3; ++l) jet.ab(i, l) = -T.row(i).dot(kT.col(l));
    for (int l = i; l < 3; ++l) {
      jet.bb(i, l) = T.col(i).dot(kT.col(l));
      jet.aa(i, l) = T.row(i).dot(kTt.col(l));
    }
  }
  if constexpr (kind == Curvature::exact) {
    const double c = dlog.c(), slope = dlog.slope(), θ2 = dlog.θ2(), um = u.dot(m);
    const Vec3 w = u.cross(m);
    const Vec3 even = ((0.25 - c - (c * c + slope) * θ2) * m + (2 * c * c + slope) * um * u) / 2;
    const Vec3 pb = even - c / 2 * w, pa = even + c / 2 * w;
    const double α = um * (c * (1 - c * θ2) - 0.25);
    for (int i = 0; i < 3; ++i) {
      for (int l = i; l < 3; ++l) {
        jet.bb(i, l) += u[i] * pb[l] + pb[i] * u[l];
        jet.aa(i, l) += u[i] * pa[l] + pa[i] * u[l];
      }
      jet.bb(i, i) += α;
      jet.aa(i, i) += α;
    }
    // −((N + ½[m]) Tᵀ)ᵀ = −(c u·m T + ¼ u·m I − ½ (1 − cθ²)[m] + (c T m − ¼ m) uᵀ + u vᵀ)
    const Vec3 left = m / 4 + c * jet.a;
    const Vec3 v = slope * (θ2 * m - um * u) + 2 * c * m + c / 2 * w;
    jet.ab += left * u.transpose() + u * v.transpose() - c * um * T;
    jet.ab += (0.5 - c * θ2 / 2) * skew(m);
    jet.ab.diagonal().array() -= um / 4;
  }
  return jet;
}

}  // namespace pyrod
