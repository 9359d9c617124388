// SPDX-License-Identifier: BSD-3-Clause
/// \file The factor of a saddle's matrix K with a little added to its diagonal, and solutions as if
/// nothing were added to the multipliers' rows. It knows no rods.
///
/// LDLᵀ without pivoting breaks where a part turns freely (a primal row), or where nothing gives
/// way to a multiplier. Where that may be, or has been, there is always a shift, far below what
/// matters. What it gives the multipliers' rows, D, is no small thing where the true give is
/// smaller still; what it leaves of K x = b, namely D x, is known without any work, and is taken
/// away where it counts.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/multipliers.hpp>
#include <pyrod/solve/skew_solver.hpp>
#include <pyrod/sparse/ldlt.hpp>
#include <pyrod/sparse/symmetric.hpp>

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace pyrod {

class ShiftedFactor {
 public:
  /// `K` must stay where it is. `stiffness`: of the primal rows; multipliers have none. `always`:
  /// the part of it that is added in any case.
  ShiftedFactor(SymmetricMatrix& K, Vector stiffness, const Vector& units, double always = least_)
      : K_(K),
        stiffness_(std::move(stiffness)),
        always_(always),
        multipliers_(K, stiffness_, units),
        factor_(K),
        soft_(Vector::Zero(stiffness_.size())) {}

  const SymmetricMatrix& matrix() const { return K_; }
  const Vector& stiffness() const { return stiffness_; }
  const Multipliers& multipliers() const { return multipliers_; }

  /// Another matrix of the same pattern, with the same multipliers, is in the place of K.
  void reuse(const Vector& stiffness, const Vector& units, double always) {
    stiffness_ = stiffness;
    always_ = always;
    multipliers_.renew(units);
    factorised_.reset();
  }

  /// K has changed. `softness` over `sizes` is what multipliers give at the least.
  void renew(const Vector& softness, const Vector& sizes) {
    for (const int k : multipliers_.rows()) soft_[k] = -softness[k] / sizes[k];
    factorised_.reset();
  }

  /// Factorises K + (σ + always) diag(stiffness) + D.
  void factorise(double σ) {
    if (factorised_ == σ) return;
    if (σ != 0 || adds() || !as_it_is()) factorise(σ, stiffness_);
    factorised_ = σ;
  }

  /// From now on something is always added: a mode has no stiffness.
  void soften() {
    always_ = std::max(always_, least_);
    factorised_.reset();
  }

  /// Whether something is always added.
  bool adds() const { return always_ > 0 || multipliers_.count() > 0; }

  /// Factorises K + λ diag(weights) + always diag(stiffness) + D.
  void factorise(double λ, const Vector& weights) {
    factorised_.reset();
    added_ = λ * weights + always_ * stiffness_;
    shift_ = added_ + soft_;
    inertia_ = factor_.factorise(K_, shift_);
  }

  /// Negative eigenvalues on the constraints of what is factorised, theory (18).
  int index() const { return inertia_.negative - multipliers_.count(); }
  bool broken() const { return inertia_.broken > 0; }

  void solve(const Vector& b, Vector& x) { factor_.solve(b, x); }
  /// Overwrites columns, all at once.
  void solve(Eigen::MatrixXd& columns) { factor_.solve(columns); }

  /// What D leaves of a multiplier's row k of K x = b.
  double left(const Vector& x, int k) const { return soft_[k] * x[k]; }

  /// Overwrites x, which the factor gives for b, by the solution without D: by refinement, else
  /// by GMRES.
  template <std::same_as<Vector> V>
  void correct(const V& b, V& x) {
    if (refined(b, x)) return;
    factor_.solve(b, x);
    correct_skew([](const Vector& v, Vector& out) { out.setZero(v.size()); }, x);
  }

  /// The same of K + Z, where `skew(v, out)` gives Z v; by GMRES.
  template <class Skew>
  void correct_skew(const Skew& skew, Vector& x) {
    const auto difference = [&](const Vector& v, Vector& out) {
      skew(v, out);
      for (const int k : multipliers_.rows()) out[k] -= soft_[k] * v[k];
    };
    corrected(difference, x);
  }

  /// All that is added to K in what is factorised.
  const Vector& shift() const { return shift_; }

  /// Overwrites x, which the factor gives for some b, by the solution of (K + Z) x = b, without
  /// anything that is added, where `rest(v, out)` gives Z v; by GMRES.
  template <class Rest>
  void correct_all(const Rest& rest, Vector& x) {
    const auto difference = [&](const Vector& v, Vector& out) {
      rest(v, out);
      out -= shift_.cwiseProduct(v);
    };
    corrected(difference, x);
  }

  std::size_t bytes() const {
    return factor_.bytes() + std::size_t(7 * stiffness_.size()) * sizeof(double);
  }

  /// Entries of the factor over those of the matrix: the fill.
  double fill() const { return double(factor_.factor_entries()) / double(K_.rows.size()); }

 private:
  template <class Difference>
  void corrected(const Difference& difference, Vector& x) {
    const auto solve_it = [this](const Vector& b, Vector& out) { factor_.solve(b, out); };
    SkewCorrected(solve_it, difference, x.size()).correct(x);
  }

  static constexpr double least_ = 1e-6;  ///< of the stiffness: what is added where K alone breaks

  /// Factorises K alone, if that can be.
  bool as_it_is() {
    inertia_ = factor_.factorise();
    shift_ = Vector::Zero(stiffness_.size());
    if (!broken()) return true;
    soften();
    return false;
  }

  /// Whether the residuals of K fell fast.
  bool refined(const Vector& b, Vector& x) {
    const auto size = [](const Vector& v) { return v.template lpNorm<Eigen::Infinity>(); };
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 12; ++i) {
      K_.multiply(x, left_);
      left_ += added_.cwiseProduct(x);
      left_ = b - left_;
      factor_.solve(left_, left_);
      const double now = size(left_);
      if (!(now <= 0.3 * before)) return now <= 1e-12 * size(x);
      x += left_;
      if (now <= 1e-16 * size(x)) return true;
      before = now;
    }
    return false;  // too slow to have come to an end
  }

  SymmetricMatrix& K_;
  Vector stiffness_;
  double always_;
  Multipliers multipliers_;
  Ldlt factor_;
  Inertia inertia_;
  std::optional<double> factorised_;  ///< the σ with which K is factorised
  Vector soft_;                       ///< D
  Vector added_, shift_, left_;
};

}  // namespace pyrod
