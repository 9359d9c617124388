// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method where constraints hold: multipliers make every equilibrium a saddle. It
/// knows no rods.
///
/// A step is one that leads to a minimum on the constraints exactly if the matrix has one negative
/// pivot for each multiplier; if it has not, the primal rows are shifted until it has. Progress is
/// measured by the augmented Lagrangian with the new multipliers, or by the next simplified step.
#pragma once

#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/newton.hpp>

#include <optional>

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
        here_(problem.linearisation()),
        multipliers_(here_.hessian, weights_),
        factor_(here_.hessian),
        δ_(Vector::Zero(here_.gradient.size())),
        primal_(δ_),
        dual_(δ_),
        trial_(δ_) {
    options_.check();
  }
  SaddleNewton(const SaddleNewton&) = delete;
  SaddleNewton& operator=(const SaddleNewton&) = delete;

  void set(const Options& options) { options_ = options; }

  /// `first`: the Hessian of the first step. `estimate`: the multipliers of `start` mean nothing,
  /// and those that come nearest to balancing it are taken first.
  Result<State> solve(State start, Curvature first = Curvature::convex, bool estimate = false) {
    x_ = std::move(start);
    curvature_ = first;
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

  /// The lowest eigenvalue λ of K v = λ M v on the constraints, and its mode, at the state that was
  /// solved for last. By inverse iteration behind a shift at which the inertia says that no
  /// eigenvalue is left below; the shift is halved towards it.
  Mode lowest_mode() {
    double above = 0;
    factorise(0);
    if (index() > 0) {
      double below = 0;
      for (above = problem_.unit_energy(); factorise(above), index() > 0; above *= 4) below = above;
      for (int i = 0; i < 12; ++i) {
        const double middle = (below + above) / 2;
        factorise(middle);
        (index() > 0 ? below : above) = middle;
      }
      factorise(above);
    }
    return inverse_iteration(here_.hessian, factor_, weights_, multipliers_, above, 100);
  }

  /// The softest mode at the state that was solved for last, to first sight: two inverse iterations
  /// bring it out if it is soft, one without stiffness with the eigenvalue of the shift.
  std::optional<Mode> soft_mode() {
    factorise(0);
    if (inertia_.broken > 0) return std::nullopt;
    return inverse_iteration(here_.hessian, factor_, weights_, multipliers_, 0, 2);
  }

  /// Entries of the factor over those of the matrix: the fill.
  double fill() const {
    return double(factor_.factor_entries()) / double(here_.hessian.rows.size());
  }

 private:
  /// Whether steps lead downhill on the constraints.
  bool downhill() const { return problem_.conservative() && (minimum_ || index() == 0); }
  int index() const { return inertia_.negative - multipliers_.count(); }
  /// The last factor is of the state before the last step, whose multipliers may have been others.
  int final_index() { return factorise(0), index(); }
  double residual() const { return largest(here_.gradient); }
  static double largest(const Vector& v) { return v.template lpNorm<Eigen::Infinity>(); }

  void linearise() {
    problem_.linearise(x_, curvature_, here_);
    factorised_.reset();
  }

  void split_step() {
    primal_ = δ_;
    multipliers_.set(0, primal_);
  }

  /// The multipliers' part of a step that the gaps of the constraints do not ask for.
  void estimate_multipliers() {
    factorise(problem_.unit_energy());
    if (multipliers_.count() == 0 || inertia_.broken > 0) return;
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
    while (result.iterations() < options_.max_iterations) {
      Iteration now{curvature_, here_.energy, residual(), 0, 1, 0, 0};
      if (!find_step(now)) return Status::not_finite;
      const bool exact = curvature_ == Curvature::exact;
      const bool tiny =
          exact && !now.shift && now.step <= options_.tolerance && met() && accurate();
      // where a mode is soft, steps still improve on a residual that could be rounding
      const bool rounded = exact && now.residual <= problem_.rounding();
      const bool last = tiny || (rounded && now.step > before / 2);
      const bool found = last && !tiny ? true : search(now, tiny) || rounded;
      before = now.step;
      result.record.push_back(now);
      const bool go_on = !trace_ || trace_(now);
      if (last) return Status::converged;
      if (!found) return Status::stalled;
      if (!std::isfinite(here_.energy)) return Status::not_finite;
      if (!go_on) return Status::interrupted;
    }
    return Status::out_of_iterations;
  }

  /// δ, of which the primal part may be cut and the multipliers are always taken whole.
  bool find_step(Iteration& now) {
    factorise(0, now);
    const bool potential = problem_.conservative();
    if (std::isfinite(now.step) && curvature_ == Curvature::exact && !potential) {
      correct(x_, δ_);
      split_step();
      now.step = largest(primal_);
    }
    if (std::isfinite(now.step) &&
        (!potential || !minimum_ || index() == 0 || now.step <= options_.tolerance ||
         now.residual <= problem_.rounding()))
      return true;
    double σ = 1e-3 * problem_.unit_energy();
    for (int i = 0; i < 40; ++i, σ *= 4) {
      factorise(σ, now);
      if (std::isfinite(now.step) && index() == 0) return true;
    }
    return false;
  }

  /// Overwrites v = K⁻¹ b by what the tangent at x, which is not symmetric, gives for it.
  void correct(const State& x, Vector& v) {
    const auto skew = [&](const Vector& a, Vector& out) { problem_.multiply_skew(x, a, out); };
    SkewCorrected(factor_, skew, v.size()).correct(v);
  }

  /// δ = −(K + σ M)⁻¹ g, M the weights.
  void factorise(double σ, Iteration& now) {
    factorise(σ);
    ++now.factorisations;
    now.shift = σ;
    now.step = std::numeric_limits<double>::infinity();
    if (inertia_.broken > 0) return;
    factor_.solve(here_.gradient, δ_);
    δ_ = -δ_;
    split_step();
    if (δ_.allFinite()) now.step = largest(primal_);
  }

  /// Besides σ there is always a shift far below what matters: it keeps the factorisation from
  /// breaking where a part turns freely (primal rows), or cannot stretch and is straight
  /// (multipliers).
  void factorise(double σ) {
    if (factorised_ == σ) return;
    const double unit = problem_.unit_energy();
    shift_ = (σ + 1e-6 * unit) * weights_;
    multipliers_.set(-1e-10 * unit, shift_);
    inertia_ = factor_.factorise(here_.hessian, shift_);
    factorised_ = σ;
  }

  /// Whether the step does what the system asks of it. On the constraints by themselves, too: where
  /// they cannot be met, the multipliers grow until beside them no gap counts.
  bool accurate() {
    Vector& left = trial_;
    here_.hessian.multiply(δ_, left);
    left += here_.gradient;
    if (!problem_.conservative()) {
      Vector skew(δ_.size());
      problem_.multiply_skew(x_, δ_, skew);
      left += skew;
    }
    return largest(left) <= 1e-2 * residual() + problem_.rounding() &&
           multipliers_.largest(left) <= 1e-2 * std::sqrt(gap()) + problem_.rounding();
  }

  /// The augmented Lagrangian along the step, with multipliers that are new already: its value and
  /// slope at the start, and the weight ν of the constraints that makes the slope negative.
  struct Merit {
    double value, slope, ν;
  };

  Merit merit() {
    Vector& change = trial_;  // of the gradient, by the multipliers
    multipliers_.copy(δ_, dual_);
    multipliers_.multiply(here_.hessian, dual_, change);
    double value = here_.energy, gap = 0;
    for (const int k : multipliers_.rows()) {
      const double g = here_.gradient[k];
      value += δ_[k] * (g + change[k] / 2);
      gap += (g + change[k]) * (g + change[k]);
    }
    const double slope = here_.gradient.dot(primal_) + change.dot(primal_);
    const double ν = std::max(10 / problem_.unit_energy(), gap > 0 ? 2 * slope / gap : 0.);
    return {value + ν / 2 * gap, slope - ν * gap, ν};
  }

  /// The constraints hold so well that the multipliers are not about to change much.
  bool met() const { return std::sqrt(gap()) <= 1e-6 * problem_.unit_energy(); }
  double gap() const { return multipliers_.squared_norm(here_.gradient); }

  bool search(Iteration& now, bool tiny) {
    const Merit before = downhill() && !tiny ? merit() : Merit{0, 0, 0};
    const double magnitude = here_.magnitude;
    const double length = primal_.norm();
    std::swap(x_, from_);
    now.fraction = curvature_ == Curvature::exact ? std::min(1., options_.trust / now.step) : 1;
    for (; now.fraction > 1e-6; now.fraction /= 2) {
      if (tiny || now.fraction * now.step < options_.near) curvature_ = Curvature::exact;
      trial_ = now.fraction * primal_;
      multipliers_.copy(δ_, trial_);
      problem_.move(from_, trial_, x_);
      linearise();
      if (tiny) return true;
      if (!std::isfinite(here_.energy)) continue;
      const double rounding = 1e-13 * (magnitude + here_.magnitude);
      const double value = here_.energy + before.ν / 2 * gap();
      if (downhill() && value <= before.value + 1e-4 * now.fraction * before.slope + rounding)
        return true;
      if (now.shift == 0 && (contracts(now, length) || settles(now))) return true;
    }
    std::swap(x_, from_);
    linearise();
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
    factor_.solve(here_.gradient, trial_);
    if (now.curvature == Curvature::exact && !problem_.conservative()) correct(from_, trial_);
    multipliers_.set(0, trial_);
    return trial_.norm() <= (1 - now.fraction / 4) * length;
  }

  const P& problem_;
  bool minimum_;
  Options options_;
  Trace trace_;
  Vector weights_;
  LinearisationOf<P> here_;
  Multipliers multipliers_;
  Cholesky factor_;
  Inertia inertia_;
  std::optional<double> factorised_;  ///< the shift with which `here_` is factorised
  State x_, from_;
  Vector δ_, primal_, dual_;  ///< the step, without the multipliers, and of these alone
  Vector trial_, shift_;
  Curvature curvature_ = Curvature::convex;
};

}  // namespace pyrod
