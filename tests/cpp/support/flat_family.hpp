// SPDX-License-Identifier: BSD-3-Clause
/// \file Families for paths that have nothing to do with rods: their equilibria are known.
#pragma once

#include "support/flat_problem.hpp"
#include "support/random.hpp"

#include <pyrod/solve/family.hpp>

#include <Eigen/QR>

#include <functional>

namespace pyrod::test {

/// P(y, λ) of one of several coordinates, by its derivatives.
struct OneCoordinate {
  std::function<double(double, double)> y, yy, yλ;  ///< of y and λ
};

/// P(y₀, λ) + ½ Σ a_k (y_k − c_k y₀²)² with y = Q x: in equilibrium P_y = 0 and y_k = c_k y₀². With
/// `skew`, forces skew Z x that have no potential.
struct FlatFamily {
  using State = Vector;
  using Storage = Linearisation<SymmetricMatrix>;

  OneCoordinate P;
  Dense Q;
  Vector a, c;
  Dense Z = {};
  double λ = 0;

  FlatFamily(OneCoordinate one, int size, unsigned seed = 1) : P(std::move(one)) {
    Random random(seed);
    Q = Eigen::HouseholderQR<Dense>(random_dense(random, size)).householderQ();
    a = Vector::LinSpaced(size, 0, 5).array() + 2;
    c = 0.3 * random.vector(size);
    a[0] = c[0] = 0;
  }

  int size() const { return int(a.size()); }
  /// The equilibrium with this y₀.
  State at(double y0) const {
    Vector y = y0 * y0 * c;
    y[0] = y0;
    return Q.transpose() * y;
  }
  double first(const State& x) const { return Q.row(0).dot(x); }

  void set(double to) { λ = to; }
  void place(State&) const {}
  void slope(const State& x, Vector& out) const { out = Q.row(0).transpose() * P.yλ(first(x), λ); }
  double amplitude(const State& from, const State& to, const Vector& mode, Vector& gradient) const {
    gradient = mode.cwiseProduct(weights());
    return gradient.dot(to - from);
  }

  Storage linearisation() const {
    return {0, 0, Vector::Zero(size()), sparse(Dense::Zero(size(), size()))};
  }
  void linearise(const State& x, Hessian, Storage& out) const {
    const Vector y = Q * x;
    Vector g = a.cwiseProduct(y - y[0] * y[0] * c);
    Dense H = a.asDiagonal();
    const Vector lever = 2 * y[0] * c;  // of y_k − c_k y₀² in y₀, but for its sign
    H(0, 0) = P.yy(y[0], λ) - 2 * c.dot(g) + a.dot(lever.cwiseProduct(lever));
    for (int k = 1; k < size(); ++k) H(k, 0) = H(0, k) = -a[k] * lever[k];
    g[0] = P.y(y[0], λ) - lever.dot(g);
    out.energy = out.magnitude = 0;
    out.gradient = Q.transpose() * g;
    if (Z.size() > 0) out.gradient += Z * x;
    out.hessian.values = sparse(Q.transpose() * H * Q).values;
  }
  void move(const State& x, const Vector& δ, State& out) const { out = x + δ; }
  bool conservative() const { return Z.size() == 0; }
  bool dead_loads() const { return true; }
  void multiply_skew(const State&, const Vector& v, Vector& out) const { out = Z * v; }
  void multiplier_sizes(const State&, Vector& out) const { out.setOnes(size()); }
  void rounding(const State&, Vector& out) const { out.setConstant(size(), 1e-15); }
  Vector weights() const { return Vector::Constant(size(), 1. / size()); }
  Vector units() const { return Vector::Ones(size()); }
  Vector stiffness() const { return Vector::Ones(size()); }
  Vector softness() const { return Vector::Zero(size()); }
  double unit_energy() const { return 1; }
  double least_shift() const { return 0; }
};

static_assert(Family<FlatFamily>);

}  // namespace pyrod::test
