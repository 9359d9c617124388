// SPDX-License-Identifier: BSD-3-Clause
/// \file Samples of functions of arc length, and their differences.
#pragma once

#include <pyrod/core/types.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace pyrod {

/// Numbers along a rod: row i is what a function tells at place i, in as many columns as it likes.
using Samples = Rows<Eigen::Dynamic>;

/// A function of arc length, asked at several places at once. It gives `values` their size.
using SampledFunction = std::function<void(std::span<const double> s, Samples& values)>;

namespace detail {

/// So many equal intervals, with both ends.
inline std::vector<double> evenly(double a, double b, int intervals) {
  std::vector<double> s(std::size_t(intervals) + 1);
  for (int i = 0; i < intervals; ++i) s[std::size_t(i)] = a + i * ((b - a) / intervals);
  s.back() = b;
  return s;
}

/// Also where the first is no number.
inline bool exceeds(double a, double b) { return a > b || (std::isnan(a) && !std::isnan(b)); }

template <class Row>
double largest(const Row& row) {
  double out = 0;
  for (Eigen::Index k = 0; k < row.size(); ++k)
    if (const double size = std::abs(row[k]); exceeds(size, out)) out = size;
  return out;
}

/// The largest component of fourth differences, of each five neighbours.
inline std::vector<double> fourth_differences(Samples values) {
  auto n = values.rows();
  for (int order = 0; order < 4; ++order, --n)
    for (Eigen::Index i = 0; i + 1 < n; ++i) values.row(i) = values.row(i + 1) - values.row(i);
  std::vector<double> out;
  for (Eigen::Index i = 0; i < n; ++i) out.push_back(largest(values.row(i)));
  return out;
}

}  // namespace detail

}  // namespace pyrod
