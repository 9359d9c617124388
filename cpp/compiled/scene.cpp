// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/solve_scene_inline.hpp>
