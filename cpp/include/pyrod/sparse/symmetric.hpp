// SPDX-License-Identifier: BSD-3-Clause
/// \file Sparse symmetric matrices: the upper triangle, column by column.
#pragma once

#include <pyrod/core/types.hpp>

#include <vector>

namespace pyrod {

/// Upper triangle in compressed columns, row numbers rising within each column. CHOLMOD factorises
/// this form as it stands; the lower triangle would be copied at every factorisation.
struct SymmetricMatrix {
  std::vector<int> starts{0};  ///< size + 1
  std::vector<int> rows;
  std::vector<double> values;

  int size() const { return int(starts.size()) - 1; }

  /// The entry on the diagonal, the last of its column; in the pattern.
  double& diagonal(int k) { return values[starts[k + 1] - 1]; }

  /// out = A x.
  void multiply(const Vector& x, Vector& out) const {
    out.setZero(size());
    for (int k = 0; k < size(); ++k) {
      for (int p = starts[k]; p < starts[k + 1]; ++p) {
        const int i = rows[p];
        out[i] += values[p] * x[k];
        if (i != k) out[k] += values[p] * x[i];
      }
    }
  }
};

/// A chain of B × B blocks, each coupled to the one before it. Numbered along the chain its
/// factor has no fill.
template <int B>
class BlockTridiagonal : public SymmetricMatrix {
 public:
  explicit BlockTridiagonal(int blocks) {
    starts.reserve(B * blocks + 1);
    rows.reserve(first_ + (blocks - 1) * step_);
    for (int j = 0; j < blocks; ++j) {
      for (int k = 0; k < B; ++k) {
        for (int i = (j == 0 ? 0 : -B); i <= k; ++i) rows.push_back(B * j + i);
        starts.push_back(int(rows.size()));
      }
    }
    values.assign(rows.size(), 0);
  }

  /// Writes block column j: the block above the diagonal (none for j = 0) and the diagonal block,
  /// of which the upper triangle is read.
  void set_column(int j, const Mat<B>& above, const Mat<B>& diagonal) {
    double* value = column(j);
    for (int k = 0; k < B; ++k) {
      if (j > 0)
        for (int i = 0; i < B; ++i) *value++ = above(i, k);
      for (int i = 0; i <= k; ++i) *value++ = diagonal(i, k);
    }
  }

  /// Adds the upper triangle of a block to the diagonal block j.
  void add_to_diagonal(int j, const Mat<B>& block) {
    double* value = column(j);
    for (int k = 0; k < B; ++k) {
      if (j > 0) value += B;
      for (int i = 0; i <= k; ++i) *value++ += block(i, k);
    }
  }

 private:
  double* column(int j) { return values.data() + (j == 0 ? 0 : first_ + (j - 1) * step_); }

  static constexpr std::ptrdiff_t first_ = B * (B + 1) / 2, step_ = first_ + B * B;
};

}  // namespace pyrod
