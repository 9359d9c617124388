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

/// Stiffness against turning away from the direction of the force: moment over angle. Never negative.
template <class Space>
double secant_stiffness(const Point<Space>& b, const Spin<Space>& moment) {
  const Point<Space> e3 = axis<Space>();
  const Spin<Space> lever = cross(b, e3);
  const double sine = lever.norm(), ψ = std::atan2(sine, b.dot(e3));
  if (sine == 0) return ψ == 0 ? std::max(0., b.dot(e3)) : 0;
  return std::max(0., lever.dot(moment) / (sine * ψ));
}

template <Curvature kind, class Space, class Model>
EdgeJet<Space> section_force_term(const typename Space::Rotation& frame, const Point<Space>& n,
                                  const Compliance<Space, Model>& S, double h) {
  using Block = Mat<Space::spin>;
  const Point<Space> e3 = axis<Space>();
  const Point<Space> b = unrotate(frame, n), strain = S * b, Γ = e3 + strain;
  const Spin<Space> moment = cross(b, Γ);

  EdgeJet<Space> jet{-h * b.dot(e3 + strain / 2), h * moment, Block::Zero()};
  if constexpr (kind == Curvature::convex) {
    const double k = h * secant_stiffness<Space>(b, moment);
    jet.hessian.diagonal().setConstant(k);
    if constexpr (Space::spin == 3) jet.hessian(2, 2) = 0;
  } else {
    jet.hessian.diagonal().setConstant(Γ.dot(b));
    if constexpr (Space::spin == 3)
      jet.hessian -= (Γ * b.transpose() + b * Γ.transpose()) / 2;
    if constexpr (S.components > 0) jet.hessian -= S.form(b);
    jet.hessian *= h;
  }
  return jet;
}

}  // namespace pyrod
