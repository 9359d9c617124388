// SPDX-License-Identifier: BSD-3-Clause
/// \file The softest modes of a saddle, by inverse iteration, and an index that they confirm.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/shifted_factor.hpp>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdlib>

namespace pyrod {

/// A direction in which the energy changes least, or falls most; its largest component is 1.
struct Mode {
  double eigenvalue = 0;
  Vector shape;        ///< of the primal rows
  Vector multipliers;  ///< that go with it
};

/// Where inverse iteration begins: something of every mode is in it.
inline void set_start(const ShiftedFactor& factor, Vector& v) {
  // near sin x from 0.3 to 1.7
  const auto x = Vector::LinSpaced(factor.matrix().size(), 0.3, 1.7).array();
  v = x * (1 - x.square() / 6 * (1 - x.square() / 20 * (1 - x.square() / 42)));
  factor.multipliers().set(0, v);
}

/// One step of inverse iteration with what is factorised: what K v is over diag(stiffness) v. `v`
/// and `Kv`: storage.
inline double first_quotient(ShiftedFactor& factor, Vector& v, Vector& Kv) {
  set_start(factor, v);
  v.array() *= factor.stiffness().array();
  factor.solve(v, v);
  factor.matrix().multiply(v, Kv);
  return v.dot(Kv) / v.cwiseProduct(v).dot(factor.stiffness());
}

/// K v = λ diag(weights) v on the constraints, with the eigenvalue nearest to −σ; `factor` is that
/// of K + σ diag(weights). `exact`: without what the factor always adds.
template <std::same_as<ShiftedFactor> Factor>
Mode inverse_iteration(Factor& factor, const Vector& weights, double σ, int steps, bool exact) {
  const auto& K = factor.matrix();
  Mode mode;
  Vector v, Kv(K.size());
  set_start(factor, v);
  for (int i = 0; i < steps; ++i) {
    const double before = mode.eigenvalue;
    Kv = weights.cwiseProduct(v);
    factor.solve(Kv, v);
    if (exact) factor.correct(Kv, v);
    v /= std::sqrt(v.cwiseProduct(v).dot(weights));
    K.multiply(v, Kv);
    mode.eigenvalue = v.dot(Kv);
    if (i > 3 && std::abs(mode.eigenvalue - before) <= 1e-10 * (std::abs(mode.eigenvalue) + σ))
      break;
  }
  mode.multipliers = v;
  factor.multipliers().set(0, v);
  mode.multipliers -= v;
  const double largest = v.lpNorm<Eigen::Infinity>();
  mode.multipliers /= largest;
  mode.shape = v / largest;
  return mode;
}

/// The lowest eigenvalue λ of K v = λ diag(weights) v on the constraints, and its mode. By inverse
/// iteration behind a shift, from `unit` on, at which the inertia says that no eigenvalue is left
/// below; the shift is halved towards it.
template <std::same_as<ShiftedFactor> Factor>
Mode lowest_mode(Factor& factor, const Vector& weights, double unit) {
  const auto unstable_behind = [&](double λ) {
    factor.factorise(λ, weights);
    return factor.index() > 0;
  };
  double above = 0;
  factor.factorise(0, weights);
  for (int i = 1; factor.broken() && i < 10; ++i)  // a pivot that is zero to the last bit
    factor.factorise(above = 1e-7 * i * unit, weights);
  if (factor.index() > 0) {
    double below = 0;
    for (above = unit; unstable_behind(above); above *= 4) below = above;
    for (int i = 0; i < 12; ++i) {
      const double middle = (below + above) / 2;
      (unstable_behind(middle) ? below : above) = middle;
    }
    factor.factorise(above, weights);
  }
  return inverse_iteration(factor, weights, above, 100, above > 0);
}

/// The number of eigenvalues of K v = λ diag(stiffness) v on the constraints below −`zero`. Pivots
/// count those far from zero; those within `near`, which a shift or rounding might move to the
/// other side, are computed: Rayleigh quotients of K itself, in the space of their modes. A
/// template, so that only who calls it compiles Eigen's solver.
template <std::same_as<ShiftedFactor> Factor>
int confirmed_index(Factor& factor, double zero = 1e-6, double near = 1e-4) {
  factor.factorise(-near);
  const int up_to = factor.index();
  factor.factorise(near);
  const int below = factor.index(), count = up_to - below, most = 12;
  if (factor.broken() || count <= 0 || count > most) return std::max(below, 0);
  const auto& K = factor.matrix();
  const auto& U = factor.stiffness();
  // two directions more than modes, if there are so many on the constraints
  const int all = K.size() - 2 * factor.multipliers().count();
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(K.size(), std::clamp(all, count, count + 2)), KX = X;
  for (int k = 0; k < X.cols(); ++k) {
    X.col(k) = Vector::LinSpaced(K.size(), 0.3 + k, 1.7 + (k + 1) * (k + 1)).array().sin();
    for (const int row : factor.multipliers().rows()) X(row, k) = 0;
  }
  Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  Vector b, x;
  for (int i = 0; i < 10; ++i) {
    for (int k = 0; k < X.cols(); ++k) {
      b = U.cwiseProduct(X.col(k));
      factor.solve(b, x);
      factor.correct(b, x);
      X.col(k) = x / std::sqrt(x.cwiseProduct(x).dot(U));
      K.multiply(X.col(k), b);
      KX.col(k) = b;
    }
    ritz.compute(X.transpose() * KX, X.transpose() * U.asDiagonal() * X);
    if (ritz.info() != Eigen::Success) return std::max(below, 0);
    X = (X * ritz.eigenvectors()).eval();
  }
  int negative = below;
  for (const double λ : ritz.eigenvalues()) negative += λ < -zero && λ > -near;
  return negative;
}

}  // namespace pyrod
