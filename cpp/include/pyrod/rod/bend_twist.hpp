// SPDX-License-Identifier: BSD-3-Clause
/// \file Bending and twisting energy of one vertex cell, Linn (49), with gradient and Hessian.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>

#include <type_traits>

namespace pyrod {

/// ½ Δs (K − K0)·C(K − K0) as a function of the frames a before and b behind the vertex.
template <class Space, class Real = double>
struct TurnJet {
  using Block = Mat<Space::spin, Space::spin, Real>;
  Real energy;
  Spin<Space, Real> a, b;  ///< gradient
  Block aa, ab, bb;        ///< Hessian: ∂²/∂φ_a∂φ_a, ∂²/∂φ_a∂φ_b, ∂²/∂φ_b∂φ_b
};

/// `u` = 2 log W is the turn at the vertex, k = C/Δs the stiffness against it, `rest` = Δs K0 the
/// turn at rest.
template <Hessian, class Real>
TurnJet<Planar, Real> bend_twist(const std::type_identity_t<Vec<1, Real>>& u,
                                 const PlanarLogDifferentialOf<Real>&,
                                 const std::type_identity_t<Vec<1, Real>>& stiffness,
                                 const std::type_identity_t<Vec<1, Real>>& rest) {
  const Real k = stiffness[0], strain = u[0] - rest[0], m = k * strain;
  using One = Mat<1, 1, Real>;
  using Vector1 = Vec<1, Real>;
  return {m * strain / Real(2), Vector1(-m), Vector1(m), One(k), One(-k), One(k)};
}

/// The same in space.
///
/// With du = T φ_b − Tᵀφ_a and m = k (u − rest) the gradient is (−T m, Tᵀ m). The
/// Hessian is Tᵀ k T, T k Tᵀ and −T k T plus, if exact, what the change of T adds. With
/// T = d I + ½[u] + c u uᵀ all of it collapses, as theory (6) tells, to the vectors u, m, k u and
/// their products with u,
/// and the blocks share their parts (α and M come with the change of T):
///   bb, aa = B − Q ± O,   ab = −(B + Q) + M + [r],
///   B = d² k + α I + u eᵀ + e uᵀ,   O = ½ d (k [u] − [u] k) + u oᵀ + o uᵀ,
///   Q = ¼ [u] k [u],   M = ¼ ([u] [m] + [m] [u]) = ¼ (u mᵀ + m uᵀ) − ½ u·m I.
template <Hessian kind, class Real>
TurnJet<Spatial, Real> bend_twist(const std::type_identity_t<Vec<3, Real>>& u,
                                  const LogDifferentialOf<Real>& dlog,
                                  const std::type_identity_t<Vec<3, Real>>& k,
                                  const std::type_identity_t<Vec<3, Real>>& rest) {
  using Vector3 = Vec<3, Real>;
  const Real c = dlog.c(), θ2 = dlog.θ2(), d = 1 - c * θ2;
  const Vector3 strain = u - rest, m = k.cwiseProduct(strain);
  const Vector3 ku = k.cwiseProduct(u), uxku = u.cross(ku), uxm = u.cross(m);
  const Real um = u.dot(m), uku = u.dot(ku);
  const Vector3 mean = d * m + c * um * u;  // ½ (T + Tᵀ) m

  TurnJet<Spatial, Real> jet;
  jet.energy = m.dot(strain) / 2;
  jet.a = -mean - uxm / 2;
  jet.b = mean - uxm / 2;

  Real α = 0;
  Vector3 e = c * d * ku + (c * c / 2 * uku) * u;
  Vector3 o = -c / 2 * uxku;
  Vector3 r = -c / 2 * u.cross(uxku);
  for (int i = 0; i < 3; ++i) r[i] -= d / 2 * (k[(i + 1) % 3] + k[(i + 2) % 3]) * u[i];
  if constexpr (kind == Hessian::exact) {
    const Real slope = dlog.slope();
    α = um * (c * d - 0.25);
    e += (0.25 - c - (c * c + slope) * θ2) / 2 * m + ((2 * c * c + slope) / 2 * um) * u;
    o -= c / 2 * uxm;
    r += (0.25 - 3 * c + (c * c - slope) * θ2) / 2 * uxm - c * um * u + m / 2;
  }

  for (int i = 0; i < 3; ++i) {  // entry (i, i), then (j, l) and (l, j), where a cross product is ∓
    const int j = (i + 1) % 3, l = (i + 2) % 3;
    const Real Bii = d * d * k[i] + α + 2 * u[i] * e[i], Oii = 2 * u[i] * o[i];
    const Real Qii = -(k[j] * u[l] * u[l] + k[l] * u[j] * u[j]) / 4;
    jet.bb(i, i) = Bii - Qii + Oii;
    jet.aa(i, i) = Bii - Qii - Oii;
    jet.ab(i, i) = -(Bii + Qii);

    const Real B = u[j] * e[l] + e[j] * u[l], Q = k[i] * u[j] * u[l] / 4;
    const Real O = u[j] * o[l] + o[j] * u[l] - d / 2 * (k[j] - k[l]) * u[i];
    jet.bb(j, l) = jet.bb(l, j) = B - Q + O;
    jet.aa(j, l) = jet.aa(l, j) = B - Q - O;
    jet.ab(j, l) = -(B + Q) - r[i];
    jet.ab(l, j) = -(B + Q) + r[i];

    if constexpr (kind == Hessian::exact) {
      const Real M = (u[j] * m[l] + m[j] * u[l]) / 4;
      jet.ab(i, i) -= (u[j] * m[j] + u[l] * m[l]) / 2;
      jet.ab(j, l) += M;
      jet.ab(l, j) += M;
    }
  }
  return jet;
}

/// From C = (EI1, EI2, GJ) or EI2 at the vertex and its rest curvature K0.
template <Hessian kind, class Differential, int N>
auto bend_twist(const Vec<N>& u, const Differential& dlog, const Vec<N>& C, const Vec<N>& K0,
                double Δs) {
  return bend_twist<kind>(u, dlog, C / Δs, Δs * K0);
}

}  // namespace pyrod
