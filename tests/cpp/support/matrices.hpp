// SPDX-License-Identifier: BSD-3-Clause
/// \file Sparse matrices for tests.
#pragma once

#include <pyrod/sparse/block_symmetric.hpp>

#include "support/dense.hpp"
#include "support/random.hpp"

namespace pyrod::test {

/// All of a dense matrix's upper triangle.
inline SymmetricMatrix sparse(const Dense& A) {
  SymmetricMatrix out;
  for (int k = 0; k < A.cols(); ++k) {
    for (int i = 0; i <= k; ++i) {
      out.rows.push_back(i);
      out.values.push_back(A(i, k));
    }
    out.starts.push_back(int(out.rows.size()));
  }
  return out;
}

inline Dense random_dense(Random& random, int size) {
  return Dense::NullaryExpr(size, size,
                            [&](Eigen::Index, Eigen::Index) { return random.number(); });
}
inline Dense random_symmetric(Random& random, int size) {
  const Dense A = random_dense(random, size);
  return A + A.transpose();
}
inline Dense random_skew(Random& random, int size) {
  const Dense A = random_dense(random, size);
  return A - A.transpose();
}
inline Dense random_positive(Random& random, int size) {
  const Dense A = random_dense(random, size);
  return A * A.transpose() + Dense::Identity(size, size);
}

/// Of blocks of these sizes, each coupled to those of its list.
inline BlockPattern pattern_of(const std::vector<int>& sizes,
                               const std::vector<std::vector<int>>& above) {
  std::vector<std::pair<int, int>> couplings;
  for (std::size_t J = 0; J < sizes.size(); ++J)
    for (const int I : above[J]) couplings.emplace_back(I, int(J));
  return {sizes, couplings};
}

/// Of blocks of this size, each coupled to the one before it.
inline BlockSymmetric chain_of(int size, int blocks) {
  std::vector<std::vector<int>> above(1);
  for (int J = 1; J < blocks; ++J) above.push_back({J - 1});
  return BlockSymmetric(pattern_of(std::vector(std::size_t(blocks), size), above));
}

template <int B>
BlockSymmetric random_chain(Random& random, int blocks) {
  BlockSymmetric A = chain_of(B, blocks);
  for (auto& value : A.values) value = random.number();
  return A;
}

}  // namespace pyrod::test
