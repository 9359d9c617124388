// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method on a manifold, with or without constraints. It knows no rods.
///
/// Far from a solution steps are made with the convex Hessian, near it with the exact one; the full
/// step is tried first and nearly always taken (docs/theory.md, "The solver"). A step leads to a
/// minimum on the constraints exactly if the matrix has one negative pivot for each multiplier; if
/// it has not, the primal rows are shifted until it has. Progress is measured by the augmented
/// Lagrangian with the new multipliers, which without any is the energy, or by the next simplified
/// step. Included by newton.hpp, with the definitions of steps and of the search along them.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/anchor.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/multipliers.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/result.hpp>
#include <pyrod/solve/shifted_factor.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/solve/step_tests.hpp>
#include <pyrod/solve/tangent.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

namespace pyrod {

template <Problem P>
class Newton {
 public:
  using State = typename P::State;

  /// `minimum`: whether steps must lead to minima; otherwise to any equilibrium.
  explicit Newton(const P& problem, const Options& options = {}, Trace trace = {},
                  bool minimum = true);
  Newton(const Newton&) = delete;
  Newton& operator=(const Newton&) = delete;

  void set(const Options& options) { options_ = options; }

  /// `first`: the Hessian of the first step; exact when the start is known to be near. `estimate`:
  /// the multipliers of `start` mean nothing, and those that come nearest to balancing it are taken
  /// first. `anchored`: see `Anchor`.
  Result<State> solve(State start, Hessian first = Hessian::convex, bool estimate = false,
                      bool anchored = false);

  /// Lets what is asked below be of x instead of the state that was solved for last.
  void look_at(const State& x);
  /// See `Tangent`.
  Mode lowest_mode();
  std::optional<Mode> soft_mode();
  const Vector& rounding_step(const State& x);
  /// Entries of the factor over those of the matrix: the fill.
  double fill() const { return factor_.fill(); }

 private:
  static constexpr std::size_t usual_iterations = 16;
  static constexpr double most_by_rounding = 1e-3;   ///< a longer step is one that has to be taken
  static constexpr double most_since_factor = 1e-3;  ///< a longer step needs a new factor

  const LinearisationOf<P>& here() const { return tangent_.here(); }
  void linearise() { tangent_.linearise(x_, kind_); }
  static double largest(const Vector& v) { return Tangent<P>::largest(v); }

  /// Whether steps lead downhill on the constraints.
  bool downhill() const { return problem_.conservative() && (minimum_ || factor_.index() == 0); }

  void split_step() {
    primal_ = δ_;
    multipliers_.set(0, primal_);
  }

  /// The multipliers' part of a step that the gaps of the constraints do not ask for.
  void estimate_multipliers() {
    factor_.factorise(1);
    if (factor_.broken()) return;
    trial_ = -here().gradient;
    multipliers_.set(0, trial_);
    factor_.solve(trial_, δ_);
    multipliers_.copy(δ_, dual_);
    std::swap(x_, from_);
    problem_.move(from_, dual_, x_);
    linearise();
  }

  Status iterate(Result<State>& result) {
    if (!std::isfinite(here().energy)) return Status::not_finite;
    double before = std::numeric_limits<double>::infinity();  // the step
    int reopened = 0;                                         // times that the last step left a gap
    while (result.iterations() < options_.max_iterations) {
      Iteration now{kind_, here().energy, tangent_.residual(), 0, 1, 0, 0, int(δ_.size())};
      bool tiny = reopened == 0 && find_last_step(now, result), at_rounding = false;
      away_ = tiny ? before : 0;
      if (!tiny) {
        if (!find_step(now)) return Status::not_finite;
        if (drifts(now, result)) {
          factor_.soften();
          if (!find_step(now)) return Status::not_finite;
        }
        tiny = is_last(now);
        // where a mode is soft, steps still improve on a residual that could be rounding
        at_rounding = now.kind == Hessian::exact && now.step <= most_by_rounding && rounded();
      }
      const bool last = tiny || (at_rounding && now.step > before / 2);
      const bool found =
          last && !tiny
              ? true
              : search(now, tiny || (small(now) && !tangent_.constrained())) || at_rounding;
      before = now.step;
      if (now.fraction == 1) anchor_.weaken(now.step);
      result.record.push_back(now);
      const bool go_on = !trace_ || trace_(now);
      if (last && (tests_.closed(here().gradient, tangent_.rounding(x_)) || reopened++ == 2))
        return Status::converged;
      if (!found) return Status::stalled;
      if (!std::isfinite(here().energy)) return Status::not_finite;
      if (!go_on) return Status::interrupted;
    }
    return Status::out_of_iterations;
  }

  bool small(const Iteration& now) const {
    return !has_shift(now) && !anchor_.holds() && now.step <= options_.tolerance;
  }

  /// Whether the step ends the solve, once it is taken.
  bool is_last(const Iteration& now) {
    return kind_ == Hessian::exact && small(now) && tangent_.met() && settled(now) &&
           tests_.accurate(here(), x_, δ_, tangent_.rounding(x_), trial_);
  }

  /// Whether the last step was a whole one of Newton's method itself.
  static bool was_whole(const Iteration& last) {
    return last.kind == Hessian::exact && last.fraction == 1 && !has_shift(last);
  }

  static bool has_shift(const Iteration& now) { return now.shift != 0; }

  /// Whether a step is no shorter than the one before, where each should be about the square of
  /// that: rounding, divided by next to no stiffness.
  bool drifts(const Iteration& now, const Result<State>& result) const {
    if (result.record.empty() || factor_.adds() || kind_ == Hessian::convex) return false;
    const Iteration& last = result.record.back();
    return was_whole(last) && last.step <= 1e-2 &&
           now.step > std::max(last.step / 2, options_.tolerance);
  }

  /// δ, of which the primal part may be cut and the multipliers are always taken whole. False if
  /// numbers fail.
  bool find_step(Iteration& now);
  /// The last step, with the factor of the state before, from which a short step has led
  /// here (docs/theory.md, "Stopping"). If it does not do, it is found as any other.
  bool find_last_step(Iteration& now, const Result<State>& result);
  /// Makes up for what the factor is off. `most`: what may be left of the error of δ [rad].
  bool refine_step(double most);
  /// A step that is not too long for what the exact Hessian can tell. A shift makes it shorter, and
  /// leads to a minimum; it is cut instead where constraints hold, which a shift would leave open,
  /// where the Hessian tells a part only, and where any equilibrium will do.
  bool usable(const Iteration& now) const;
  /// Of the stiffness; without constraints such that by itself it lets no step be much too long.
  double first_shift() const;
  bool falls_short(bool last) {
    return tests_.falls_short(factor_, δ_, last ? &tangent_.rounding(x_) : nullptr);
  }
  /// The step that leaves none of the gaps open.
  void correct_step(Iteration& now);
  /// δ = −(K + σ U)⁻¹ g, U the stiffness.
  void factorise(double σ, Iteration& now);

  const Vector& pull() { return anchor_.pull(here().gradient, factor_.stiffness()); }

  /// What is left could be rounding, of which the stiffest cells tell the size: of what is soft it
  /// says nothing, so that it counts only where something has to be added to the factor.
  bool rounded() {
    return factor_.adds() && tests_.rounded(here().gradient, tangent_.rounding(x_));
  }

  bool settled(const Iteration& now) {
    return now.step <= 1e-3 * options_.tolerance || tests_.settled(δ_, tangent_.sizes());
  }

  /// Full step first, then ever smaller ones until one is acceptable; a `tiny` one, which may
  /// change the energy by less than rounding does, needs no test. If none is, the state stays where
  /// it was.
  bool search(Iteration& now, bool tiny);
  /// Where the parabola through the two values and the slope has its minimum, within bounds.
  double shrink(double rise, double slope, double fraction) const;
  /// Where no potential tells, or rounding hides what it would. `length`: of the step; `slope`: the
  /// work of the forces along it, which need not grow if they are dead.
  bool improves(const Iteration& now, double length, double slope);
  /// A small step that halves the residual: where a mode is so soft that rounding moves the state
  /// along it, steps do not tell.
  bool settles(const Iteration& now) const;
  /// The Newton step at the new state, measured with the old matrix, is shorter.
  bool contracts(const Iteration& now, double length);

  const P& problem_;
  bool minimum_;
  Options options_;
  Trace trace_;
  Tangent<P> tangent_;
  ShiftedFactor& factor_;
  const Multipliers& multipliers_;
  StepTests<P> tests_;
  State x_, &from_;
  Vector &δ_, &primal_, &dual_, &trial_;  ///< see `Workspace`
  Anchor anchor_;
  Hessian kind_ = Hessian::convex;
  double away_ = 0;  ///< the step from the state of the factor to that before the last step
};

template <Problem P>
Newton<P>::Newton(const P& problem, const Options& options, Trace trace, bool minimum)
    : problem_(problem),
      minimum_(minimum),
      options_(options),
      trace_(std::move(trace)),
      tangent_(problem),
      factor_(tangent_.factor()),
      multipliers_(tangent_.multipliers()),
      tests_(problem, multipliers_),
      from_(tangent_.storage().from),
      δ_(tangent_.storage().δ),
      primal_(tangent_.storage().primal),
      dual_(tangent_.storage().dual),
      trial_(tangent_.storage().trial) {
  options_.check();
}

template <Problem P>
auto Newton<P>::solve(State start, Hessian first, bool estimate, bool anchored) -> Result<State> {
  x_ = std::move(start);
  kind_ = first;
  anchor_.drop(anchored, δ_.size());
  Result<State> result;
  result.record.reserve(usual_iterations);
  linearise();
  if (estimate && tangent_.constrained()) estimate_multipliers();
  result.status = iterate(result);
  result.energy = here().energy;
  result.residual = tangent_.residual();
  if (result.converged() && problem_.conservative())
    result.index = tangent_.index(!has_shift(result.record.back()) && !anchor_.holds(),
                                  away_ <= options_.tolerance);
  result.state = std::move(x_);
  return result;
}

template <Problem P>
void Newton<P>::look_at(const State& x) {
  tangent_.linearise(x, Hessian::exact);
  factor_.factorise(0);
}

template <Problem P>
auto Newton<P>::lowest_mode() -> Mode {
  return tangent_.lowest_mode();
}

template <Problem P>
auto Newton<P>::soft_mode() -> std::optional<Mode> {
  return tangent_.soft_mode();
}

template <Problem P>
auto Newton<P>::rounding_step(const State& x) -> const Vector& {
  return tangent_.rounding_step(x);
}

}  // namespace pyrod
