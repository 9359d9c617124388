// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/ladder/compiled.hpp>

namespace pyrod {

PYROD_SOLVERS(, Planar)

}  // namespace pyrod
