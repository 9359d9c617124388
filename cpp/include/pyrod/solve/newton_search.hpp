// SPDX-License-Identifier: BSD-3-Clause
/// \file How far Newton's method goes along a step.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton_method.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/step_tests.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pyrod {

template <Problem P>
bool Newton<P>::search(Iteration& now, bool tiny) {
  const Merit before =
      downhill() && !tiny ? tests_.merit(here(), δ_, primal_, dual_, trial_) : Merit{0, 0, 0};
  const double magnitude = here().magnitude;
  const double length = primal_.norm(), slope = here().gradient.dot(δ_);
  anchor_.leave();
  std::swap(x_, from_);
  now.fraction = kind_ == Hessian::exact ? std::min(1., options_.trust / now.step) : 1;
  double rise = 0;
  for (; now.fraction > 1e-6; now.fraction *= shrink(rise, before.slope, now.fraction)) {
    rise = std::numeric_limits<double>::infinity();
    if (tiny || now.fraction * now.step < options_.near) kind_ = Hessian::exact;
    trial_ = now.fraction * primal_;
    multipliers_.copy(δ_, trial_);
    problem_.move(from_, trial_, x_);
    linearise();
    anchor_.reach(now.fraction, primal_);
    if (tiny) return true;
    if (!std::isfinite(here().energy)) continue;
    const double rounding = 1e-13 * (magnitude + here().magnitude);
    const double value = here().energy + before.ν / 2 * tangent_.gap();
    if (downhill() && value <= before.value + 1e-4 * now.fraction * before.slope + rounding)
      return true;
    if (improves(now, length, slope)) return true;
    rise = value - before.value;
  }
  std::swap(x_, from_);
  linearise();
  anchor_.go_back();
  return false;
}

template <Problem P>
double Newton<P>::shrink(double rise, double slope, double fraction) const {
  if (!downhill() || !std::isfinite(rise)) return 0.5;
  const double minimum = -slope * fraction / (2 * (rise - slope * fraction));
  return std::clamp(minimum, tangent_.constrained() ? 0.3 : 0.1, 0.5);
}

template <Problem P>
bool Newton<P>::improves(const Iteration& now, double length, double slope) {
  const bool free = !tangent_.constrained();
  if (free && downhill()) return false;  // the energy tells all
  if (free && problem_.dead_loads())
    return here().gradient.dot(δ_) <= 0.9 * std::abs(slope) || contracts(now, length);
  return !has_shift(now) && (contracts(now, length) || settles(now));
}

template <Problem P>
bool Newton<P>::settles(const Iteration& now) const {
  return now.fraction * now.step < 1e-2 && tangent_.residual() <= now.residual / 2;
}

template <Problem P>
bool Newton<P>::contracts(const Iteration& now, double length) {
  if (!here().gradient.allFinite()) return false;
  factor_.solve(pull(), trial_);
  if (now.kind == Hessian::exact && !problem_.conservative()) tangent_.correct(from_, trial_);
  multipliers_.set(0, trial_);
  return trial_.norm() <= (1 - now.fraction / 4) * length;
}

}  // namespace pyrod
