// SPDX-License-Identifier: BSD-3-Clause
#include "support/constrained_problem.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace pyrod::test {

ProjectedModes projected_modes(const Dense& A, const Vector& M, const Dense& C) {
  const Dense Z =
      C.rows() > 0 ? Dense(C.fullPivLu().kernel()) : Dense(Dense::Identity(A.rows(), A.rows()));
  const Dense mass = M.asDiagonal();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Dense> solver(Z.transpose() * A * Z,
                                                               Z.transpose() * mass * Z);
  return {solver.eigenvalues(), Z * solver.eigenvectors()};
}

}  // namespace pyrod::test
