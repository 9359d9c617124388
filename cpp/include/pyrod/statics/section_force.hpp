// SPDX-License-Identifier: BSD-3-Clause
/// \file What an edge adds to the statics when its section force is known (docs/theory.md, §3).
#pragma once

#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/model.hpp>

namespace pyrod {

/// −h (b·e3 + ½ b·S b) with b = Rᵀn, as a function of the edge's frame.
template <class Space>
struct EdgeJet {
  double energy;
  Spin<Space> gradient;
  Mat<Space::spin> hessian;
};

/// Stiffness against turning away from the direction of the force: moment over angle. Never
/// negative.
template <class Space>
double secant_stiffness(const Point<Space>& b, const Spin<Space>& moment) {
  const Point<Space> e3 = axis<Space>();
  const Spin<Space> lever = cross(b, e3);
  const double sine = lever.norm(), ψ = std::atan2(sine, b.dot(e3));
  if (sine == 0) return ψ == 0 ? std::max(0., b.dot(e3)) : 0;
  return std::max(0., lever.dot(moment) / (sine * ψ));
}

/// Γ·b I − ½ (Γ bᵀ + b Γᵀ) − [b]ᵀ S [b] for a diagonal S, per unit length.
inline Mat3 force_stiffness(const Vec3& b, const Vec3& Γ, const Vec3& S) {
  Mat3 H;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    H(i, i) = Γ[j] * b[j] + Γ[k] * b[k] - (S[j] * b[k] * b[k] + S[k] * b[j] * b[j]);
    H(j, k) = H(k, j) = S[i] * b[j] * b[k] - (Γ[j] * b[k] + b[j] * Γ[k]) / 2;
  }
  return H;
}

inline Mat<1> force_stiffness(const Vec2& b, const Vec2& Γ, const Vec2& S) {
  return Mat<1>(Γ.dot(b) - (S[0] * b[1] * b[1] + S[1] * b[0] * b[0]));
}

template <Curvature kind, class Space, class Model>
EdgeJet<Space> section_force_term(const typename Space::Rotation& frame, const Point<Space>& n,
                                  const Compliance<Space, Model>& compliance, double h) {
  using Block = Mat<Space::spin>;
  const Point<Space> e3 = axis<Space>(), S = compliance.diagonal();
  const Point<Space> b = unrotate(frame, n), strain = S.cwiseProduct(b), Γ = e3 + strain;
  const Spin<Space> moment = cross(b, Γ);

  EdgeJet<Space> jet{-h * b.dot(e3 + strain / 2), h * moment, Block::Zero()};
  if constexpr (kind == Curvature::convex) {
    const double k = h * secant_stiffness<Space>(b, moment);
    jet.hessian.diagonal().setConstant(k);
    if constexpr (Space::spin == 3) jet.hessian(2, 2) = 0;
  } else {
    jet.hessian = h * force_stiffness(b, Γ, S);
  }
  return jet;
}

}  // namespace pyrod
