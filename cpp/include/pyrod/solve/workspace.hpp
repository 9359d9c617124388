// SPDX-License-Identifier: BSD-3-Clause
/// \file What Newton's method stores beside the state, and how the next solve gets it again.
#pragma once

#include <pyrod/core/pool.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/cholesky.hpp>

#include <concepts>
#include <cstddef>
#include <memory>

namespace pyrod {

/// A problem whose storage depends on its `shape` alone: the patterns of two such problems of the
/// same type of storage and the same shape are equal.
template <class P>
concept Shaped = requires(const P p) {
  { p.shape() } -> std::convertible_to<int>;
};

/// The factor keeps a pointer to the matrix: not to be moved.
template <class Storage, class State>
struct Workspace {
  Storage here;
  Cholesky factor;
  Vector δ, trial;
  State from;

  explicit Workspace(Storage storage)
      : here(std::move(storage)),
        factor(here.hessian),
        δ(here.gradient.size()),
        trial(here.gradient.size()) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  std::size_t bytes() const {
    const auto vectors = std::size_t(here.gradient.size() + δ.size() + trial.size());
    return factor.bytes() + here.hessian.bytes() + vectors * sizeof(double) +
           from.capacity() * sizeof(from[0]);
  }
};

/// A workspace for the life of a solver. That of a shaped problem comes from the thread's pool,
/// with its symbolic factor, and goes back there.
template <class P>
class LeasedWorkspace {
 public:
  using Kept = Workspace<LinearisationOf<P>, typename P::State>;

  explicit LeasedWorkspace(const P& problem) {
    const auto make = [&] { return std::make_unique<Kept>(problem.linearisation()); };
    if constexpr (Shaped<P>) {
      shape_ = problem.shape();
      kept_ = Pool<Kept>::of_this_thread().take(shape_, make);
    } else {
      kept_ = make();
    }
  }
  LeasedWorkspace(const LeasedWorkspace&) = delete;
  LeasedWorkspace& operator=(const LeasedWorkspace&) = delete;
  ~LeasedWorkspace() {
    if constexpr (Shaped<P>) Pool<Kept>::of_this_thread().give_back(shape_, std::move(kept_));
  }

  Kept& operator*() { return *kept_; }

 private:
  int shape_ = 0;
  std::unique_ptr<Kept> kept_;
};

}  // namespace pyrod
