// SPDX-License-Identifier: BSD-3-Clause
/// \file Problems that depend on a number λ: what is asked of them to follow their equilibria.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/problem.hpp>

#include <concepts>

namespace pyrod {

/// The unknowns are the same for all λ. What the problem prescribes of a state, such as places
/// where something is held, is not among them.
template <class F>
concept Family = Problem<F> && requires(F f, const F c, double λ, const typename F::State x,
                                        typename F::State y, const Vector v, Vector w) {
  { f.set(λ) };       // from now on it is the problem of λ
  { c.place(y) };     // puts what the problem prescribes into y
  { f.slope(x, w) };  // w = ∂g/∂λ, the gradient's, at x
  // How far the second state is from the first along v, which is weighed by the weights and has
  // entries for all rows; and the gradient of that. To first order it is Σ weights v δ, of those
  // rows whose increments it tells.
  { c.amplitude(x, x, v, w) } -> std::same_as<double>;
};

}  // namespace pyrod
