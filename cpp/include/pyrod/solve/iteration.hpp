// SPDX-License-Identifier: BSD-3-Clause
/// \file What is kept of each step of a solve, and who may watch.
#pragma once

#include <pyrod/core/hessian.hpp>

#include <functional>

namespace pyrod {

/// One line of a solve's record.
struct Iteration {
  Hessian kind;        ///< Hessian the step was made with
  double energy;       ///< before the step
  double residual;     ///< largest component of the gradient before the step
  double step;         ///< largest component [rad] of the step
  double fraction;     ///< part of the step that was taken, 1 unless it had to be cut
  double shift;        ///< σ added to the Hessian's diagonal, 0 unless it had to be
  int factorisations;  ///< 1 unless shifts were tried; 0: with the factor of the step before
  int unknowns;        ///< of the grid that the step was made on
};

/// Sees each iteration as it is done; returns false to stop the solve.
using Trace = std::function<bool(const Iteration&)>;

}  // namespace pyrod
