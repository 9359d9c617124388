// SPDX-License-Identifier: BSD-3-Clause
/// \file What Newton's method asks of a step.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/multipliers.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace pyrod {

/// The augmented Lagrangian, theory (19), along a step, with multipliers that are new already: its
/// value and slope at the start, and the weight ν of the constraints that makes the slope negative.
struct Merit {
  double value, slope, ν;
};

/// δ: the step; rounding: what of the gradient could be no more.
template <Problem P>
class StepTests {
 public:
  using Here = LinearisationOf<P>;

  StepTests(const P& problem, const Multipliers& multipliers)
      : problem_(problem),
        multipliers_(multipliers),
        weights_(problem.weights()),
        units_(problem.units()) {}

  /// Whether gaps that a step leaves open, as multipliers give more than they should, are felt.
  /// `rounding`: given for the last step.
  bool falls_short(const ShiftedFactor& factor, const Vector& δ, const Vector* rounding) const {
    for (const int k : multipliers_.rows())
      if (std::abs(factor.left(δ, k)) > (rounding ? 0.1 * (*rounding)[k] : 1e-4 * units_[k]))
        return true;
    return false;
  }

  /// Whether the step does what the system asks of it. On the constraints by themselves, too: where
  /// they cannot be met, the multipliers grow until beside them no gap counts. `left`: storage.
  bool accurate(const Here& here, const typename P::State& x, const Vector& δ,
                const Vector& rounding, Vector& left) const {
    here.hessian.multiply(δ, left);
    left += here.gradient;
    if (!problem_.conservative()) {
      Vector skew(δ.size());
      problem_.multiply_skew(x, δ, skew);
      left += skew;
    }
    const double all = 1e-2 * relative(here.gradient),
                 gaps = 1e-2 * multipliers_.largest(here.gradient);
    for (int k = 0; k < int(left.size()); ++k) {
      const double bound = units_[k] * (weights_[k] == 0 ? std::min(all, gaps) : all);
      if (!(std::abs(left[k]) <= bound + rounding[k])) return false;
    }
    return true;
  }

  /// Whether every row of the gradient could be rounding.
  bool rounded(const Vector& gradient, const Vector& rounding) const {
    return (gradient.array().abs() <= rounding.array()).all();
  }

  /// The multipliers are not about to change much beside their sizes.
  bool settled(const Vector& δ, const Vector& sizes) const {
    for (const int k : multipliers_.rows())
      if (!(std::abs(δ[k]) <= 1e-3 * sizes[k])) return false;
    return true;
  }

  /// No gap is left after the last step but rounding.
  bool closed(const Vector& gradient, const Vector& rounding) const {
    for (const int k : multipliers_.rows())
      if (!(std::abs(gradient[k]) <= 1e-13 * units_[k] + 8 * rounding[k])) return false;
    return true;
  }

  /// `dual`: the multipliers' part of the step, which goes there; `change`: storage.
  Merit merit(const Here& here, const Vector& δ, const Vector& primal, Vector& dual,
              Vector& change) const {
    multipliers_.copy(δ, dual);
    multipliers_.multiply(here.hessian, dual, change);  // of the gradient, by the multipliers
    double value = here.energy, gap = 0;
    for (const int k : multipliers_.rows()) {
      const double g = here.gradient[k];
      value += δ[k] * (g + change[k] / 2);
      gap += (g + change[k]) * (g + change[k]) / units_[k];
    }
    const double slope = here.gradient.dot(primal) + change.dot(primal);
    const double ν = std::max(10., gap > 0 ? 2 * slope / gap : 0.);
    return {value + ν / 2 * gap, slope - ν * gap, ν};
  }

 private:
  /// Largest row in its unit.
  double relative(const Vector& v) const {
    return v.cwiseQuotient(units_).template lpNorm<Eigen::Infinity>();
  }

  const P& problem_;
  const Multipliers& multipliers_;
  decltype(std::declval<const P&>().weights()) weights_;
  decltype(std::declval<const P&>().units()) units_;
};

}  // namespace pyrod
