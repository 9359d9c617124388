// SPDX-License-Identifier: BSD-3-Clause
/// \file Sparse symmetric matrices of small dense blocks, of any sizes, in any pattern.
#pragma once

#include <pyrod/sparse/symmetric.hpp>

#include <algorithm>

namespace pyrod {

/// Blocks are numbered in the order of elimination. Above the diagonal, block column J has the
/// block rows `above[J]`, each less than J; on the diagonal every block has its upper triangle.
class BlockSymmetric : public SymmetricMatrix {
 public:
  BlockSymmetric(std::vector<int> sizes, const std::vector<std::vector<int>>& above)
      : sizes_(std::move(sizes)) {
    first_.assign(1, 0);
    for (const int size : sizes_) first_.push_back(first_.back() + size);
    reserve(above);
    for (std::size_t J = 0; J < sizes_.size(); ++J) {
      const auto begin = above_.insert(above_.end(), above[J].begin(), above[J].end());
      std::sort(begin, above_.end());
      int place = 0;
      for (auto I = begin; I != above_.end(); ++I) places_.push_back(place), place += sizes_[*I];
      ends_.push_back(int(above_.size()));
      for (int k = 0; k < sizes_[J]; ++k) {
        for (auto I = begin; I != above_.end(); ++I)
          for (int i = 0; i < sizes_[*I]; ++i) rows.push_back(first_[*I] + i);
        for (int i = 0; i <= k; ++i) rows.push_back(first_[J] + i);
        starts.push_back(int(rows.size()));
      }
    }
    values.assign(rows.size(), 0);
  }

  /// Whether it has this pattern, given as to the constructor, each list in rising order.
  bool has(const std::vector<int>& sizes, const std::vector<std::vector<int>>& above) const {
    if (sizes_ != sizes) return false;
    for (std::size_t J = 0; J < above.size(); ++J) {
      const auto begin = above_.begin() + (J == 0 ? 0 : ends_[J - 1]);
      if (!std::equal(above[J].begin(), above[J].end(), begin, above_.begin() + ends_[J]))
        return false;
    }
    return true;
  }

  /// Number of the first row of block J.
  int first(int J) const { return first_[J]; }
  int size_of(int J) const { return sizes_[J]; }

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
    const auto begin = above_.begin() + (J == 0 ? 0 : ends_[J - 1]);
    const auto found = std::lower_bound(begin, above_.begin() + ends_[J], I);
    const int place = places_[found - above_.begin()];
    const BlockColumns to = columns(first_[J]);
    for (int k = 0; k < sizes_[J]; ++k)
      for (int i = 0; i < sizes_[I]; ++i) to[k][place + i] += block(i, k);
  }

  /// Adds the upper triangle of a block on the diagonal.
  template <class Block>
  void add_diagonal(int J, const Block& block) {
    const BlockColumns to = columns(first_[J]);
    for (int k = 0; k < sizes_[J]; ++k)
      for (int i = 0; i <= k; ++i) to[k][to.above + i] += block(i, k);
  }

 private:
  void reserve(const std::vector<std::vector<int>>& above) {
    std::size_t blocks = 0, entries = 0;
    for (std::size_t J = 0; J < sizes_.size(); ++J) {
      int height = 0;
      for (const int I : above[J]) height += sizes_[I];
      blocks += above[J].size();
      entries += std::size_t(sizes_[J]) * std::size_t(2 * height + sizes_[J] + 1) / 2;
    }
    starts.reserve(std::size_t(first_.back()) + 1);
    rows.reserve(entries);
    above_.reserve(blocks);
    places_.reserve(blocks);
    ends_.reserve(sizes_.size());
  }

  std::vector<int> sizes_, first_;
  std::vector<int> above_, places_;  ///< block rows, column by column, and rows before each
  std::vector<int> ends_;            ///< of the columns in these
};

}  // namespace pyrod
