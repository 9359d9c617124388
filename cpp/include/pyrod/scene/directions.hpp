// SPDX-License-Identifier: BSD-3-Clause
/// \file Directions in which something may move, and what is left of them.
#pragma once

#include <pyrod/core/types.hpp>

#include <cmath>

namespace pyrod {

/// Up to N independent directions, as columns.
template <int N>
using Directions =
    Eigen::Matrix<double, N, Eigen::Dynamic, N == 1 ? Eigen::RowMajor : Eigen::ColMajor, N, N>;

namespace detail {

/// The columns of A turned so that the first is along A d, without that: Householder's reflection.
template <int N>
Directions<N> across(const Directions<N>& A, const Eigen::VectorXd& d) {
  Eigen::VectorXd v = d.normalized();
  v[0] += std::copysign(1., v[0]);
  const Eigen::VectorXd Av = A * v;
  const auto rest = v.size() - 1;
  return A.rightCols(rest) - 2 / v.squaredNorm() * Av * v.tail(rest).transpose();
}

/// An orthonormal basis of the vectors of span(A) that `rows` maps to zero: one after the other,
/// the direction is left out that a row tells most of.
template <int N>
Directions<N> kernel_within(Directions<N> A, const Eigen::MatrixXd& rows) {
  while (A.cols() > 0 && rows.rows() > 0) {
    const Eigen::MatrixXd M = rows * A;
    Eigen::Index most = 0;
    if (!(M.rowwise().norm().maxCoeff(&most) > 1e-9)) break;
    A = across<N>(A, M.row(most).transpose());
  }
  return A;
}

/// The directions of span(A) across those of span(B).
template <int N>
Directions<N> without(const Directions<N>& A, const Directions<N>& B) {
  return kernel_within<N>(A, B.transpose());
}

}  // namespace detail

}  // namespace pyrod
