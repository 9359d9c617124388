// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear systems with the tangent itself, by the factor of one that is shifted a little. It
/// knows no rods.
///
/// What a shift leaves undone is the shift times the solution, and is solved for again: it falls by
/// shift over lowest eigenvalue each time. Where that is not enough, or the tangent is not
/// symmetric, GMRES goes on. What is not solved in the end is told: the matrix is singular, to the
/// digits there are. Where K is symmetric and its null space is known, solutions without anything
/// of it are found all the same.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/shifted_factor.hpp>

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
    if (!skew && summed(x)) return true;
    const auto rest_or_none = [&](const Vector& v, Vector& out) {
      if (skew)
        rest(v, out);
      else
        out.setZero(v.size());
    };
    x = first_;
    factor_.correct_all(rest_or_none, x);
    for (int i = 0; i < 2 && find_left(rest_or_none, x) > 1e-14 * size(x); ++i) {
      factor_.correct_all(rest_or_none, step_);
      x += step_;
    }
    // of a singular matrix that is not quite, by rounding, the solution is anything, and huge
    return size(x) <= most_ * size(first_) && find_left(rest_or_none, x) <= 1e-9 * size(x);
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
    first_ = b - factor_.stiffness().cwiseProduct(free_ * (free_.transpose() * b));
    factor_.solve(first_, first_);
    leave_out(first_);
    return summed(x);
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

  /// What is left of x = F⁻¹ b − F⁻¹ (Z − D) x; its size.
  template <class Rest>
  double find_left(const Rest& rest, const Vector& x) {
    rest(x, step_);
    step_ -= factor_.shift().cwiseProduct(x);
    factor_.solve(step_, step_);
    step_ = first_ - x - step_;
    return size(step_);
  }

  ShiftedFactor& factor_;
  Vector first_, step_;
  Eigen::MatrixXd free_;
};

}  // namespace pyrod
