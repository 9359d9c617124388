// SPDX-License-Identifier: BSD-3-Clause
/// \file Along which changes of its unknowns an equilibrium moves freely.
///
/// A mode without stiffness is either the direction of a whole curve of equilibria, or that in
/// which a critical one is about to leave. A step along it tells: from there Newton's method, held
/// where it is along all such modes, finds an equilibrium, or a force is left that holds it.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/tangent.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace pyrod {

template <class Space>
class FreeMotions {
 public:
  using Columns = Eigen::MatrixXd;

  /// `tangent`: at x.
  FreeMotions(const NetworkProblem<Space>& problem, const NetworkState<Space>& x,
              Tangent<NetworkProblem<Space>>& tangent)
      : problem_(problem), x_(x), factor_(tangent.factor()), stiffness_(factor_.stiffness()) {
    find_modes();
    for (int k = 0; k < modes_.cols() && free_; ++k)
      free_ = leads_to_equilibria(modes_.col(k)) && leads_to_equilibria(-modes_.col(k));
  }

  /// Whether all modes without stiffness are free motions.
  bool found() const { return free_ && modes_.cols() > 0; }
  /// In columns, orthonormal in the stiffness.
  const Columns& modes() const { return modes_; }

 private:
  static constexpr double nothing_ = 1e-8;  ///< a stiffness that is none, over that of the rods
  static constexpr double step_ = 0.03;     ///< [rad], or a part of a length
  static constexpr int most_ = 12;

  /// Modes of K v = λ diag(stiffness) v within what may be added to K.
  void find_modes() {
    factor_.factorise(-4e-6);
    const int up_to = factor_.index();
    factor_.factorise(4e-6);
    const int count = up_to - factor_.index();
    factor_.factorise(0);
    if (count <= 0 || count > most_ || factor_.broken()) return;
    iterate(count);
  }

  void iterate(int count) {
    const auto& K = factor_.matrix();
    Columns X(K.size(), count), KX = X;
    for (int k = 0; k < count; ++k)
      X.col(k) = Vector::LinSpaced(K.size(), 0.3 + k, 1.7 + (k + 1) * (k + 1)).array().sin();
    Eigen::GeneralizedSelfAdjointEigenSolver<Columns> ritz;
    Vector b, x;
    for (int i = 0; i < 6; ++i) {
      for (int k = 0; k < count; ++k) {
        b = stiffness_.cwiseProduct(X.col(k));
        factor_.solve(b, x);
        factor_.correct(b, x);
        X.col(k) = x / std::sqrt(x.cwiseAbs2().dot(stiffness_));
        K.multiply(X.col(k), b);
        KX.col(k) = b;
      }
      ritz.compute(X.transpose() * KX, X.transpose() * stiffness_.asDiagonal() * X);
      if (ritz.info() != Eigen::Success) return;
      X = (X * ritz.eigenvectors()).eval();
    }
    const auto& λ = ritz.eigenvalues();
    const auto none = (λ.array().abs() < nothing_).count();
    const auto first = (λ.array() <= -nothing_).count();
    modes_ = X.middleCols(first, none);
  }

  bool leads_to_equilibria(Vector mode) const {
    mode *= step_ / mode.cwiseProduct((stiffness_.array() > 0).template cast<double>().matrix())
                        .template lpNorm<Eigen::Infinity>();
    NetworkState<Space> y = x_, next = x_;
    problem_.move(x_, mode, y);
    Tangent<NetworkProblem<Space>> there(problem_);
    const Columns held = stiffness_.asDiagonal() * modes_;
    Columns W(held.rows(), held.cols());
    Vector δ, w;
    for (int i = 0; i < 10; ++i) {
      there.linearise(y, Hessian::exact);
      there.factor().factorise(0);
      if (there.factor().broken()) return false;
      there.factor().solve(there.gradient(), δ);
      for (int k = 0; k < held.cols(); ++k) {
        w = held.col(k);
        there.factor().solve(w, w);
        W.col(k) = w;
      }
      const Vector force = (held.transpose() * W).fullPivLu().solve(held.transpose() * δ);
      δ = W * force - δ;
      problem_.move(y, δ, next);
      std::swap(y, next);
      if (δ.template lpNorm<Eigen::Infinity>() > 1e-9) continue;
      return force.norm() < 1e-8 * std::sqrt(problem_.unit_energy());
    }
    return false;
  }

  const NetworkProblem<Space>& problem_;
  const NetworkState<Space>& x_;
  ShiftedFactor& factor_;
  const Vector& stiffness_;
  Columns modes_;
  bool free_ = true;
};

}  // namespace pyrod
