// SPDX-License-Identifier: BSD-3-Clause
/// \file Sparse symmetric matrices of small dense blocks, of any sizes, in any pattern.
#pragma once

#include <pyrod/sparse/block_pattern.hpp>
#include <pyrod/sparse/chain_columns.hpp>
#include <pyrod/sparse/symmetric.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

/// On the diagonal every block has its upper triangle.
class BlockSymmetric : public SymmetricMatrix {
 public:
  explicit BlockSymmetric(BlockPattern pattern) : pattern_(std::move(pattern)) {
    const auto& [sizes, columns, above] = pattern_;
    first_.reserve(sizes.size() + 1), places_.reserve(above.size());
    first_.push_back(0);
    for (const int size : sizes) first_.push_back(first_.back() + size);
    reserve();
    for (int J = 0; J < pattern_.blocks(); ++J) {
      int place = 0;
      for (int b = columns[J]; b < columns[J + 1]; ++b)
        places_.push_back(place), place += sizes[above[b]];
      for (int k = 0; k < sizes[J]; ++k) {
        for (int b = columns[J]; b < columns[J + 1]; ++b)
          for (int i = 0; i < sizes[above[b]]; ++i) rows.push_back(first_[above[b]] + i);
        for (int i = 0; i <= k; ++i) rows.push_back(first_[J] + i);
        starts.push_back(int(rows.size()));
      }
    }
    values.assign(rows.size(), 0);
  }

  const BlockPattern& pattern() const { return pattern_; }
  /// Number of the first row of block J.
  int first(int J) const { return first_[J]; }
  int size_of(int J) const { return pattern_.sizes[J]; }

  /// Of the block whose first row is `row`.
  BlockColumns columns(int row) {
    return {values.data() + starts[row], starts[row + 1] - starts[row] - 1};
  }

  /// Of so many blocks from this row on, each coupled to the one before it, and but for the first
  /// and the last to none else above the diagonal.
  template <int B>
  ChainColumns<B> chain(int row, int blocks) {
    return {blocks, columns(row), values.data() + starts[row + (blocks > 1 ? B : 0)],
            columns(row + B * (blocks - 1))};
  }

  /// From this row, the first of its block, to the one before `end`.
  void set_zero(int row, int end) {
    std::fill(values.begin() + starts[row], values.begin() + starts[end], 0.);
  }

  /// Adds to the block in block row I and block column J > I, which the pattern must have. Of a
  /// larger `block` only as much as fits is read, here and below.
  template <class Block>
  void add(int I, int J, const Block& block) {
    const auto &above = pattern_.above, &columns_of = pattern_.starts;
    const auto found =
        std::lower_bound(above.begin() + columns_of[J], above.begin() + columns_of[J + 1], I);
    const int place = places_[found - above.begin()];
    const BlockColumns to = columns(first_[J]);
    for (int k = 0; k < size_of(J); ++k)
      for (int i = 0; i < size_of(I); ++i) to[k][place + i] += block(i, k);
  }

  /// Adds the upper triangle of a block on the diagonal.
  template <class Block>
  void add_diagonal(int J, const Block& block) {
    const BlockColumns to = columns(first_[J]);
    for (int k = 0; k < size_of(J); ++k)
      for (int i = 0; i <= k; ++i) to[k][to.above + i] += block(i, k);
  }

 private:
  void reserve() {
    const auto& [sizes, columns, above] = pattern_;
    std::size_t entries = 0;
    for (int J = 0; J < pattern_.blocks(); ++J) {
      int height = 0;
      for (int b = columns[J]; b < columns[J + 1]; ++b) height += sizes[above[b]];
      entries += std::size_t(sizes[J]) * std::size_t(2 * height + sizes[J] + 1) / 2;
    }
    starts.reserve(std::size_t(first_.back()) + 1);
    rows.reserve(entries);
  }

  BlockPattern pattern_;
  std::vector<int> first_;   ///< rows of the blocks
  std::vector<int> places_;  ///< for each block above the diagonal: rows before it in its column
};

}  // namespace pyrod
