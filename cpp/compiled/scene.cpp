// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene/make_rod.hpp>
#include <pyrod/scene/scene_checks.hpp>
#include <pyrod/scene/with_vertices.hpp>
#include <pyrod/statics/ladder/compiled.hpp>
#include <pyrod/statics/scene_solver.hpp>

namespace pyrod {

template class SceneSolver<Settings>;

}  // namespace pyrod
