// SPDX-License-Identifier: BSD-3-Clause
/// \file Motions without stiffness that equilibria have all along a path, as round rods between
/// coaxial clamps do: steps take no part in them. It knows no rods.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace pyrod {

class Neutral {
 public:
  int count() const { return int(modes_.cols()); }

  /// Looks for them; `factor` is that of the tangent and a little more. A template, so that only
  /// who calls it compiles Eigen's solver.
  template <std::same_as<ShiftedFactor> Factor>
  void look(Factor& factor, const Vector& weights, double unit) {
    modes_.resize(weights.size(), 0), weighed_ = modes_;
    Vector v, Kv;
    if (first_quotient(factor, v, Kv) > 0.1) return;
    Eigen::MatrixXd X(weights.size(), most_);
    for (int k = 0; k < most_; ++k)
      X.col(k) = Vector::LinSpaced(weights.size(), 0.3 + k, 1.7 + (k + 1) * (k + 1)).array().sin();
    for (int i = 0; i < iterations_; ++i) iterate(factor, weights, X);
    Eigen::MatrixXd KX = X;
    for (int k = 0; k < most_; ++k) {
      v = X.col(k);
      factor.matrix().multiply(v, Kv);
      KX.col(k) = Kv;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(X.transpose() * KX);
    for (int k = 0; k < most_; ++k) {
      if (!(std::abs(ritz.eigenvalues()[k]) <= zero_ * unit)) continue;
      modes_.conservativeResize(Eigen::NoChange, count() + 1);
      modes_.col(count() - 1) = X * ritz.eigenvectors().col(k);
    }
    weigh(weights);
  }

  /// As they are at a state near the last one.
  void renew(ShiftedFactor& factor, const Vector& weights) {
    if (count() == 0) return;
    inverse_ = iterate(factor, weights, modes_);
    weigh(weights);
  }

  /// At an equilibrium: those that have got stiff are none any more.
  void judge(double unit) {
    if (count() > 0 && !(inverse_ * stiff_ * unit >= 1)) modes_.resize(modes_.rows(), 0);
  }

  void take_out(Vector& x) const {
    for (int k = 0; k < count(); ++k) x -= weighed_.col(k).dot(x) * modes_.col(k);
  }

 private:
  static constexpr int most_ = 3, iterations_ = 4;
  static constexpr double zero_ = 1e-8, stiff_ = 1e-3;  ///< eigenvalues, of the unit

  /// One step of inverse iteration; the least length of what is solved for vectors of length 1: the
  /// inverse of the largest eigenvalue.
  static double iterate(ShiftedFactor& factor, const Vector& weights, Eigen::MatrixXd& X) {
    Vector x;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < int(X.cols()); ++k) {
      const Vector b = weights.cwiseProduct(X.col(k));
      factor.solve(b, x);
      for (int i = 0; i < k; ++i) x -= x.dot(weights.cwiseProduct(X.col(i))) * X.col(i);
      const double length = std::sqrt(x.dot(weights.cwiseProduct(x)));
      least = std::min(least, length);
      X.col(k) = x / length;
    }
    return least;
  }

  void weigh(const Vector& weights) { weighed_ = weights.asDiagonal() * modes_; }

  Eigen::MatrixXd modes_, weighed_;
  double inverse_ = 0;  ///< of the largest eigenvalue
};

}  // namespace pyrod
