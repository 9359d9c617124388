// SPDX-License-Identifier: BSD-3-Clause
#include "support/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace pyrod::test {

Dense dense(const SymmetricMatrix& A) {
  Dense out = Dense::Zero(A.size(), A.size());
  for (int k = 0; k < A.size(); ++k)
    for (int p = A.starts[k]; p < A.starts[k + 1]; ++p)
      out(A.rows[p], k) = out(k, A.rows[p]) = A.values[p];
  return out;
}

Vector eigenvalues(const Dense& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Dense>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

int negative_eigenvalues(const Dense& symmetric) {
  return int((eigenvalues(symmetric).array() < 0).count());
}

Vector solve_dense(const Dense& A, const Vector& b) { return A.fullPivLu().solve(b); }

}  // namespace pyrod::test
