// SPDX-License-Identifier: BSD-3-Clause
#include "solvers.hpp"

namespace pyrod {

PYROD_NETWORK_SOLVERS(, Planar)

}  // namespace pyrod
