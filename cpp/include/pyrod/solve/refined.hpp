// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear systems with the tangent itself, by the factor of one that is shifted a little. It
/// knows no rods.
///
/// What a shift leaves undone is the shift times the solution, and is solved for again: it falls by
/// shift over lowest eigenvalue each time. Where that is not enough, or the tangent is not
/// symmetric, GMRES goes on. What the tangent itself leaves of the right side then tells how far
/// off that is, and takes it away. What is not solved in the end is told: the matrix is singular,
/// to the digits there are. Where K is symmetric and its null space is known, solutions without
/// anything of it are found all the same.
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
  /// that was solved.
  template <class Rest>
  bool solve(const Rest& rest, bool skew, const Vector& b, Vector& x) {
    if (!skew && !factor_.adds()) {
      factor_.solve(b, x);
      return true;
    }
    if (free_.cols() > 0) return solve_beside(b, x);
    factor_.solve(b, first_);
    if (!skew && summed(x)) {
      if (pivots_may_be_small()) improve(no_rest, b, x, [](Vector&) {});
      return true;
    }
    x = first_;
    const double off = skew ? solve_by_gmres(rest, b, x) : solve_by_gmres(no_rest, b, x);
    // of a singular matrix that is not quite, by rounding, the solution is anything, and huge
    return size(x) <= most_ * size(first_) && off <= 1e-6 * size(x);
  }

  /// The same of several right sides, in place, if nothing is added to K.
  bool solve_all(Eigen::MatrixXd& columns) {
    if (factor_.adds()) return false;
    factor_.solve(columns);
    return true;
  }

  /// From now on nothing of these columns is in solutions: K times them is zero, and they are
  /// orthonormal in diag(stiffness).
  void set_free(const Eigen::MatrixXd& free) { free_ = free; }
  const Eigen::MatrixXd& free() const { return free_; }
  /// Takes them out of x.
  void leave_out(Vector& x) const {
    if (free_.cols() > 0) x -= free_ * (free_.transpose() * factor_.stiffness().cwiseProduct(x));
  }

 private:
  static constexpr double most_ = 1e6;

  static double size(const Vector& v) { return v.lpNorm<Eigen::Infinity>(); }

  /// What b pushes along the null space is left out.
  bool solve_beside(const Vector& b, Vector& x) {
    pushed_ = b - factor_.stiffness().cwiseProduct(free_ * (free_.transpose() * b));
    factor_.solve(pushed_, first_);
    leave_out(first_);
    if (!summed(x)) return false;
    if (pivots_may_be_small()) improve(no_rest, pushed_, x, [](Vector&) {});
    return true;
  }

  /// With D added, F = K + D: what F⁻¹ b leaves of K x = b is D F⁻¹ b, what the next term leaves is
  /// D times that, and so on. Nothing is lost to differences, which in fine rods are all rounding.
  /// Whether the terms fell fast, until nothing was left.
  bool summed(Vector& x) {
    x = step_ = first_;
    for (int i = 0; i < 16; ++i) {
      const double before = size(step_);
      step_ = factor_.shift().cwiseProduct(step_);
      if (step_.isZero(0)) return true;
      factor_.solve(step_, step_);
      leave_out(step_);
      const double now = size(step_);
      if (!(now <= 0.3 * before)) return false;
      x += step_;
      if (now <= 1e-17 * size(x)) return true;
    }
    return false;
  }

  /// The multipliers of spans of few edges have pivots that are all D: what rounding does to these
  /// is as large in solutions as 1e-16/D, and no sum of terms sees it.
  bool pivots_may_be_small() const { return factor_.multipliers().count() > 0; }

  template <class Rest>
  double solve_by_gmres(const Rest& rest, const Vector& b, Vector& x) {
    factor_.correct_all(rest, x);
    return improve(rest, b, x, [&](Vector& step) { factor_.correct_all(rest, step); });
  }

  /// Solves for what is left of K x + Z x = b itself, as often as that helps; `correct(step)`: of
  /// what the factor makes of it. How large the last step was.
  template <class Rest, class Correct>
  double improve(const Rest& rest, const Vector& b, Vector& x, const Correct& correct) {
    double last = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 8; ++i) {
      factor_.matrix().multiply(x, left_);
      rest(x, step_);
      left_ = b - left_ - step_;
      factor_.solve(left_, step_);
      correct(step_);
      leave_out(step_);
      const double now = size(step_);
      if (!(now <= 0.5 * last)) break;
      x += step_;
      last = now;
      if (now <= 1e-14 * size(x)) break;
    }
    return last;
  }

  static void no_rest(const Vector& v, Vector& out) { out.setZero(v.size()); }

  ShiftedFactor& factor_;
  Vector first_, step_, left_, pushed_;
  Eigen::MatrixXd free_;
};

}  // namespace pyrod
