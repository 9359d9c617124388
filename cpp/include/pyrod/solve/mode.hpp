// SPDX-License-Identifier: BSD-3-Clause
/// \file The softest mode of a saddle, by inverse iteration.
#pragma once

#include <pyrod/solve/multipliers.hpp>
#include <pyrod/sparse/cholesky.hpp>

namespace pyrod {

/// A direction in which the energy changes least, or falls most; its largest component is 1.
struct Mode {
  double eigenvalue = 0;
  Vector shape;
};

/// K v = λ M v on the constraints, with the eigenvalue nearest to −σ. `factor` is that of K + σ M.
inline Mode inverse_iteration(const SymmetricMatrix& K, Cholesky& factor, const Vector& weights,
                              const Multipliers& multipliers, double σ, int steps) {
  Mode mode;
  Vector v = Vector::LinSpaced(K.size(), 0.3, 1.7).array().sin(), Kv(v.size());
  multipliers.set(0, v);
  for (int i = 0; i < steps; ++i) {
    const double before = mode.eigenvalue;
    Kv = weights.cwiseProduct(v);
    factor.solve(Kv, v);
    v /= std::sqrt(v.cwiseProduct(v).dot(weights));
    K.multiply(v, Kv);
    mode.eigenvalue = v.dot(Kv);
    if (i > 3 && std::abs(mode.eigenvalue - before) <= 1e-10 * (std::abs(mode.eigenvalue) + σ))
      break;
  }
  multipliers.set(0, v);
  mode.shape = v / v.lpNorm<Eigen::Infinity>();
  return mode;
}

}  // namespace pyrod
