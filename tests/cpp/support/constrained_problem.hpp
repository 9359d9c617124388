// SPDX-License-Identifier: BSD-3-Clause
/// \file Problems with constraints that have nothing to do with rods.
#pragma once

#include "support/matrices.hpp"

#include <pyrod/solve/problem.hpp>

#include <functional>

namespace pyrod::test {

/// Stationary points of f(x) + λ·c(x), possibly with forces that have no potential. A state is x,
/// then λ.
struct ConstrainedProblem {
  using State = Vector;
  using Storage = Linearisation<SymmetricMatrix>;

  int size, constraints;
  std::function<double(const Vector&)> f;
  std::function<Vector(const Vector&)> slope;
  std::function<Dense(const Vector&)> curvature;
  std::function<Vector(const Vector&)> c;
  std::function<Dense(const Vector&)> slopes;                 ///< ∂c/∂x
  std::function<Dense(const Vector&, const Vector&)> bent{};  ///< Σ λ_i ∂²c_i/∂x², none: linear c
  std::function<Dense(const Vector&)> skew{};                 ///< forces Z(x) x
  Vector mass = Vector::Constant(size, 1. / size);
  double unit = 1;

  Storage linearisation() const {
    const int all = size + constraints;
    return {0, 0, Vector::Zero(all), sparse(Dense::Zero(all, all))};
  }
  void linearise(const State& state, Hessian, Storage& out) const {
    const Vector x = state.head(size), λ = state.tail(constraints);
    const Dense C = slopes(x);
    out.energy = f(x) + λ.dot(c(x));
    out.magnitude = std::abs(f(x)) + std::abs(λ.dot(c(x)));
    out.gradient << slope(x) + C.transpose() * λ, c(x);
    if (skew) out.gradient.head(size) += skew(x) * x;
    out.hessian.values = sparse(matrix(x, λ)).values;
  }
  void move(const State& x, const Vector& δ, State& out) const { out = x + δ; }
  bool conservative() const { return !skew; }
  bool dead_loads() const { return !skew; }
  void multiply_skew(const State& x, const Vector& v, Vector& out) const {
    out.setZero(v.size());
    out.head(size) = skew(x.head(size)) * v.head(size);
  }
  Vector weights() const {
    Vector out(size + constraints);
    out << mass, Vector::Zero(constraints);
    return out;
  }
  double unit_energy() const { return unit; }
  Vector units() const { return Vector::Constant(size + constraints, unit); }
  Vector stiffness() const { return unit * weights(); }
  Vector softness() const {
    Vector out(size + constraints);
    out << Vector::Zero(size), Vector::Constant(constraints, 1e-10 * unit);
    return out;
  }
  void multiplier_sizes(const State& state, Vector& out) const {
    out.tail(constraints) = 1 + state.tail(constraints).array().abs();  // c is in `unit`, λ is not
  }
  void rounding(const State&, Vector& out) const {
    out.setConstant(size + constraints, 1e-15 * unit);
  }
  double least_shift() const { return 1e-6; }

  /// The Hessian of f + λ·c in x.
  Dense primal(const Vector& x, const Vector& λ) const {
    return bent ? Dense(curvature(x) + bent(x, λ)) : curvature(x);
  }
  Dense matrix(const Vector& x, const Vector& λ) const {
    const Dense C = slopes(x);
    Dense out = Dense::Zero(size + constraints, size + constraints);
    out.topLeftCorner(size, size) = primal(x, λ);
    out.topRightCorner(size, constraints) = C.transpose();
    out.bottomLeftCorner(constraints, size) = C;
    return out;
  }
};

static_assert(Problem<ConstrainedProblem>);

/// ½ xᵀA x − b·x with C x = d.
inline ConstrainedProblem quadratic_program(const Dense& A, const Vector& b, const Dense& C,
                                            const Vector& d) {
  return {int(A.rows()),
          int(C.rows()),
          [=](const Vector& x) { return x.dot(A * x) / 2 - b.dot(x); },
          [=](const Vector& x) -> Vector { return A * x - b; },
          [=](const Vector&) { return A; },
          [=](const Vector& x) -> Vector { return C * x - d; },
          [=](const Vector&) { return C; }};
}

/// ½ xᵀA x on the unit sphere: equilibria are the eigenvectors of A, with −λ the eigenvalue, and
/// the index of the k-th is k.
inline ConstrainedProblem on_sphere(const Dense& A) {
  const int n = int(A.rows());
  return {n,
          1,
          [=](const Vector& x) { return x.dot(A * x) / 2; },
          [=](const Vector& x) -> Vector { return A * x; },
          [=](const Vector&) { return A; },
          [](const Vector& x) -> Vector { return Vector::Constant(1, (x.squaredNorm() - 1) / 2); },
          [](const Vector& x) -> Dense { return x.transpose(); },
          [=](const Vector&, const Vector& λ) -> Dense { return λ[0] * Dense::Identity(n, n); }};
}

/// Eigenvalues of A v = λ M v on the kernel of C, rising, and the vectors.
struct ProjectedModes {
  Vector eigenvalues;
  Dense shapes;
};
ProjectedModes projected_modes(const Dense& A, const Vector& M, const Dense& C);

}  // namespace pyrod::test
