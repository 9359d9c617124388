// SPDX-License-Identifier: BSD-3-Clause
/// \file One call for every scene.
#pragma once

#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>
#ifndef PYROD_COMPILED
#include <pyrod/statics/scene_solver.hpp>

#include <concepts>
#endif

namespace pyrod {

/// The equilibrium of a scene. Throws `InvalidArgument` before any work starts; a solve that finds
/// none does not throw, see `Equilibrium::status` and `advice`.
#ifdef PYROD_COMPILED
Equilibrium solve(const Scene& scene, const Settings& settings = {});
#else
template <std::same_as<Settings> S = Settings>
Equilibrium solve(const Scene& scene, const S& settings = {}) {
  return detail::SceneSolver<S>(scene, settings).solve();
}
#endif

}  // namespace pyrod
