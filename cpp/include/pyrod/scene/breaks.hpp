// SPDX-License-Identifier: BSD-3-Clause
/// \file Where a function of arc length jumps or has kinks.
#pragma once

#include <vector>

namespace pyrod {

/// Arc lengths of jumps and kinks, and whether there are more than could be told apart.
struct Breaks {
  std::vector<double> at = {};
  bool unresolved = false;
};

}  // namespace pyrod
