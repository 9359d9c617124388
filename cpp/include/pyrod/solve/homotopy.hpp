// SPDX-License-Identifier: BSD-3-Clause
/// \file Following a solution while one parameter of the problem goes from 0 to 1. It knows no
/// rods.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/status.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace pyrod {

template <class State>
struct Path {
  Result<State> result;  ///< at the parameter 1 if converged; its record is that of all steps
  int steps = 0;         ///< tried, also those that failed
};

/// The last resort where Newton's method fails from afar. `set(λ, state)` changes the problem that
/// `newton` solves, and what of the state the problem prescribes; `start` is near its solution at λ
/// = 0. A step that fails is tried again at a quarter of its length, easy ones let the next be
/// twice as long.
template <class Solver, class Set>
Path<typename Solver::State> follow(Solver& newton, Set&& set, typename Solver::State start,
                                    double shortest = 1e-4) {
  constexpr int easy = 5;  // iterations
  Path<typename Solver::State> path;
  std::vector<Iteration> record;
  const auto solve_at = [&](double λ, typename Solver::State from) {
    set(λ, from);
    auto result = newton.solve(std::move(from), Hessian::exact);
    record.insert(record.end(), result.record.begin(), result.record.end());
    ++path.steps;
    return result;
  };
  path.result = solve_at(0, start);
  double λ = 0, step = 0.25;
  while (path.result.converged() && λ < 1) {
    const double next = std::min(1., λ + step);
    auto trial = solve_at(next, path.result.state);
    if (trial.converged()) {
      λ = next;
      if (trial.iterations() <= easy) step *= 2;
    } else if (trial.status != Status::interrupted && (step /= 4) > shortest) {
      continue;
    }
    path.result = std::move(trial);
  }
  path.result.record = std::move(record);
  return path;
}

}  // namespace pyrod
