// SPDX-License-Identifier: BSD-3-Clause
/// \file What an edge adds to the statics when its section force is known (theory (8) and (9)).
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>

#include <cmath>

namespace pyrod {

/// −h (b·e3 + ½ b·S b) with b = Rᵀn, as a function of the edge's frame.
template <class Space, class Real = double>
struct EdgeJet {
  Real energy;
  Spin<Space, Real> gradient;
  Mat<Space::spin, Space::spin, Real> hessian;
};

/// Stiffness against turning from the direction of the force, theory (12): moment over angle. Never
/// negative.
template <class Space, class Real = double>
Real secant_stiffness(const Point<Space, Real>& b, const Spin<Space, Real>& moment) {
  using std::sqrt, std::max;
  const Point<Space, Real> e3 = axis<Space, Real>();
  const Spin<Space, Real> lever = cross(b, e3);
  const Real along = b[Space::dim - 1], sine = sqrt(lever.squaredNorm()), ψ = angle(sine, along);
  const Real stiffness = select(sine == Real(0), along, lever.dot(moment) / (sine * ψ));
  return max(Real(0), stiffness);
}

/// Γ·b I − ½ (Γ bᵀ + b Γᵀ) − [b]ᵀ S [b] for a diagonal S, per unit length.
template <class Real>
Mat<3, 3, Real> force_stiffness(const Vec<3, Real>& b, const Vec<3, Real>& Γ,
                                const Vec<3, Real>& S) {
  Mat<3, 3, Real> H;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    H(i, i) = Γ[j] * b[j] + Γ[k] * b[k] - (S[j] * b[k] * b[k] + S[k] * b[j] * b[j]);
    H(j, k) = H(k, j) = S[i] * b[j] * b[k] - (Γ[j] * b[k] + b[j] * Γ[k]) / 2;
  }
  return H;
}

template <class Real>
Mat<1, 1, Real> force_stiffness(const Vec<2, Real>& b, const Vec<2, Real>& Γ,
                                const Vec<2, Real>& S) {
  return Mat<1, 1, Real>(Γ.dot(b) - (S[0] * b[1] * b[1] + S[1] * b[0] * b[0]));
}

/// `S`: the diagonal of the compliance.
template <Hessian kind, class Space, class Real>
EdgeJet<Space, Real> edge_term(const typename Space::template RotationOf<Real>& frame,
                               const Point<Space, Real>& n, const Point<Space, Real>& S,
                               const Real& h) {
  using Block = Mat<Space::spin, Space::spin, Real>;
  const Point<Space, Real> e3 = axis<Space, Real>(), b = unrotate(frame, n),
                           strain = S.cwiseProduct(b), Γ = e3 + strain;
  const Spin<Space, Real> moment = cross(b, Γ);

  EdgeJet<Space, Real> jet{-h * b.dot(e3 + strain / 2), h * moment, Block::Zero()};
  if constexpr (kind == Hessian::convex) {
    jet.hessian.diagonal().setConstant(h * secant_stiffness<Space, Real>(b, moment));
    if constexpr (Space::spin == 3) jet.hessian(2, 2) = 0;
  } else {
    jet.hessian = h * force_stiffness(b, Γ, S);
  }
  return jet;
}

}  // namespace pyrod
