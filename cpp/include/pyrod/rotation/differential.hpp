// SPDX-License-Identifier: BSD-3-Clause
/// \file First derivatives of exp, log and the Cayley map, and what Hessians need of the second.
///
/// Increments are material (they multiply on the right): R ← R exp(φ).
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/series.hpp>
#include <pyrod/rotation/spatial.hpp>

namespace pyrod {

/// D with exp(u + du) = exp(u) exp(D du): D = I − versinc [u] + sine_defect [u]².
inline Mat3 exp_differential(const Vec3& u) {
  const double θ = u.norm();
  const Mat3 U = skew(u);
  return Mat3::Identity() - versinc(θ) * U + sine_defect(θ) * U * U;
}

/// C with cayley(q + dq) = cayley(q) exp(C dq).
inline Mat3 cayley_differential(const Vec3& q) {
  const double x = q.squaredNorm(), scale = 1 / (1 + x);
  return 4 * scale * scale * ((1 - x) * Mat3::Identity() - 2 * skew(q) + 2 * q * q.transpose());
}

/// C⁻¹: dq for a material increment of cayley(q).
inline Mat3 inverse_cayley_differential(const Vec3& q) {
  const double x = q.squaredNorm();
  return ((1 - x) * Mat3::Identity() + 2 * skew(q) + 2 * q * q.transpose()) / 4;
}

/// The differential of the logarithm at one turn u, theory (4), and its derivative.
///
/// For W = exp(u), log(W exp(φ)) = u + T φ + …, with T = I + ½[u] + c[u]² = D⁻¹; an increment from
/// the left enters with Tᵀ, since exp(φ) W = W exp(Wᵀφ) and T Wᵀ = Tᵀ.
template <class Real>
class LogDifferentialOf {
 public:
  LogDifferentialOf() = default;
  explicit LogDifferentialOf(const Vec<3, Real>& u)
      : u_(u), θ2_(u.squaredNorm()), coefficients_(log_coefficients_of_square(θ2_)) {}

  const Real& c() const { return coefficients_.c; }
  const Real& slope() const { return coefficients_.slope; }
  const Real& θ2() const { return θ2_; }

  Mat<3, 3, Real> T() const {  // [u]² = u uᵀ − θ² I, written out
    const Real c = coefficients_.c, d = 1 - c * θ2_;
    const Vec<3, Real> h = u_ / 2, cu = c * u_;
    const Real xy = cu.x() * u_.y(), xz = cu.x() * u_.z(), yz = cu.y() * u_.z();
    Mat<3, 3, Real> T;
    T << d + cu.x() * u_.x(), xy - h.z(), xz + h.y(),  //
        xy + h.z(), d + cu.y() * u_.y(), yz - h.x(),   //
        xz - h.y(), yz + h.x(), d + cu.z() * u_.z();
    return T;
  }

  /// The derivative of [u]²-terms at fixed m; for any du,
  ///   d(Tᵀ m) = (N + ½[m]) du,  d(T m) = (N − ½[m]) du:  theory (5).
  Mat<3, 3, Real> N(const Vec<3, Real>& m) const {
    const Real um = u_.dot(m), c = coefficients_.c;
    Mat<3, 3, Real> N = (coefficients_.slope * (um * u_ - θ2_ * m) - 2 * c * m) * u_.transpose();
    N += (c * u_) * m.transpose();
    N.diagonal().array() += c * um;
    return N;
  }

 private:
  Vec<3, Real> u_;
  Real θ2_ = 0;
  LogCoefficients<Real> coefficients_{};
};
using LogDifferential = LogDifferentialOf<double>;

/// The plane is commutative: T = 1 and its derivative vanishes.
template <class Real>
class PlanarLogDifferentialOf {
 public:
  PlanarLogDifferentialOf() = default;
  explicit PlanarLogDifferentialOf(const Vec<1, Real>&) {}
  Mat<1> T() const { return Mat<1>::Identity(); }
  Mat<1> N(const Vec1&) const { return Mat<1>::Zero(); }
};
using PlanarLogDifferential = PlanarLogDifferentialOf<double>;

}  // namespace pyrod
