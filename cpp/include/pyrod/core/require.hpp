// SPDX-License-Identifier: BSD-3-Clause
/// \file Preconditions. Every public entry checks its arguments with these, before any work starts.
#pragma once

#include <pyrod/core/types.hpp>

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace pyrod {

/// What every refused argument raises; `ValueError` in Python.
struct InvalidArgument : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Joins its arguments into one text, as `<<` prints them.
template <class... T>
std::string text(const T&... parts) {
  std::ostringstream out;
  out.precision(6);
  (out << ... << parts);
  return out.str();
}

/// Throws `InvalidArgument` with the joined message unless `condition` holds.
template <class... T>
void require(bool condition, const T&... message) {
  if (!condition) throw InvalidArgument(text(message...));
}

/// Every entry of `values` is a finite number; otherwise the message names the first that is not.
template <class Derived>
void require_finite(const Eigen::DenseBase<Derived>& values, std::string_view name) {
  if (values.allFinite()) return;
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      require(std::isfinite(values.derived()(i, k)), name, "[", i,
              "]: expected finite numbers, got ", values.derived()(i, k));
}

/// Every entry of `values` is finite and greater than zero.
template <class Derived>
void require_positive(const Eigen::DenseBase<Derived>& values, std::string_view name) {
  require_finite(values, name);
  if ((values.derived().array() > 0).all()) return;
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (Eigen::Index k = 0; k < values.cols(); ++k)
      require(values.derived()(i, k) > 0, name, "[", i, "]: must be positive, got ",
              values.derived()(i, k));
}

inline void require_count(Eigen::Index got, Eigen::Index expected, std::string_view name,
                          std::string_view what) {
  require(got == expected, name, ": expected ", expected, " rows (", what, "), got ", got);
}

}  // namespace pyrod
