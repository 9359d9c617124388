// SPDX-License-Identifier: BSD-3-Clause
/// \file The same rod on halved edges.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>

#include <cstddef>
#include <string_view>

namespace pyrod {

/// A level of a climb has the edges of level 0, each cut in 2ᵏ, and `given` numbers for them.
inline void require_level(Eigen::Index given, Eigen::Index level0, int level,
                          std::string_view what) {
  require(given == level0 << level, "level ", level, ": expected ", level0 << level, " ", what,
          ", got ", given);
}

}  // namespace pyrod
