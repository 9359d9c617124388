// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a whole scene in space, whatever path led to it.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/rounding.hpp>
#include <pyrod/statics/solution/softness.hpp>

#include <vector>

namespace pyrod {

struct SceneSolution {
  std::vector<RodSolution<Spatial>> rods;
  std::vector<NodeSolution<Spatial>> nodes;  ///< none of a cantilever
  Status status = Status::out_of_iterations;
  int index = -1;
  double residual = 0, fill = 1;
  int unknowns = 0, multipliers = 0, load_steps = 0, descents = 0;
  bool neutral = false;
  std::vector<Vec3> mode;
  double lowest_eigenvalue = 0;
  Rounding rounding;
  std::vector<Iteration> record;
  Softness softness;  ///< of a network whose loads have a potential

  bool converged() const { return status == Status::converged; }
};

}  // namespace pyrod
