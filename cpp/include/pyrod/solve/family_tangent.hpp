// SPDX-License-Identifier: BSD-3-Clause
/// \file The linearisation of a family's problem at a state, its factor, and bordered systems with
/// it: what steps along a path are made of.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/bordered.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/neutral.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace pyrod {

template <Family F>
class FamilyTangent {
 public:
  using State = typename F::State;

  /// `family` must stay where it is.
  explicit FamilyTangent(F& family)
      : family_(family),
        here_(family.linearisation()),
        factor_(here_.hessian, family.stiffness(), family.units(), family.least_shift()),
        bordered_(factor_, neutral_),
        weights_(family.weights()),
        softness_(family.softness()),
        sizes_(Vector::Ones(weights_.size())),
        slope_(weights_.size()) {
    factor_.soften();
  }
  FamilyTangent(const FamilyTangent&) = delete;
  FamilyTangent& operator=(const FamilyTangent&) = delete;

  F& family() { return family_; }
  const Vector& weights() const { return weights_; }
  double product(const Vector& a, const Vector& b) const { return a.dot(weights_.cwiseProduct(b)); }
  double squared_norm(const Vector& v) const { return product(v, v); }
  const Vector& gradient() const { return here_.gradient; }
  const Vector& slope() const { return slope_; }
  bool conservative() const { return family_.conservative(); }

  /// The problem is that of λ; x, which is placed there, gets its gradient and Hessian.
  void look_at(State& x, double λ) {
    family_.set(λ);
    family_.place(x);
    at_ = &x;
    family_.linearise(x, Hessian::exact, here_);
  }
  void find_slope() { family_.slope(*at_, slope_); }

  /// Factorises what was looked at last, with `shift` times the stiffness added.
  void factorise(double shift) {
    if (factor_.multipliers().count() > 0) family_.multiplier_sizes(*at_, sizes_);
    factor_.renew(softness_, sizes_);
    factor_.factorise(shift);
    if (shift == 0) neutral_.renew(factor_, weights_);
  }
  /// From now on, steps take no part in motions that have no stiffness here.
  void judge_neutral() { neutral_.judge(family_.unit_energy()); }
  void look_for_neutral() { neutral_.look(factor_, weights_, family_.unit_energy()); }
  bool broken() const { return factor_.broken(); }
  /// −1: there is no potential.
  int index() const { return conservative() ? factor_.index() : -1; }

  void border(const Vector& column, const Vector& row, double corner) {
    bordered_.set(column, row, corner);
  }
  /// A step: with what was added to the factor, which costs steps no more than a hundredth of what
  /// they have to go, unless something has no potential.
  double step(const Vector& f, double h, Vector& x) {
    return conservative() ? bordered_.solve(f, h, x) : exactly(f, h, x);
  }
  double exactly(const Vector& f, double h, Vector& x) {
    return bordered_.solve_exactly([this](const Vector& v, Vector& out) { multiply(v, out); }, f, h,
                                   x);
  }
  /// (x, y) for the right-hand side (0, 1). `refined`: to what rounding leaves.
  double along(Vector& x, bool refined) {
    if (!conservative()) return exactly(Vector::Zero(weights_.size()), 1, x);
    double y = bordered_.solve_border(1, x);
    if (refined) bordered_.refine(x, y);
    return y;
  }

  /// Whether all of the gradient could be rounding.
  bool rounded() {
    family_.rounding(*at_, rounding_);
    return (here_.gradient.array().abs() <= rounding_.array()).all();
  }

  /// The softest mode of what is factorised; its eigenvalue has a sign.
  Mode soft_mode() { return inverse_iteration(factor_, weights_, 0, 12, false); }

  /// Largest component of the primal rows; infinite where numbers fail.
  double largest(const Vector& v) const {
    if (!v.allFinite()) return std::numeric_limits<double>::infinity();
    double most = 0;
    for (Eigen::Index i = 0; i < v.size(); ++i)
      if (weights_[i] != 0) most = std::max(most, std::abs(v[i]));
    return most;
  }

 private:
  void multiply(const Vector& v, Vector& out) const {
    if (conservative())
      out.setZero(v.size());
    else
      family_.multiply_skew(*at_, v, out);
  }

  F& family_;
  LinearisationOf<F> here_;
  ShiftedFactor factor_;
  Neutral neutral_;
  Bordered bordered_;
  Vector weights_, softness_, sizes_, slope_, rounding_;
  State* at_ = nullptr;
};

}  // namespace pyrod
