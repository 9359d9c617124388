// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear maps of small blocks between lists of small vectors, and their transposes from the
/// same numbers.
#pragma once

#include <pyrod/core/types.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// A list of vectors that all have room for W numbers.
template <int W>
using ItemsOf = Eigen::Matrix<double, W, Eigen::Dynamic>;

template <int W>
class BlockMap {
 public:
  /// Adds a block that takes item `from` to item `to`; smaller ones fill the leading corner.
  template <class Block>
  void add(int to, int from, const Eigen::MatrixBase<Block>& block) {
    if (to < 0 || from < 0) return;
    entries_.push_back({to, from, Mat<W>::Zero()});
    entries_.back().block.topLeftCorner(block.rows(), block.cols()) = block;
  }
  void add(int to, int from, double factor) { add(to, from, Mat<W>(factor * Mat<W>::Identity())); }

  /// out += A in.
  void multiply(const ItemsOf<W>& in, ItemsOf<W>& out) const {
    for (const auto& e : entries_) out.col(e.to) += e.block * in.col(e.from);
  }
  /// in += Aᵀ out.
  void pull(const ItemsOf<W>& out, ItemsOf<W>& in) const {
    for (const auto& e : entries_) in.col(e.from) += e.block.transpose() * out.col(e.to);
  }

  bool empty() const { return entries_.empty(); }

 private:
  struct Entry {
    int to, from;
    Mat<W> block;
  };
  std::vector<Entry> entries_;
};

}  // namespace pyrod
