// SPDX-License-Identifier: BSD-3-Clause
/// \file Problems for the solver that have nothing to do with rods: functions of a few numbers.
#pragma once

#include "support/matrices.hpp"

#include <pyrod/solve/problem.hpp>

#include <cmath>
#include <functional>

namespace pyrod::test {

/// A function of `size` numbers, and possibly forces without a potential.
struct FlatProblem {
  using State = Vector;

  int size;
  std::function<double(const Vector&)> f;
  std::function<Vector(const Vector&)> slope;
  std::function<Dense(const Vector&)> curvature;
  std::function<Dense(const Vector&)> convex = {};  ///< `curvature` if empty
  std::function<Dense(const Vector&)> skew = {};    ///< what the tangent has beside the Hessian

  using Storage = Linearisation<SymmetricMatrix>;
  Storage linearisation() const {
    return {0, 0, Vector::Zero(size), sparse(Dense::Zero(size, size))};
  }
  void linearise(const State& x, Hessian kind, Storage& out) const {
    out.energy = f(x);
    out.magnitude = std::abs(out.energy);
    out.gradient = slope(x);
    out.hessian.values =
        sparse(kind == Hessian::convex && convex ? convex(x) : curvature(x)).values;
  }
  void move(const State& x, const Vector& δ, State& out) const { out = x + δ; }
  bool conservative() const { return !skew; }
  bool dead_loads() const { return true; }  // as moments, which have no potential either
  void multiply_skew(const State& x, const Vector& v, Vector& out) const { out = skew(x) * v; }
  void multiplier_sizes(const State&, Vector& out) const { out.setOnes(size); }
  void rounding(const State&, Vector& out) const { out.setConstant(size, 1e-15); }
  Vector weights() const { return Vector::Constant(size, 1. / size); }
  Vector units() const { return Vector::Ones(size); }
  Vector stiffness() const { return Vector::Ones(size); }
  Vector softness() const { return Vector::Zero(size); }
  double unit_energy() const { return 1; }
  double least_shift() const { return 0; }
};

static_assert(Problem<FlatProblem>);

/// ½ xᵀA x − bᵀx.
inline FlatProblem quadratic(const Dense& A, const Vector& b) {
  return {int(b.size()), [=](const Vector& x) { return x.dot(A * x) / 2 - b.dot(x); },
          [=](const Vector& x) -> Vector { return A * x - b; }, [=](const Vector&) { return A; }};
}

/// Σ ¼ (x_i² − 1)², with a maximum at 0 and a minimum wherever all |x_i| = 1.
inline FlatProblem double_wells(int size) {
  return {
      size, [](const Vector& x) { return (x.array().square() - 1).square().sum() / 4; },
      [](const Vector& x) -> Vector { return x.array() * (x.array().square() - 1); },
      [](const Vector& x) -> Dense { return (3 * x.array().square() - 1).matrix().asDiagonal(); }};
}

/// Rosenbrock's banana: one minimum, at (1, 1), along a curved valley.
inline FlatProblem rosenbrock() {
  return {
      2,
      [](const Vector& x) { return 100 * std::pow(x[1] - x[0] * x[0], 2) + std::pow(1 - x[0], 2); },
      [](const Vector& x) -> Vector {
        const double d = x[1] - x[0] * x[0];
        return Vec<2>(-400 * x[0] * d - 2 * (1 - x[0]), 200 * d);
      },
      [](const Vector& x) -> Dense {
        Mat<2> H;
        H << 1200 * x[0] * x[0] - 400 * x[1] + 2, -400 * x[0], -400 * x[0], 200;
        return H;
      }};
}

}  // namespace pyrod::test
