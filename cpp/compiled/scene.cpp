// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/scene_solver.hpp>
#include <pyrod/statics/solve_scene.hpp>

namespace pyrod {

Equilibrium solve(const Scene& scene, const Settings& settings) {
  return detail::SceneSolver<Settings>(scene, settings).solve();
}

}  // namespace pyrod
