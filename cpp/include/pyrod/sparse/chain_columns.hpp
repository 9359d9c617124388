// SPDX-License-Identifier: BSD-3-Clause
/// \file Where a chain of blocks stands in the values of a sparse symmetric matrix.
#pragma once

#include <pyrod/core/pack.hpp>
#include <pyrod/core/types.hpp>

#include <cstddef>

namespace pyrod {

/// The columns of a block in an upper triangle: column k has `above` entries over the diagonal
/// block, and then k + 1.
struct BlockColumns {
  double* start;
  int above;
  double* operator[](int k) const { return start + k * above + k * (k + 1) / 2; }
};

/// The columns of consecutive blocks of B rows, each coupled to the one before it. Those between
/// the first and the last have no other entries and follow each other in memory; the first and the
/// last may be coupled to more, which is left alone.
template <int B>
class ChainColumns {
 public:
  /// `second`: where the columns of the second block begin, if there is one.
  ChainColumns(int blocks, BlockColumns first, double* second, BlockColumns last)
      : last_number_(blocks - 1), first_(first), last_(last), second_(second) {}

  /// Writes the block columns first … first + count − 1, one in each lane: the block above the
  /// diagonal (none for column 0) and the diagonal block, of which the upper triangle is read.
  template <int W>
  void set(int first, int count, const Mat<B, B, Pack<W>>& above,
           const Mat<B, B, Pack<W>>& diagonal) const {
    alignas(Pack<W>) double entries[step_][W];
    int e = 0;
    for (int k = 0; k < B; ++k) {
      for (int i = 0; i < B; ++i) above(i, k).store(entries[e++]);
      for (int i = 0; i <= k; ++i) diagonal(i, k).store(entries[e++]);
    }
    for (int lane = 0; lane < count; ++lane) {
      const int j = first + lane;
      if (j == 0 || j == last_number_) {
        set_end<W>(j == 0 ? first_ : last_, j == 0 ? 0 : B, entries, lane);
      } else {
        double* value = second_ + (j - 1) * step_;
        for (int i = 0; i < step_; ++i) value[i] = entries[i][lane];
      }
    }
  }

 private:
  static constexpr std::ptrdiff_t step_ = B * (B + 1) / 2 + B * B;

  /// `coupled`: how many rows above the diagonal block are written.
  template <int W>
  static void set_end(const BlockColumns& to, int coupled, const double (&entries)[step_][W],
                      int lane) {
    for (int k = 0, e = 0; k < B; e += B + ++k)
      for (int i = B - coupled; i <= B + k; ++i) to[k][to.above - B + i] = entries[e + i][lane];
  }

  int last_number_;
  BlockColumns first_, last_;
  double* second_;
};

}  // namespace pyrod
