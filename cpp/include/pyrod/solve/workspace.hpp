// SPDX-License-Identifier: BSD-3-Clause
/// \file What Newton's method stores beside the state, and how the next solve gets it again.
#pragma once

#include <pyrod/core/pool.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/ldlt.hpp>

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
  Ldlt factor;
  Vector δ, trial;
  State from;

  template <class P>
  explicit Workspace(const P& problem)
      : here(problem.linearisation()),
        factor(here.hessian),
        δ(here.gradient.size()),
        trial(here.gradient.size()) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  template <class P>
  bool fits(const P& problem) const {
    return problem.fits(here);
  }
  template <class P>
  void renew(const P&) {}

  std::size_t bytes() const {
    const auto vectors = std::size_t(here.gradient.size() + δ.size() + trial.size());
    return factor.bytes() + here.hessian.bytes() + vectors * sizeof(double) +
           from.capacity() * sizeof(from[0]);
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
