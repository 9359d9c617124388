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
  BlockSymmetric(std::vector<int> sizes, std::vector<std::vector<int>> above)
      : sizes_(std::move(sizes)), above_(std::move(above)) {
    first_.assign(1, 0);
    for (const int size : sizes_) first_.push_back(first_.back() + size);
    starts.reserve(std::size_t(first_.back()) + 1);
    for (std::size_t J = 0; J < sizes_.size(); ++J) {
      std::sort(above_[J].begin(), above_[J].end());
      prefix_.push_back(int(places_.size()));
      int place = 0;
      for (const int I : above_[J]) places_.push_back(place), place += sizes_[I];
      places_.push_back(place);
      for (int k = 0; k < sizes_[J]; ++k) {
        for (const int I : above_[J])
          for (int i = 0; i < sizes_[I]; ++i) rows.push_back(first_[I] + i);
        for (int i = 0; i <= k; ++i) rows.push_back(first_[J] + i);
        starts.push_back(int(rows.size()));
      }
    }
    values.assign(rows.size(), 0);
  }

  /// Number of the first row of block J.
  int first(int J) const { return first_[J]; }
  int size_of(int J) const { return sizes_[J]; }

  void set_zero() { std::fill(values.begin(), values.end(), 0.); }

  /// Adds to the block in block row I and block column J > I, which the pattern must have.
  template <class Block>
  void add(int I, int J, const Block& block) {
    const auto& rows_of_J = above_[J];
    const auto k = std::lower_bound(rows_of_J.begin(), rows_of_J.end(), I) - rows_of_J.begin();
    add_at(J, places_[prefix_[J] + k], block);
  }

  /// Adds the upper triangle of a block on the diagonal.
  template <class Block>
  void add_diagonal(int J, const Block& block) {
    const int place = places_[prefix_[J] + int(above_[J].size())];
    for (int k = 0; k < sizes_[J]; ++k) {
      double* value = values.data() + starts[first_[J] + k] + place;
      for (int i = 0; i <= k; ++i) value[i] += block(i, k);
    }
  }

 private:
  template <class Block>
  void add_at(int J, int place, const Block& block) {
    for (int k = 0; k < int(block.cols()); ++k) {
      double* value = values.data() + starts[first_[J] + k] + place;
      for (int i = 0; i < int(block.rows()); ++i) value[i] += block(i, k);
    }
  }

  std::vector<int> sizes_, first_, prefix_, places_;
  std::vector<std::vector<int>> above_;
};

}  // namespace pyrod
