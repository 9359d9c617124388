// SPDX-License-Identifier: BSD-3-Clause
/// \file What Newton's method stores beside the state, and how the next solve gets it again.
#pragma once

#include <pyrod/core/pool.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <concepts>
#include <cstddef>
#include <memory>

namespace pyrod {

/// A problem that knows whether storage that was made for another of its type has its pattern.
template <class P>
concept Shaped = requires(const P p, const LinearisationOf<P> made) {
  { p.fits(made) } -> std::convertible_to<bool>;
};

/// The factor keeps a pointer to the matrix: not to be moved.
template <class Storage, class State>
struct Workspace {
  Storage here;
  ShiftedFactor factor;
  State from;
  Vector δ, primal, dual;  ///< the step, without the multipliers, and of these alone
  Vector trial;
  Vector sizes, rounding;  ///< of the multipliers; of the gradient

  template <class P>
  explicit Workspace(const P& problem)
      : here(problem.linearisation()),
        factor(here.hessian, problem.stiffness(), problem.units(), problem.least_shift()),
        δ(here.gradient.size()),
        primal(δ.size()),
        dual(δ.size()),
        trial(δ.size()),
        sizes(δ.size()),
        rounding(δ.size()) {
    renew(problem);
  }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  template <class P>
  bool fits(const P& problem) const {
    return problem.fits(here) && factor.multipliers().are(problem.stiffness());
  }

  /// Nothing is left of the solve before.
  template <class P>
  void renew(const P& problem) {
    factor.reuse(problem.stiffness(), problem.units(), problem.least_shift());
    δ.setZero(), primal.setZero(), dual.setZero(), trial.setZero();
    sizes.setOnes(), rounding.setZero();
  }

  std::size_t bytes() const {
    const auto vectors = std::size_t(7 * δ.size()) * sizeof(double);
    return factor.bytes() + here.hessian.bytes() + vectors + from.bytes();
  }
};

/// A workspace for the life of a solver. That of a shaped problem comes from the thread's pool,
/// with its symbolic factor, and goes back there.
template <class P, class Kept>
class Leased {
 public:
  explicit Leased(const P& problem) {
    const auto make = [&] { return std::make_unique<Kept>(problem); };
    if constexpr (Shaped<P>) {
      const auto fits = [&](const Kept& idle) { return idle.fits(problem); };
      kept_ = Pool<Kept>::of_this_thread().take(fits, make);
      kept_->renew(problem);
    } else {
      kept_ = make();
    }
  }
  Leased(const Leased&) = delete;
  Leased& operator=(const Leased&) = delete;
  ~Leased() {
    if constexpr (Shaped<P>) Pool<Kept>::of_this_thread().give_back(std::move(kept_));
  }

  Kept& operator*() { return *kept_; }

 private:
  std::unique_ptr<Kept> kept_;
};

}  // namespace pyrod
