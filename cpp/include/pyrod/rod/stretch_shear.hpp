// SPDX-License-Identifier: BSD-3-Clause
/// \file Stretching and shearing energy of one edge, Linn (51), with gradient and Hessian in (r,
/// q).
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>

#include <cmath>

namespace pyrod {

/// ½ h (Γ − e3)·C (Γ − e3) as a function of (r_{j-1}, q_{j-1/2}, r_j), in this order.
template <class Space>
struct EdgeEnergyJet {
  static constexpr int dim = Space::dim, spin = Space::spin, size = 2 * dim + spin;
  double energy;
  Vec<size> gradient;
  Mat<size> hessian;
};

/// `C` = (GA1, GA2, EA) or (GA1, EA), where it stores energy.
template <class Space>
EdgeEnergyJet<Space> stretch_shear(const Point<Space>& r_a, const Point<Space>& r_b,
                                   const typename Space::Rotation& frame, const Point<Space>& C,
                                   double h) {
  constexpr int dim = Space::dim, spin = Space::spin;
  const Mat<dim> R = matrix(frame);
  const Point<Space> Γ = R.transpose() * (r_b - r_a) / h;
  const Point<Space> strain = Γ - axis<Space>(), b = C.cwiseProduct(strain);
  const Point<Space> n = R * b;
  const Mat<dim, spin> dΓ = skew(Γ), db = C.asDiagonal() * dΓ;  // for a turn φ of the frame

  EdgeEnergyJet<Space> jet;
  jet.energy = h / 2 * b.dot(strain);
  jet.gradient << -n, h * cross(b, Γ), n;

  const Mat<dim> rr = R * C.asDiagonal() * R.transpose() / h;
  const Mat<dim, spin> rq = R * (db - skew(b));
  Mat<spin> qq = dΓ.transpose() * db;
  qq.diagonal().array() -= b.dot(Γ);
  if constexpr (spin == 3) qq += (Γ * b.transpose() + b * Γ.transpose()) / 2;
  jet.hessian << rr, -rq, -rr,                  //
      -rq.transpose(), h * qq, rq.transpose(),  //
      -rr, rq, rr;
  return jet;
}

}  // namespace pyrod
