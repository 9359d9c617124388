// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method where constraints hold: multipliers make every equilibrium a saddle. It
/// knows no rods.
///
/// A step is one that leads to a minimum on the constraints exactly if the matrix has one negative
/// pivot for each multiplier; if it has not, the primal rows are shifted until it has. Progress is
/// measured by the augmented Lagrangian with the new multipliers, or by the next simplified step.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/solve/anchor.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/saddle_tests.hpp>
#include <pyrod/solve/saddle_workspace.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/solve/workspace.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace pyrod {

template <Constrained P>
class SaddleNewton {
 public:
  using State = typename P::State;

  /// `minimum`: whether steps must lead to minima; otherwise to any equilibrium.
  explicit SaddleNewton(const P& problem, Options options = {}, Trace trace = {},
                        bool minimum = true)
      : problem_(problem),
        minimum_(minimum),
        options_(options),
        trace_(std::move(trace)),
        weights_(problem.weights()),
        softness_(problem.softness()),
        workspace_(problem),
        here_((*workspace_).here),
        factor_((*workspace_).factor),
        multipliers_(factor_.multipliers()),
        tests_(problem, multipliers_),
        from_((*workspace_).from),
        δ_((*workspace_).δ),
        primal_((*workspace_).primal),
        dual_((*workspace_).dual),
        trial_((*workspace_).trial),
        sizes_((*workspace_).sizes),
        rounding_((*workspace_).rounding) {
    options_.check();
  }
  SaddleNewton(const SaddleNewton&) = delete;
  SaddleNewton& operator=(const SaddleNewton&) = delete;

  void set(const Options& options) { options_ = options; }

  /// `first`: the Hessian of the first step. `estimate`: the multipliers of `start` mean nothing,
  /// and those that come nearest to balancing it are taken first. `anchored`: see
  /// `Anchor`.
  Result<State> solve(State start, Hessian first = Hessian::convex, bool estimate = false,
                      bool anchored = false) {
    x_ = std::move(start);
    kind_ = first;
    anchor_.drop(anchored, δ_.size());
    Result<State> result;
    result.record.reserve(std::size_t(std::min(options_.max_iterations, 64)));
    linearise();
    if (estimate) estimate_multipliers();
    result.status = iterate(result);
    result.state = std::move(x_);
    result.energy = here_.energy;
    result.residual = residual();
    result.index = result.converged() && problem_.conservative() ? final_index() : -1;
    return result;
  }

  /// The lowest mode, weighed by the weights, at the state that was solved for last.
  Mode lowest_mode() { return pyrod::lowest_mode(factor_, weights_, problem_.unit_energy()); }

  /// The softest mode at the state that was solved for last, to first sight: two inverse iterations
  /// bring it out if it is soft, one without stiffness with the eigenvalue of the shift. Its
  /// eigenvalue is relative to the stiffness.
  std::optional<Mode> soft_mode() {
    factor_.factorise(0);
    if (factor_.broken()) return std::nullopt;
    return inverse_iteration(factor_, factor_.stiffness(), 0, 2, false);
  }

  /// The step that rounding of the gaps may ask for, at the state that was solved for last: what
  /// multipliers are uncertain by.
  const Vector& rounding_step() {
    trial_.setZero();
    for (const int k : multipliers_.rows()) trial_[k] = rounding_here()[k] / 4;
    factor_.factorise(0);
    factor_.solve(trial_, δ_);
    return δ_;
  }

  /// Entries of the factor over those of the matrix: the fill.
  double fill() const { return factor_.fill(); }

 private:
  /// Whether steps lead downhill on the constraints.
  bool downhill() const { return problem_.conservative() && (minimum_ || factor_.index() == 0); }

  /// The last factor is of the state before the last step, whose multipliers may have been others.
  int final_index() {
    factor_.factorise(0);
    if (!factor_.broken() && factor_.index() == 0) return 0;
    return confirmed_index(factor_);
  }
  double residual() const { return largest(here_.gradient); }
  static double largest(const Vector& v) { return v.template lpNorm<Eigen::Infinity>(); }

  void linearise() {
    problem_.linearise(x_, kind_, here_);
    problem_.multiplier_sizes(x_, sizes_);
    factor_.renew(softness_, sizes_);
    rounding_known_ = false;
  }

  void split_step() {
    primal_ = δ_;
    multipliers_.set(0, primal_);
  }

  /// The multipliers' part of a step that the gaps of the constraints do not ask for.
  void estimate_multipliers() {
    factor_.factorise(1);
    if (multipliers_.count() == 0 || factor_.broken()) return;
    trial_ = -here_.gradient;
    multipliers_.set(0, trial_);
    factor_.solve(trial_, δ_);
    multipliers_.copy(δ_, dual_);
    std::swap(x_, from_);
    problem_.move(from_, dual_, x_);
    linearise();
  }

  Status iterate(Result<State>& result) {
    if (!std::isfinite(here_.energy)) return Status::not_finite;
    double before = std::numeric_limits<double>::infinity();  // the step
    int reopened = 0;                                         // times that the last step left a gap
    while (result.iterations() < options_.max_iterations) {
      Iteration now{kind_, here_.energy, residual(), 0, 1, 0, 0};
      if (!find_step(now)) return Status::not_finite;
      const bool exact = kind_ == Hessian::exact;
      const bool tiny = exact && !has_shift(now) && !anchor_.holds() &&
                        now.step <= options_.tolerance && met() && settled(now) &&
                        tests_.accurate(here_, x_, δ_, rounding_here(), trial_);
      // where a mode is soft, steps still improve on a residual that could be rounding
      const bool at_rounding = exact && rounded();
      const bool last = tiny || (at_rounding && now.step > before / 2);
      const bool found = last && !tiny ? true : search(now, tiny) || at_rounding;
      before = now.step;
      if (now.fraction == 1) anchor_.weaken(now.step);
      result.record.push_back(now);
      const bool go_on = !trace_ || trace_(now);
      if (last && (tests_.closed(here_.gradient, rounding_here()) || reopened++ == 2))
        return Status::converged;
      if (!found) return Status::stalled;
      if (!std::isfinite(here_.energy)) return Status::not_finite;
      if (!go_on) return Status::interrupted;
    }
    return Status::out_of_iterations;
  }

  static bool has_shift(const Iteration& now) { return now.shift != 0; }

  /// δ, of which the primal part may be cut and the multipliers are always taken whole.
  bool find_step(Iteration& now) {
    factorise(anchor_.weight(), now);
    now.shift = 0;
    const bool potential = problem_.conservative();
    if (std::isfinite(now.step) && kind_ == Hessian::exact &&
        (!potential || falls_short(now.step <= options_.tolerance)))
      correct_step(now);
    if (std::isfinite(now.step) && (!potential || !minimum_ || factor_.index() == 0 ||
                                    now.step <= options_.tolerance || rounded()))
      return true;
    double σ = 1e-3;
    for (int i = 0; i < 40; ++i, σ *= 4) {
      factorise(σ, now);
      if (std::isfinite(now.step) && factor_.index() == 0) return true;
    }
    return false;
  }

  bool falls_short(bool last) {
    return tests_.falls_short(factor_, δ_, last ? &rounding_here() : nullptr);
  }

  /// The step that leaves none of the gaps open.
  void correct_step(Iteration& now) {
    if (problem_.conservative())
      trial_ = -pull(), factor_.correct(trial_, δ_);
    else
      correct(x_, δ_);
    split_step();
    now.step = δ_.allFinite() ? largest(primal_) : std::numeric_limits<double>::infinity();
  }

  /// Overwrites v = K⁻¹ b by what the tangent at x, which is not symmetric, gives for it.
  void correct(const State& x, Vector& v) {
    factor_.correct_skew([&](const Vector& a, Vector& out) { problem_.multiply_skew(x, a, out); },
                         v);
  }

  /// δ = −(K + σ U)⁻¹ g, U the stiffness.
  void factorise(double σ, Iteration& now) {
    factor_.factorise(σ);
    ++now.factorisations;
    now.shift = σ * problem_.unit_energy();
    now.step = std::numeric_limits<double>::infinity();
    if (factor_.broken()) return;
    factor_.solve(pull(), δ_);
    δ_ = -δ_;
    split_step();
    if (δ_.allFinite()) now.step = largest(primal_);
  }

  const Vector& pull() { return anchor_.pull(here_.gradient, factor_.stiffness()); }

  bool rounded() { return tests_.rounded(here_.gradient, rounding_here()); }

  bool settled(const Iteration& now) const {
    return now.step <= 1e-3 * options_.tolerance || tests_.settled(δ_, sizes_);
  }

  const Vector& rounding_here() {
    if (!rounding_known_) problem_.rounding(x_, rounding_);
    rounding_known_ = true;
    return rounding_;
  }

  /// The constraints hold so well that the multipliers are not about to change much.
  bool met() const { return multipliers_.largest(here_.gradient) <= 1e-6; }
  double gap() const { return multipliers_.squared_norm(here_.gradient); }

  bool search(Iteration& now, bool tiny) {
    const Merit before =
        downhill() && !tiny ? tests_.merit(here_, δ_, primal_, dual_, trial_) : Merit{0, 0, 0};
    const double magnitude = here_.magnitude;
    const double length = primal_.norm();
    anchor_.leave();
    std::swap(x_, from_);
    now.fraction = kind_ == Hessian::exact ? std::min(1., options_.trust / now.step) : 1;
    for (; now.fraction > 1e-6; now.fraction /= 2) {
      if (tiny || now.fraction * now.step < options_.near) kind_ = Hessian::exact;
      trial_ = now.fraction * primal_;
      multipliers_.copy(δ_, trial_);
      problem_.move(from_, trial_, x_);
      linearise();
      anchor_.reach(now.fraction, primal_);
      if (tiny) return true;
      if (!std::isfinite(here_.energy)) continue;
      const double rounding = 1e-13 * (magnitude + here_.magnitude);
      const double value = here_.energy + before.ν / 2 * gap();
      if (downhill() && value <= before.value + 1e-4 * now.fraction * before.slope + rounding)
        return true;
      if (!has_shift(now) && (contracts(now, length) || settles(now))) return true;
    }
    std::swap(x_, from_);
    linearise();
    anchor_.go_back();
    return false;
  }

  /// A small step that halves the residual: where a mode is so soft that rounding moves the state
  /// along it, steps do not tell.
  bool settles(const Iteration& now) const {
    return now.fraction * now.step < 1e-2 && residual() <= now.residual / 2;
  }

  /// The Newton step at the new state, measured with the old matrix, is shorter.
  bool contracts(const Iteration& now, double length) {
    if (!here_.gradient.allFinite()) return false;
    factor_.solve(pull(), trial_);
    if (now.kind == Hessian::exact && !problem_.conservative()) correct(from_, trial_);
    multipliers_.set(0, trial_);
    return trial_.norm() <= (1 - now.fraction / 4) * length;
  }

  const P& problem_;
  bool minimum_;
  Options options_;
  Trace trace_;
  decltype(std::declval<const P&>().weights()) weights_;
  decltype(std::declval<const P&>().softness()) softness_;
  Leased<P, SaddleWorkspace<LinearisationOf<P>, State>> workspace_;
  LinearisationOf<P>& here_;
  ShiftedFactor& factor_;
  const Multipliers& multipliers_;
  SaddleTests<P> tests_;
  State x_, &from_;
  Vector &δ_, &primal_, &dual_, &trial_, &sizes_, &rounding_;  ///< see `SaddleWorkspace`
  Anchor anchor_;
  bool rounding_known_ = false;
  Hessian kind_ = Hessian::convex;
};

}  // namespace pyrod
