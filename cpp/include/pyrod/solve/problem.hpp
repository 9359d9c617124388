// SPDX-License-Identifier: BSD-3-Clause
/// \file What the solver asks of a problem. Its states live on a manifold that only it knows; the
/// solver sees numbers.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/sparse/symmetric.hpp>

#include <concepts>
#include <utility>
#include <vector>

namespace pyrod {

/// Value, gradient and Hessian at a state, in storage that is made once.
template <class Matrix>
struct Linearisation {
  double energy = 0;
  double magnitude =
      0;  ///< sum of the absolute values the energy was summed from: its rounding scale
  Vector gradient;
  Matrix hessian;  ///< symmetric part of the tangent
};

template <class P>
using LinearisationOf = decltype(std::declval<const P&>().linearisation());

/// Where constraints hold, the gradient and the Hessian have a row for each of their multipliers:
/// stationary points are saddles in these. What is told of rows is storage of the problem, made
/// once.
template <class P>
concept Problem = requires(const P p, const typename P::State x, typename P::State y,
                           LinearisationOf<P> at_x, const Vector v, Vector w) {
  { p.linearisation() };                       // storage, with the Hessian's pattern
  { p.linearise(x, Hessian::exact, at_x) };    // energy, gradient and Hessian in one pass
  { p.move(x, v, y) };                         // y = x moved by the increments v
  { p.conservative() } -> std::same_as<bool>;  // whether the energy is a potential of all forces
  { p.dead_loads() } -> std::same_as<bool>;    // whether no force depends on the state
  { p.multiply_skew(x, v, w) };                // w = (tangent − symmetric part) v
  { p.multiplier_sizes(x, w) };                // w: 1 and more, multipliers over their units
  { p.rounding(x, w) };                        // w: what rounding alone leaves of the gradient
  { p.weights() } -> std::convertible_to<Vector>;      // of the primal rows; multipliers: zero
  { p.units() } -> std::convertible_to<Vector>;        // energies that the rows are measured by
  { p.stiffness() } -> std::convertible_to<Vector>;    // of the primal rows, in their own units
  { p.softness() } -> std::convertible_to<Vector>;     // least give of the multipliers' rows
  { p.unit_energy() } -> std::convertible_to<double>;  // the scale of the whole
  { p.least_shift() } -> std::convertible_to<double>;  // of the stiffness: see `ShiftedFactor`
};

}  // namespace pyrod
