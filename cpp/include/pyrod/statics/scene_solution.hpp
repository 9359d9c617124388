// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a whole scene in space, whatever path led to it.
#pragma once

#include <pyrod/statics/network_run.hpp>
#include <pyrod/statics/solve.hpp>

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

inline SceneSolution scene_solution(Solution<Spatial>&& from, int unknowns) {
  SceneSolution out;
  out.status = from.status;
  out.index = from.index;
  out.residual = from.residual;
  out.load_steps = from.load_steps;
  out.unknowns = unknowns;
  out.record = std::move(from.record);
  out.rods.push_back(std::move(static_cast<RodSolution<Spatial>&>(from)));
  return out;
}

template <class Space>
SceneSolution scene_solution(NetworkRun<Space>&& from) {
  const auto& r = from.result;
  SceneSolution out{std::move(from.rods),
                    std::move(from.nodes),
                    r.status,
                    r.index,
                    r.residual,
                    r.fill,
                    r.unknowns,
                    r.multipliers,
                    r.load_steps,
                    r.descents,
                    r.neutral,
                    {},
                    r.lowest_eigenvalue,
                    r.rounding,
                    std::move(from.result.record),
                    r.softness};
  for (const auto& φ : r.mode) out.mode.push_back(embed_spin(φ));
  return out;
}

}  // namespace pyrod
