// SPDX-License-Identifier: BSD-3-Clause
/// \file Scenes, how they are solved, and their equilibria: all that a program needs that solves
/// rods. It compiles fast where the solvers are compiled already: link pyrod::compiled.
#pragma once

#include <pyrod/rotation/frame_along.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/solver.hpp>

#ifndef PYROD_COMPILED
#include <pyrod/statics/scene_solver.hpp>
#endif
