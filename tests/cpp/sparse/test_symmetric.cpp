// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/sparse/block_symmetric.hpp>

#include "support/dense.hpp"
#include "support/matrices.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

TEST_CASE_TEMPLATE("a chain of blocks is the dense matrix it stands for", Size,
                   std::integral_constant<int, 1>, std::integral_constant<int, 3>) {
  constexpr int B = Size::value;
  Random random(1);
  for (const int blocks : {1, 2, 6}) {
    BlockSymmetric A = chain_of(B, blocks);
    const auto chain = A.template chain<B>(0, blocks);
    Dense expected = Dense::Zero(B * blocks, B * blocks);
    Mat<B, B, Pack<4>> above_lanes, diagonal_lanes;
    for (int j = 0; j < blocks; ++j) {
      Mat<B> above = Mat<B>::NullaryExpr([&] { return random.number(); });
      Mat<B> diagonal = Mat<B>::NullaryExpr([&] { return random.number(); });
      for (int i = 0; i < B * B; ++i) {
        above_lanes(i).values[j % 4] = above(i);
        diagonal_lanes(i).values[j % 4] = diagonal(i);
      }
      if (j % 4 == 3 || j == blocks - 1)
        chain.set(j / 4 * 4, j % 4 + 1, above_lanes, diagonal_lanes);
      const Mat<B> symmetric = diagonal.template selfadjointView<Eigen::Upper>();
      expected.block<B, B>(B * j, B * j) = symmetric;
      if (j == 0) continue;
      expected.block<B, B>(B * (j - 1), B * j) = above;
      expected.block<B, B>(B * j, B * (j - 1)) = above.transpose();
    }
    CHECK(A.size() == B * blocks);
    CHECK(int(A.values.size()) == blocks * B * (B + 1) / 2 + (blocks - 1) * B * B);
    CHECK(distance(dense(A), expected) == 0);
    for (int k = 0; k < A.size(); ++k)
      for (int p = A.starts[k]; p < A.starts[k + 1]; ++p) {
        CHECK(A.rows[p] <= k);
        if (p > A.starts[k]) CHECK(A.rows[p - 1] < A.rows[p]);
      }

    const Vector x = random.vector(A.size());
    Vector out = Vector::Constant(3, 7);  // size and contents do not matter
    A.multiply(x, out);
    CHECK(distance(out, expected * x) < 1e-14);
  }
}

TEST_CASE("the empty matrix") { CHECK(SymmetricMatrix().size() == 0); }
