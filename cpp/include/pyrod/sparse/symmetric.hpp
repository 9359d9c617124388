// SPDX-License-Identifier: BSD-3-Clause
/// \file Sparse symmetric matrices: the upper triangle, column by column.
#pragma once

#include <pyrod/core/types.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// Upper triangle in compressed columns, row numbers rising within each column. CHOLMOD factorises
/// this form as it stands; the lower triangle would be copied at every factorisation.
struct SymmetricMatrix {
  std::vector<int> starts{0};  ///< size + 1
  std::vector<int> rows;
  std::vector<double> values;

  int size() const { return int(starts.size()) - 1; }

  /// Memory it takes.
  std::size_t bytes() const {
    return (starts.capacity() + rows.capacity()) * sizeof(int) + values.capacity() * sizeof(double);
  }

  /// The entry on the diagonal, the last of its column; in the pattern.
  double& diagonal(int k) { return values[starts[k + 1] - 1]; }

  /// out = A x.
  void multiply(const Vector& x, Vector& out) const {
    out.setZero(size());
    for (int k = 0; k < size(); ++k) add_products(k, x, out);
  }

  /// The same if x is zero where the other columns have entries.
  void multiply(const Vector& x, const std::vector<int>& columns, Vector& out) const {
    out.setZero(size());
    for (const int k : columns) add_products(k, x, out);
  }

 private:
  /// What the entries of column k, and those of the row like it, add to A x.
  void add_products(int k, const Vector& x, Vector& out) const {
    double sum = 0;
    for (int p = starts[k]; p + 1 < starts[k + 1]; ++p) {  // the last is on the diagonal
      out[rows[p]] += values[p] * x[k];
      sum += values[p] * x[rows[p]];
    }
    out[k] += sum + values[starts[k + 1] - 1] * x[k];
  }
};

}  // namespace pyrod
