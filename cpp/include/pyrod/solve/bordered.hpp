// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear systems with a row and a column more than a tangent, by the factor of that. It
/// knows no rods.
///
/// Where the tangent A is singular, at a fold or a bifurcation, the bordered matrix need not be.
/// Blocks are eliminated as if the factor were that of A; what is added to it is made up for: by
/// refinement, or by GMRES on the bordered matrix itself (docs/theory.md, "Paths").
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/neutral.hpp>
#include <pyrod/solve/shifted_factor.hpp>
#include <pyrod/solve/skew_solver.hpp>

#include <Eigen/Core>

namespace pyrod {

/// [A b; cᵀ d](x, y) = (f, h), theory (39).
class Bordered {
 public:
  /// `factor`, of A and what is added to it, and `neutral` must stay where they are.
  Bordered(ShiftedFactor& factor, const Neutral& neutral) : factor_(factor), neutral_(neutral) {}

  /// The border of what is factorised.
  void set(const Vector& b, const Vector& c, double d) {
    row_ = c;
    solve_block(b, column_);
    pivot_ = d - row_.dot(column_);
  }

  /// With what is factorised in the place of A: x, and y is returned.
  double solve(const Vector& f, double h, Vector& x) const {
    solve_block(f, x);
    const double y = (h - row_.dot(x)) / pivot_;
    x -= y * column_;
    return y;
  }
  /// The same for f = 0: nothing is solved.
  double solve_border(double h, Vector& x) const {
    const double y = h / pivot_;
    x = -y * column_;
    return y;
  }

  /// What is added to the factor is 1e-6: of its share in (x, y) nothing but the square is left.
  void refine(Vector& x, double& y) {
    left_ = factor_.shift().cwiseProduct(x);
    y += solve(left_, 0, step_);
    x += step_;
  }

  /// With A itself, the sum of what is factorised, without anything added, and of Z: `rest(v, out)`
  /// gives Z v.
  template <class Rest>
  double solve_exactly(const Rest& rest, const Vector& f, double h, Vector& x) {
    const Eigen::Index n = f.size();
    const auto solve_it = [&](const Vector& right, Vector& out) {
      const Vector top = right.head(n);
      const double y = solve(top, right[n], step_);
      out.resize(n + 1);
      out << step_, y;
    };
    const auto difference = [&](const Vector& v, Vector& out) {
      const Vector top = v.head(n);
      rest(top, left_);
      out.setZero(n + 1);
      out.head(n) = left_ - factor_.shift().cwiseProduct(top);
    };
    Vector both(n + 1);
    both << f, h;
    solve_it(both, both);
    SkewCorrected(solve_it, difference, n + 1).correct(both);
    x = both.head(n);
    return both[n];
  }

 private:
  void solve_block(const Vector& b, Vector& x) const {
    factor_.solve(b, x);
    neutral_.take_out(x);
  }

  ShiftedFactor& factor_;
  const Neutral& neutral_;
  Vector row_, column_;  ///< c, and A⁻¹ b
  double pivot_ = 1;
  mutable Vector left_, step_;
};

}  // namespace pyrod
