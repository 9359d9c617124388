// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/linear/linearised_parts.hpp>
#include <pyrod/statics/ladder/compiled.hpp>

namespace pyrod {

template class LinearisedScene<Settings>;

}  // namespace pyrod
