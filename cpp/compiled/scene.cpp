// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/ladder/compiled.hpp>
#include <pyrod/statics/scene_solver.hpp>

namespace pyrod {

template class SceneSolver<Settings>;

}  // namespace pyrod
