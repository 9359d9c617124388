// SPDX-License-Identifier: BSD-3-Clause
/// \file What is a rotation, and what are axes at right angles, for the checks of arguments.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace pyrod {

/// Lengths may be off by this: more is an error, not rounding.
inline constexpr double unit_rounding = 1e-6;

template <class... Name>
void require_rotation(Angle a, const Name&... name) {
  require(std::isfinite(a.radians), name..., ": expected a finite angle, got ", a.radians);
}

template <class... Name>
void require_rotation(const Quaternion& q, const Name&... name) {
  require(std::abs(q.squaredNorm() - 1) < 2 * unit_rounding, name...,
          ": expected a unit quaternion, got (", q.w(), ", ", q.vec().transpose(), ") of length ",
          q.norm(), "; divide it by its length");
}

/// One rotation per edge.
template <class Rotation>
void require_frames(const std::vector<Rotation>& frames, int edges, std::string_view name) {
  require_count(Eigen::Index(frames.size()), edges, name, "one frame per edge");
  for (std::size_t j = 0; j < frames.size(); ++j) require_rotation(frames[j], name, "[", j, "]");
}

/// Columns of length one at right angles; none will do.
template <class Derived, class... Name>
void require_orthonormal(const Eigen::MatrixBase<Derived>& A, const Name&... name) {
  for (Eigen::Index i = 0; i < A.cols(); ++i)
    for (Eigen::Index k = 0; k <= i; ++k) {
      const double product = A.col(i).dot(A.col(k));
      require(std::abs(product - (i == k)) < 2 * unit_rounding, name...,
              ": expected columns of length 1 at right angles, got columns ", k, " and ", i,
              " with the product ", product);
    }
}

}  // namespace pyrod
