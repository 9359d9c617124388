// SPDX-License-Identifier: BSD-3-Clause
/// \file One call for every scene.
#pragma once

#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>

namespace pyrod {

/// The equilibrium of a scene. Throws `InvalidArgument` before any work starts; a solve that finds
/// none does not throw, see `Equilibrium::status` and `advice`.
Equilibrium solve(const Scene& scene, const Settings& settings = {});

}  // namespace pyrod

#ifndef PYROD_COMPILED
#include <pyrod/statics/solve_scene_inline.hpp>
#endif
