// SPDX-License-Identifier: BSD-3-Clause
/// \file The rows of a saddle that belong to multipliers, few among many.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/sparse/symmetric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pyrod {

class Multipliers {
 public:
  /// Those of the matrix K whose weight is zero, each with its unit.
  Multipliers(const SymmetricMatrix& K, const Vector& weights, const Vector& units)
      : units_(units) {
    const auto is_one = [&](int i) { return weights[i] == 0; };
    for (int k = 0; k < K.size(); ++k) {
      if (is_one(k)) rows_.push_back(k);
      const auto first = K.rows.begin() + K.starts[k], end = K.rows.begin() + K.starts[k + 1];
      if (std::any_of(first, end, is_one)) columns_.push_back(k);
    }
  }

  /// Whether they are those whose weight is zero.
  bool are(const Vector& weights) const {
    std::size_t found = 0;
    for (int k = 0; k < weights.size(); ++k) {
      if (weights[k] != 0) continue;
      if (found == rows_.size() || rows_[found++] != k) return false;
    }
    return found == rows_.size();
  }
  /// The same rows in other units.
  void renew(const Vector& units) { units_ = units; }

  int count() const { return int(rows_.size()); }
  const std::vector<int>& rows() const { return rows_; }

  void set(double value, Vector& v) const {
    for (const int k : rows_) v[k] = value;
  }
  void copy(const Vector& from, Vector& to) const {
    for (const int k : rows_) to[k] = from[k];
  }

  /// Of gaps in their units, an energy.
  double squared_norm(const Vector& v) const {
    double sum = 0;
    for (const int k : rows_) sum += v[k] * v[k] / units_[k];
    return sum;
  }
  /// Of gaps, relative to their units.
  double largest(const Vector& v) const {
    double out = 0;
    for (const int k : rows_) out = std::max(out, std::abs(v[k]) / units_[k]);
    return out;
  }

  /// out = K f, where f is zero but for multipliers. Most columns have no entry for them.
  void multiply(const SymmetricMatrix& K, const Vector& f, Vector& out) const {
    K.multiply(f, columns_, out);
  }

 private:
  std::vector<int> rows_, columns_;
  Vector units_;
};

}  // namespace pyrod
