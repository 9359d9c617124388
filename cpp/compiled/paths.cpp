// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/paths/branch_parts.hpp>
#include <pyrod/statics/ladder/compiled.hpp>

namespace pyrod {

template class SceneBranch<PathSettings>;

}  // namespace pyrod
