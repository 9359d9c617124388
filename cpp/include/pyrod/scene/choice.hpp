// SPDX-License-Identifier: BSD-3-Clause
/// \file Space chosen at run time.
#pragma once

#include <pyrod/rotation/space.hpp>

namespace pyrod {

enum class Dimension { planar, spatial };

/// f(Planar{}) or f(Spatial{}).
template <class F>
auto in_space(Dimension dimension, const F& f) {
  return dimension == Dimension::planar ? f(Planar{}) : f(Spatial{});
}

}  // namespace pyrod
