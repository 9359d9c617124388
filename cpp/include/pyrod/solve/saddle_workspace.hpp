// SPDX-License-Identifier: BSD-3-Clause
/// \file What Newton's method stores beside the state where constraints hold.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/shifted_factor.hpp>
#include <pyrod/solve/workspace.hpp>

#include <cstddef>

namespace pyrod {

/// The factor keeps a pointer to the matrix: not to be moved.
template <class Storage, class State>
struct SaddleWorkspace {
  Storage here;
  ShiftedFactor factor;
  State from;
  Vector δ, primal, dual;  ///< the step, without the multipliers, and of these alone
  Vector trial;
  Vector sizes, rounding;  ///< of the multipliers; of the gradient

  template <class P>
  explicit SaddleWorkspace(const P& problem)
      : here(problem.linearisation()),
        factor(here.hessian, problem.stiffness(), problem.units()),
        δ(here.gradient.size()),
        primal(δ.size()),
        dual(δ.size()),
        trial(δ.size()),
        sizes(δ.size()),
        rounding(δ.size()) {
    renew(problem);
  }
  SaddleWorkspace(const SaddleWorkspace&) = delete;
  SaddleWorkspace& operator=(const SaddleWorkspace&) = delete;

  template <class P>
  bool fits(const P& problem) const {
    return problem.fits(here) && factor.multipliers().are(problem.stiffness());
  }

  /// Nothing is left of the solve before.
  template <class P>
  void renew(const P& problem) {
    factor.reuse(problem.stiffness(), problem.units());
    δ.setZero(), primal.setZero(), dual.setZero(), trial.setZero();
    sizes.setOnes(), rounding.setZero();
  }

  std::size_t bytes() const {
    const auto vectors = std::size_t(7 * δ.size()) * sizeof(double);
    return factor.bytes() + here.hessian.bytes() + vectors + from.bytes();
  }
};

}  // namespace pyrod
