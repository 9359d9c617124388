// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear systems with the tangent itself, by the factor of one that is shifted a little. It
/// knows no rods.
///
/// What the shifts leave undone is refined with the true matrix: a residual falls by shift over
/// lowest eigenvalue each time. Where that is not enough, or the tangent is not symmetric, GMRES
/// goes on. What is not solved in the end is told: the matrix is singular, to the digits there are.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <limits>

namespace pyrod {

class Refined {
 public:
  /// `factor`, of K and what is added to it, must stay where it is.
  explicit Refined(ShiftedFactor& factor) : factor_(factor) {}

  /// (K + Z) x = b where `rest(v, out)` gives Z v; `skew`: whether there is any Z. Returns whether
  /// that was solved to nearly all digits.
  template <class Rest>
  bool solve(const Rest& rest, bool skew, const Vector& b, Vector& x) {
    factor_.solve(b, x);
    if (!skew && refine(rest, skew, b, x)) return true;
    factor_.solve(b, x);
    factor_.correct_all(rest, x);
    for (int i = 0; i < 3; ++i) {
      find_left(rest, skew, b, x);
      factor_.solve(left_, step_);
      if (size(step_) <= 1e-14 * size(x)) break;
      factor_.correct_all(rest, step_);
      x += step_;
    }
    find_left(rest, skew, b, x);
    factor_.solve(left_, step_);
    return size(step_) <= 1e-9 * size(x);
  }

 private:
  static double size(const Vector& v) { return v.lpNorm<Eigen::Infinity>(); }

  /// What is left of b.
  template <class Rest>
  void find_left(const Rest& rest, bool skew, const Vector& b, const Vector& x) {
    factor_.matrix().multiply(x, left_);
    if (skew) {
      rest(x, step_);
      left_ += step_;
    }
    left_ = b - left_;
  }

  /// Whether what is left fell fast, until nothing was.
  template <class Rest>
  bool refine(const Rest& rest, bool skew, const Vector& b, Vector& x) {
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
      find_left(rest, skew, b, x);
      factor_.solve(left_, step_);
      const double now = size(step_), all = size(x);
      if (now <= 1e-15 * all) return true;
      if (!(now <= 0.1 * before)) return now <= 1e-12 * all;  // of rounding, or too slow
      x += step_;
      before = now;
    }
    return false;
  }

  ShiftedFactor& factor_;
  Vector left_, step_;
};

}  // namespace pyrod
