// SPDX-License-Identifier: BSD-3-Clause
/// \file Where along a rod its frames are not smooth, whatever the supports do.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/scene/loads.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// Vertices, in order, at which point loads act or the rod itself jumps.
template <class Space>
std::vector<int> kinks(const Rod<Space>& rod, const Loads<Space>& loads) {
  std::vector<int> out = loads.pushed;
  for (const auto& jump : rod.jumps) out.push_back(jump.vertex);
  for (const auto& moment : loads.vertex_moments) out.push_back(moment.vertex);
  std::ranges::sort(out);
  out.erase(std::ranges::unique(out).begin(), out.end());
  return out;
}

}  // namespace pyrod
