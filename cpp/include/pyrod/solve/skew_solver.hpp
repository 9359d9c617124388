// SPDX-License-Identifier: BSD-3-Clause
/// \file Linear systems near others that can be solved: those of Newton's method that are not
/// symmetric, with the factor of their symmetric part, and bordered ones.
#pragma once

#include <pyrod/core/types.hpp>

#include <Eigen/SparseCore>
#include <unsupported/Eigen/IterativeSolvers>

#include <concepts>
#include <functional>
#include <utility>

namespace pyrod {
class SkewCorrected;
}

namespace Eigen::internal {
template <>
struct traits<pyrod::SkewCorrected> : traits<SparseMatrix<double>> {};
}  // namespace Eigen::internal

namespace pyrod {

/// The operator I + H⁻¹ Z, where systems with H can be solved and Z is what they leave out. A dead
/// moment on one edge gives Z rank 2, so that GMRES ends after three products; moments along the
/// rod give a compact operator, and few more.
class SkewCorrected : public Eigen::EigenBase<SkewCorrected> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum {
    ColsAtCompileTime = Eigen::Dynamic,
    MaxColsAtCompileTime = Eigen::Dynamic,
    IsRowMajor = false
  };

  /// From one vector to another; solutions may take the place of right-hand sides.
  using Map = std::function<void(const Vector&, Vector&)>;

  SkewCorrected(Map solve_H, Map Z, Eigen::Index size)
      : solve_(std::move(solve_H)), Z_(std::move(Z)), size_(size) {}
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }

  template <class Right>
  Eigen::Product<SkewCorrected, Right, Eigen::AliasFreeProduct> operator*(
      const Eigen::MatrixBase<Right>& x) const {
    return {*this, x.derived()};
  }

  void apply(const Vector& x, Vector& out) const {
    Z_(x, out);
    solve_(out, out);
    out += x;
  }

  /// Overwrites δ = H⁻¹ b by the solution of (H + Z) δ = b. A template, so that only who calls it
  /// compiles GMRES.
  template <std::same_as<Vector> V>
  void correct(V& δ) const {
    Eigen::GMRES<SkewCorrected, Eigen::IdentityPreconditioner> gmres(*this);
    gmres.setTolerance(1e-13);
    gmres.setMaxIterations(100);
    δ = gmres.solveWithGuess(δ, δ).eval();
  }

 private:
  Map solve_, Z_;
  Eigen::Index size_;
};

}  // namespace pyrod

namespace Eigen::internal {
template <class Right>
struct generic_product_impl<pyrod::SkewCorrected, Right, SparseShape, DenseShape, GemvProduct>
    : generic_product_impl_base<pyrod::SkewCorrected, Right,
                                generic_product_impl<pyrod::SkewCorrected, Right>> {
  template <class Out>
  static void scaleAndAddTo(Out& out, const pyrod::SkewCorrected& A, const Right& x,
                            const double& factor) {
    pyrod::Vector product(x.size());
    A.apply(x, product);
    out += factor * product;
  }
};
}  // namespace Eigen::internal
