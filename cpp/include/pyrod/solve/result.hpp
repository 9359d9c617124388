// SPDX-License-Identifier: BSD-3-Clause
/// \file What a run of Newton's method ended in.
#pragma once

#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/status.hpp>

#include <vector>

namespace pyrod {

template <class State>
struct Result {
  State state;
  Status status = Status::out_of_iterations;
  std::vector<Iteration> record;
  double energy = 0, residual = 0;  ///< at `state`
  int index =
      -1;  ///< negative eigenvalues of the Hessian, once converged; −1: unknown, or no potential

  int iterations() const { return int(record.size()); }
  bool converged() const { return status == Status::converged; }
};

}  // namespace pyrod
