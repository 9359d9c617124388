// SPDX-License-Identifier: BSD-3-Clause
/// \file How Newton's method finds a step.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton_method.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/result.hpp>

#include <cmath>
#include <limits>

namespace pyrod {

template <Problem P>
bool Newton<P>::find_step(Iteration& now) {
  factorise(anchor_.weight(), now);
  now.shift = 0;
  const bool potential = problem_.conservative();
  if (std::isfinite(now.step) && kind_ == Hessian::exact &&
      (!potential || falls_short(now.step <= options_.tolerance)))
    correct_step(now);
  if (usable(now) && (!potential || !minimum_ || factor_.index() == 0 ||
                      now.step <= options_.tolerance || rounded()))
    return true;
  double σ = first_shift();
  const double growth = tangent_.constrained() ? 4 : 3;
  for (int i = 0; i < 40 && std::isfinite(σ); ++i, σ *= growth) {
    factorise(σ, now);
    if (usable(now) && factor_.index() == 0) return true;
  }
  return false;
}

template <Problem P>
bool Newton<P>::find_last_step(Iteration& now, const Result<State>& result) {
  if (result.record.empty() || anchor_.holds() || kind_ != Hessian::exact) return false;
  const Iteration& last = result.record.back();
  // two steps before, the factor is of another state still
  if (!was_whole(last) || last.factorisations == 0 || !problem_.conservative()) return false;
  // next to a limit point gaps that are left, however small, push far along the mode that is soft
  if (tangent_.constrained()) return false;
  if (last.step > most_since_factor || last.step * last.step > 10 * options_.tolerance)
    return false;
  factor_.solve(pull(), δ_);
  δ_ = -δ_;
  split_step();
  now.step = δ_.allFinite() ? largest(primal_) : std::numeric_limits<double>::infinity();
  const double most = options_.tolerance * options_.tolerance;
  if (!(now.step <= options_.tolerance && now.step <= last.step / 10)) return false;
  return (now.step * last.step <= most || refine_step(most)) && is_last(now);
}

template <Problem P>
bool Newton<P>::refine_step(double most) {
  double before = largest(δ_);
  for (int i = 0; i < 2; ++i) {
    here().hessian.multiply(δ_, trial_);
    trial_ += here().gradient;
    factor_.solve(trial_, trial_);
    δ_ -= trial_;
    split_step();
    const double now = largest(trial_);
    if (!(now <= before / 10)) return false;
    if (now * now <= most * before) return true;  // what would be left next
    before = now;
  }
  return false;
}

template <Problem P>
bool Newton<P>::usable(const Iteration& now) const {
  const bool cut =
      tangent_.constrained() || !problem_.conservative() || !minimum_ || kind_ == Hessian::convex;
  return std::isfinite(now.step) && (cut || now.step <= options_.trust);
}

template <Problem P>
double Newton<P>::first_shift() const {
  if (tangent_.constrained()) return 1e-3;
  return 0.3 * largest(here().gradient.cwiseQuotient(factor_.stiffness())) / options_.trust;
}

template <Problem P>
void Newton<P>::correct_step(Iteration& now) {
  if (problem_.conservative())
    trial_ = -pull(), factor_.correct(trial_, δ_);
  else
    tangent_.correct(x_, δ_);
  split_step();
  now.step = δ_.allFinite() ? largest(primal_) : std::numeric_limits<double>::infinity();
}

template <Problem P>
void Newton<P>::factorise(double σ, Iteration& now) {
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

}  // namespace pyrod
