// SPDX-License-Identifier: BSD-3-Clause
/// \file The few names for small vectors and matrices that every header uses.
#pragma once

#include <pyrod/core/flags.hpp>

namespace pyrod {

template <int N, class Real = double>
using Vec = Eigen::Matrix<Real, N, 1>;
template <int M, int N = M, class Real = double>
using Mat = Eigen::Matrix<Real, M, N>;
using Vec3 = Vec<3>;
using Mat3 = Mat<3>;
using Vector = Eigen::VectorXd;

/// One row per vertex or edge, contiguous: what NumPy calls an (n, N) array.
template <int N>
using Rows = Eigen::Matrix<double, Eigen::Dynamic, N, N == 1 ? Eigen::ColMajor : Eigen::RowMajor>;

}  // namespace pyrod
