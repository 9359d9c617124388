// SPDX-License-Identifier: BSD-3-Clause
/// \file Dense matrices to compare with, compiled once.
#pragma once

#include <pyrod/sparse/symmetric.hpp>

namespace pyrod::test {

using Dense = Eigen::MatrixXd;

/// Both triangles.
Dense dense(const SymmetricMatrix& A);

/// Rising.
Vector eigenvalues(const Dense& symmetric);

/// How many eigenvalues are below zero.
int negative_eigenvalues(const Dense& symmetric);

Vector solve_dense(const Dense& A, const Vector& b);

}  // namespace pyrod::test
