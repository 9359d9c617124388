// SPDX-License-Identifier: BSD-3-Clause
/// \file The linearisation of a problem at a state, and its factor: what Newton's steps are made
/// of.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/multipliers.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/shifted_factor.hpp>
#include <pyrod/solve/workspace.hpp>

#include <optional>
#include <utility>

namespace pyrod {

/// In storage that is given back when it is no longer used, see `Leased`.
template <Problem P>
class Tangent {
 public:
  using State = typename P::State;
  using Storage = Workspace<LinearisationOf<P>, State>;

  /// `problem` must stay where it is.
  explicit Tangent(const P& problem)
      : problem_(problem),
        weights_(problem.weights()),
        softness_(problem.softness()),
        workspace_(problem),
        here_(storage().here),
        factor_(storage().factor) {}
  Tangent(const Tangent&) = delete;
  Tangent& operator=(const Tangent&) = delete;

  Storage& storage() { return *workspace_; }
  const LinearisationOf<P>& here() const { return here_; }
  const Vector& gradient() const { return here_.gradient; }
  ShiftedFactor& factor() { return factor_; }
  const ShiftedFactor& factor() const { return factor_; }
  const Multipliers& multipliers() const { return factor_.multipliers(); }
  /// Whether there are multipliers.
  bool constrained() const { return multipliers().count() > 0; }
  const Vector& sizes() { return storage().sizes; }

  void linearise(const State& x, Hessian kind) {
    problem_.linearise(x, kind, here_);
    if (constrained()) problem_.multiplier_sizes(x, storage().sizes);
    factor_.renew(softness_, storage().sizes);
    rounding_known_ = false;
    firm_.reset();
  }

  static double largest(const Vector& v) { return v.template lpNorm<Eigen::Infinity>(); }
  double residual() const { return largest(here_.gradient); }
  /// Of the constraints, an energy.
  double gap() const { return multipliers().squared_norm(here_.gradient); }
  /// The constraints hold so well that the multipliers are not about to change much.
  bool met() const { return multipliers().largest(here_.gradient) <= 1e-6; }

  /// What rounding alone may leave of the gradient at x, where this was linearised.
  const Vector& rounding(const State& x) {
    if (!rounding_known_) problem_.rounding(x, storage().rounding);
    rounding_known_ = true;
    return storage().rounding;
  }

  /// Overwrites v = K⁻¹ b by what the tangent at x, which is not symmetric, gives for it.
  void correct(const State& x, Vector& v) {
    factor_.correct_skew([&](const Vector& a, Vector& out) { problem_.multiply_skew(x, a, out); },
                         v);
  }

  /// Of what was linearised last. `last`: whether the factor is of a state a short step before, and
  /// nothing was added to it: it tells the index, unless multipliers have changed. `tiny`: that
  /// step; after another one only if nothing is so soft that it may have changed sides meanwhile.
  int index(bool last, bool tiny) {
    if (last && !constrained() && !factor_.adds() && factor_.index() == 0 && (tiny || firm()))
      return 0;
    factor_.factorise(0);
    if (!factor_.broken() && factor_.index() == 0) return 0;
    return confirmed_index(factor_);
  }

  /// The lowest mode, weighed by the weights.
  Mode lowest_mode() { return pyrod::lowest_mode(factor_, weights_, problem_.unit_energy()); }

  /// The softest mode, to first sight: two inverse iterations bring it out if it is soft, one
  /// without stiffness with the eigenvalue of the shift. Its eigenvalue is relative to the
  /// stiffness. None where nothing is.
  std::optional<Mode> soft_mode() {
    if (firm()) return std::nullopt;
    factor_.factorise(0);
    if (factor_.broken()) return std::nullopt;
    return inverse_iteration(factor_, factor_.stiffness(), 0, 2, false);
  }

  /// The step that rounding of the gaps at x may ask for: what multipliers are uncertain by.
  const Vector& rounding_step(const State& x) {
    auto &gaps = storage().trial, &step = storage().δ;
    gaps.setZero();
    for (const int k : multipliers().rows()) gaps[k] = rounding(x)[k] / 4;
    factor_.factorise(0);
    factor_.solve(gaps, step);
    return step;
  }

 private:
  /// Whether one inverse iteration, with the factor of the last step if nothing was added to it,
  /// sees nothing soft.
  bool firm() {
    if (!firm_)
      firm_ = !factor_.adds() && first_quotient(factor_, storage().trial, storage().dual) > 0.1;
    return *firm_;
  }

  const P& problem_;
  decltype(std::declval<const P&>().weights()) weights_;
  decltype(std::declval<const P&>().softness()) softness_;
  Leased<P, Storage> workspace_;
  LinearisationOf<P>& here_;
  ShiftedFactor& factor_;
  bool rounding_known_ = false;
  std::optional<bool> firm_;
};

}  // namespace pyrod
