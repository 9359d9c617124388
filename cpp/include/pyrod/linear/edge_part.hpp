// SPDX-License-Identifier: BSD-3-Clause
/// \file How the terms of an edge, theory (8), change with its section force and its numbers, and
/// what these changes are the transposes of.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// A rotation vector from the components of a frame to space, and back.
inline Vec3 spin_to_space(const Mat3& R, const Vec3& m) { return R * m; }
inline Vec1 spin_to_space(const Mat<2>&, const Vec1& m) { return m; }
inline Vec3 spin_to_frame(const Mat3& R, const Vec3& m) { return R.transpose() * m; }
inline Vec1 spin_to_frame(const Mat<2>&, const Vec1& m) { return m; }

/// One edge under its section force n, b = Rᵀn.
template <class Space>
struct EdgePart {
  static constexpr int dim = Space::dim;
  using P = Point<Space>;
  using Turn = Spin<Space>;

  Mat<dim> R;
  P b, S;
  double h;

  EdgePart(const typename Space::Rotation& q, const P& n, const P& compliance, double length)
      : R(matrix(q)), b(R.transpose() * n), S(compliance), h(length) {}

  P Γ() const { return axis<Space>() + S.cwiseProduct(b); }

  /// Of a section force, and of a turn: b × φ.
  P δb(const P& δn) const { return R.transpose() * δn; }
  P δb_of_turn(const Turn& φ) const { return skew(b) * φ; }
  P δΓ(const P& δb, const P& δS) const { return S.cwiseProduct(δb) + b.cwiseProduct(δS); }

  /// h (δb × Γ + b × δΓ) + δh b × Γ, theory (31).
  Turn moment(const P& δb, const P& δΓ, double δh) const {
    const P Γ = this->Γ();
    return h * (cross(δb, Γ) + cross(b, δΓ)) + δh * cross(b, Γ);
  }
  /// The reach h R Γ.
  P reach(const Turn& φ, const P& δΓ, double δh) const {
    const P Γ = this->Γ();
    return R * (h * (δΓ - skew(Γ) * φ) + δh * Γ);
  }
  double energy(const P& δb, const P& δS, double δh) const {
    return (h / 2) * b.dot(2 * S.cwiseProduct(δb) + δS.cwiseProduct(b)) + δh * energy_density();
  }
  double energy_density() const { return b.dot(S.cwiseProduct(b)) / 2; }

  /// Transposes: `m` weighs a moment, `r` a reach, `g` a strain, `e` the energy.
  P of_force(const Turn& m) const { return h * (skew(Γ()) * m - S.cwiseProduct(P(skew(b) * m))); }
  P of_force(const P& r, const P& g, double e) const {
    return S.cwiseProduct(P(h * (R.transpose() * r) + g + (e * h) * b));
  }
  Turn of_turn(const P& r, const P& δb) const {
    return cross(Γ(), P(h * (R.transpose() * r))) + cross(δb, b);
  }
  P of_compliance(const Turn& m, const P& r, const P& g, double e) const {
    return b.cwiseProduct(P(h * (R.transpose() * r - skew(b) * m) + g + (e * h / 2) * b));
  }
  double of_length(const Turn& m, const P& r, double e) const {
    const P Γ = this->Γ();
    return m.dot(cross(b, Γ)) + r.dot(R * Γ) + e * energy_density();
  }
};

}  // namespace pyrod
