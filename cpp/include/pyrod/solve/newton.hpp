// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method on a manifold. It knows no rods.
///
/// Far from a solution steps are made with the convex Hessian, near it with the exact one; the full
/// step is tried first and nearly always taken (docs/theory.md, "The solver").
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/skew_solver.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/solve/workspace.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace pyrod {

template <class State>
struct Result {
  State state;
  Status status = Status::out_of_iterations;
  std::vector<Iteration> record;
  double energy = 0, residual = 0;  ///< at `state`
  int index =
      -1;  ///< negative eigenvalues of the Hessian, once converged; −1: unknown, or no potential

  int iterations() const { return int(record.size()); }
  bool converged() const { return status == Status::converged; }
};

template <Problem P>
class Newton {
 public:
  using State = typename P::State;

  explicit Newton(const P& problem, Options options = {}, Trace trace = {})
      : problem_(problem),
        options_(options),
        trace_(std::move(trace)),
        workspace_(problem),
        here_((*workspace_).here),
        factor_((*workspace_).factor),
        δ_((*workspace_).δ),
        trial_((*workspace_).trial),
        from_((*workspace_).from) {
    options_.check();
  }

  Newton(const Newton&) = delete;
  Newton& operator=(const Newton&) = delete;

  /// `first`: the Hessian of the first step; exact when the start is known to be near.
  Result<State> solve(State start, Hessian first = Hessian::convex) {
    x_ = std::move(start);
    kind_ = first;
    Result<State> result;
    result.record.reserve(usual_iterations);
    problem_.linearise(x_, kind_, here_);
    result.status = iterate(result);
    result.state = std::move(x_);
    result.energy = here_.energy;
    result.residual = residual();
    result.index = result.converged() && problem_.conservative() ? inertia_.negative : -1;
    return result;
  }

 private:
  static constexpr std::size_t usual_iterations = 16;

  Status iterate(Result<State>& result) {
    if (!std::isfinite(here_.energy)) return Status::not_finite;
    while (result.iterations() < options_.max_iterations) {
      Iteration now{kind_, here_.energy, residual(), 0, 1, 0, 0};
      if (!find_step(now)) return Status::not_finite;
      const bool tiny = now.shift == 0 && now.step <= options_.tolerance;
      const bool last = tiny && kind_ == Hessian::exact && accurate();
      const bool found = search(now, tiny);
      result.record.push_back(now);
      const bool go_on = !trace_ || trace_(now);
      if (!found) return Status::stalled;
      if (!std::isfinite(here_.energy)) return Status::not_finite;
      if (last) return Status::converged;
      if (!go_on) return Status::interrupted;
    }
    return Status::out_of_iterations;
  }

  double residual() const { return here_.gradient.template lpNorm<Eigen::Infinity>(); }

  /// The largest component, NaN if there is one.
  static double largest(const Vector& v) {
    return v.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>();
  }

  /// δ from the present linearisation: the Newton step, or a shifted one where the Hessian is no
  /// guide. False if numbers fail.
  bool find_step(Iteration& now) {
    factorise(0, now);
    if (trusted(now)) {
      if (kind_ == Hessian::exact && !problem_.conservative()) {
        correct_skew();
        now.step = largest(δ_);
      }
      if (trusted(now)) return true;
    }
    double σ = 0.3 * residual() / options_.trust;
    for (int i = 0; i < 60 && std::isfinite(σ); ++i, σ *= 3) {
      factorise(σ, now);
      if (trusted(now) && inertia_.negative == 0) return true;
    }
    return false;
  }

  /// δ = −(H + σI)⁻¹ g.
  void factorise(double σ, Iteration& now) {
    inertia_ = factor_.factorise(σ);
    ++now.factorisations;
    now.shift = σ;
    now.step = std::numeric_limits<double>::infinity();
    if (inertia_.broken > 0) return;
    factor_.solve(here_.gradient, δ_);
    δ_ = -δ_;
    now.step = largest(δ_);
  }

  /// A step below the tolerance is taken whatever the inertia: the state is an equilibrium already.
  /// Without a potential the inertia of the symmetric part decides nothing.
  bool trusted(const Iteration& now) const {
    if (!std::isfinite(now.step)) return false;
    if (kind_ == Hessian::convex || now.step <= options_.tolerance) return true;
    return now.step <= options_.trust && (inertia_.negative == 0 || !problem_.conservative());
  }

  void correct_skew() {
    SkewCorrected(
        factor_, [this](const Vector& v, Vector& w) { problem_.multiply_skew(x_, v, w); },
        δ_.size())
        .correct(δ_);
  }

  /// Whether δ solves its linear system, unless the forces are nothing beside what the Hessian
  /// makes of the tolerance: a factor without pivoting can be wrong without a word.
  bool accurate() {
    here_.hessian.multiply(δ_, trial_);
    trial_ += here_.gradient;
    if (!problem_.conservative()) {
      Vector skew(δ_.size());
      problem_.multiply_skew(x_, δ_, skew);
      trial_ += skew;
    }
    const double error = largest(trial_), bound = 1e-3 * residual();
    if (error <= bound) return true;
    const Eigen::Map<const Vector> H(here_.hessian.values.data(),
                                     Eigen::Index(here_.hessian.values.size()));
    return error <= bound + 1e-16 * options_.tolerance * H.template lpNorm<Eigen::Infinity>();
  }

  /// Full step first, then ever smaller ones until one is acceptable; a `tiny` one, which may
  /// change the energy by less than rounding does, needs no test. If none is, the state stays where
  /// it was.
  bool search(Iteration& now, bool tiny) {
    const double energy = here_.energy, magnitude = here_.magnitude;
    const double slope = here_.gradient.dot(δ_);
    std::swap(x_, from_);
    for (now.fraction = 1; now.fraction > 1e-8;) {
      if (tiny || now.fraction * now.step < options_.near) kind_ = Hessian::exact;
      if (now.fraction < 1) trial_ = now.fraction * δ_;
      problem_.move(from_, now.fraction < 1 ? trial_ : δ_, x_);
      problem_.linearise(x_, kind_, here_);
      const double rounding = 1e-13 * (magnitude + here_.magnitude);
      const double goal = energy + 1e-4 * now.fraction * slope + rounding;
      if (tiny) return true;
      if (problem_.conservative() ? here_.energy <= goal : progress(slope, now.fraction))
        return true;
      now.fraction *= shrink(here_.energy - energy, slope, now.fraction);
    }
    std::swap(x_, from_);
    problem_.linearise(x_, kind_, here_);
    return false;
  }

  /// Without a potential: the forces' work along the step must not grow, or the Newton step at the
  /// new state, measured with the old tangent, must be shorter.
  bool progress(double slope, double fraction) {
    if (!here_.gradient.allFinite()) return false;
    if (here_.gradient.dot(δ_) <= 0.9 * std::abs(slope)) return true;
    factor_.solve(here_.gradient, trial_);
    return trial_.norm() <= (1 - fraction / 4) * δ_.norm();
  }

  /// Where the parabola through the two energies and the slope has its minimum, within bounds.
  double shrink(double rise, double slope, double fraction) const {
    if (!problem_.conservative() || !std::isfinite(rise)) return 0.5;
    const double minimum = -slope * fraction / (2 * (rise - slope * fraction));
    return std::clamp(minimum, 0.1, 0.5);
  }

  const P& problem_;
  Options options_;
  Trace trace_;
  Leased<P, Workspace<LinearisationOf<P>, State>> workspace_;
  LinearisationOf<P>& here_;
  Ldlt& factor_;
  Vector &δ_, &trial_;
  State x_, &from_;
  Inertia inertia_;
  Hessian kind_ = Hessian::convex;
};

}  // namespace pyrod
