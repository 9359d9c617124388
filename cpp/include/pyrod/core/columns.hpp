// SPDX-License-Identifier: BSD-3-Clause
/// \file Lists of small vectors, stored component by component, as packs are read.
#pragma once

#include <pyrod/core/pack.hpp>
#include <pyrod/core/types.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pyrod {

/// A list of vectors with N components. A pack that reaches beyond the last of them repeats it.
template <int N>
class Columns {
 public:
  Columns() = default;

  /// item(j): vector number j.
  template <class Item>
  Columns(int count, const Item& item) {
    assign(count, item);
  }

  /// The same in storage that there is, if it is large enough.
  template <class Item>
  void assign(int count, const Item& item) {
    stride_ = count + widest - 1;
    values_.resize(std::size_t(N * stride_));
    for (int j = 0; j < stride_; ++j) {
      const Vec<N> v = item(std::min(j, count - 1));
      for (int i = 0; i < N; ++i) values_[i * stride_ + j] = v[i];
    }
  }

  Vec<N> operator[](int j) const {
    Vec<N> out;
    for (int i = 0; i < N; ++i) out[i] = values_[i * stride_ + j];
    return out;
  }

  /// The vectors number j, j + 1, …
  template <class Real>
  Vec<N, Real> at(int j) const {
    Vec<N, Real> out;
    for (int i = 0; i < N; ++i) out[i] = Real::load(values_.data() + i * stride_ + j);
    return out;
  }

 private:
  static constexpr int widest = 8;
  std::ptrdiff_t stride_ = 0;
  std::vector<double> values_;
};

}  // namespace pyrod
