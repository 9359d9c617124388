// SPDX-License-Identifier: BSD-3-Clause
/// \file Which blocks a sparse symmetric matrix has.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

/// Blocks are numbered in the order of elimination. Above the diagonal, block column J has the
/// block rows above[starts[J]], …, above[starts[J + 1] − 1], each less than J, in rising order.
struct BlockPattern {
  std::vector<int> sizes, starts{0}, above;

  BlockPattern() = default;

  /// `couplings`: pairs I < J of blocks, in any order, any number of times.
  BlockPattern(std::vector<int> block_sizes, const std::vector<std::pair<int, int>>& couplings)
      : sizes(std::move(block_sizes)) {
    std::vector<int> place(sizes.size() + 1, 0);
    for (const auto& [I, J] : couplings) ++place[J + 1];
    for (std::size_t J = 0; J < sizes.size(); ++J) place[J + 1] += place[J];
    above.resize(couplings.size());
    for (const auto& [I, J] : couplings) above[place[J]++] = I;  // then where column J ends
    starts.reserve(sizes.size() + 1);
    auto kept = above.begin();
    for (std::size_t J = 0; J < sizes.size(); ++J) {
      const auto first = above.begin() + (J == 0 ? 0 : place[J - 1]),
                 end = above.begin() + place[J];
      if (end - first > 1) std::sort(first, end);
      kept = std::copy(first, std::unique(first, end), kept);
      starts.push_back(int(kept - above.begin()));
    }
    above.erase(kept, above.end());
  }

  int blocks() const { return int(sizes.size()); }
  bool operator==(const BlockPattern&) const = default;
};

}  // namespace pyrod
