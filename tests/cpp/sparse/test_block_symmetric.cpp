// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/sparse/block_symmetric.hpp>

#include "support/matrices.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Blocks of the sizes 1, 2 and 3, any of them coupled to any before.
struct Pattern {
  std::vector<int> sizes, first{0};
  std::vector<std::vector<int>> above;

  Pattern(Random& random, int blocks) {
    for (int J = 0; J < blocks; ++J) {
      sizes.push_back(1 + int(3 * random.number(0, 1)));
      first.push_back(first.back() + sizes.back());
      above.emplace_back();
      for (int I = J; I-- > 0;)  // falling, the matrix has to sort them
        if (random.number() > 0) above.back().push_back(I);
    }
  }

  int entries() const {
    int count = 0;
    for (std::size_t J = 0; J < sizes.size(); ++J) {
      count += sizes[J] * (sizes[J] + 1) / 2;
      for (const int I : above[J]) count += sizes[I] * sizes[J];
    }
    return count;
  }

  auto block(Dense& A, int I, int J) const {
    return A.block(first[I], first[J], sizes[I], sizes[J]);
  }
};

Dense random_block(Random& random, int rows, int columns) {
  return Dense::NullaryExpr(rows, columns, [&] { return random.number(); });
}

}  // namespace

TEST_CASE("blocks of any sizes in any pattern are the dense matrix they stand for") {
  Random random(1);
  for (const int blocks : {1, 2, 3, 10, 30}) {
    CAPTURE(blocks);
    const Pattern pattern(random, blocks);
    BlockSymmetric A(pattern_of(pattern.sizes, pattern.above));
    Dense upper = Dense::Zero(A.size(), A.size());
    for (int round = 0; round < 2; ++round)  // the second is added to the first
      for (int J = 0; J < blocks; ++J) {
        for (const int I : pattern.above[J]) {
          const Dense block = random_block(random, pattern.sizes[I], pattern.sizes[J]);
          A.add(I, J, block);
          pattern.block(upper, I, J) += block;
        }
        Dense block = random_block(random, pattern.sizes[J], pattern.sizes[J]);
        pattern.block(upper, J, J) += block.triangularView<Eigen::Upper>().toDenseMatrix();
        block.triangularView<Eigen::StrictlyLower>().setConstant(std::nan(""));  // not read
        A.add_diagonal(J, block);
      }
    const Dense expected = upper.selfadjointView<Eigen::Upper>();
    CHECK(distance(dense(A), expected) == 0);
    const Vector x = random.vector(A.size());
    Vector out;
    A.multiply(x, out);
    CHECK(distance(out, expected * x) < 1e-14 * expected.norm());
    A.set_zero(0, A.size());
    CHECK(dense(A).norm() == 0);
  }
}

TEST_CASE("the pattern: sizes, first rows, entries by number, in the order that CHOLMOD wants") {
  Random random(2);
  for (const int blocks : {1, 4, 25}) {
    const Pattern pattern(random, blocks);
    BlockSymmetric A(pattern_of(pattern.sizes, pattern.above));
    CHECK(A.size() == pattern.first.back());
    CHECK(int(A.values.size()) == pattern.entries());
    CHECK(A.rows.size() == A.values.size());
    for (int J = 0; J < blocks; ++J) {
      CHECK(A.first(J) == pattern.first[J]);
      CHECK(A.size_of(J) == pattern.sizes[J]);
    }
    for (int k = 0; k < A.size(); ++k) {
      for (int p = A.starts[k] + 1; p < A.starts[k + 1]; ++p) CHECK(A.rows[p - 1] < A.rows[p]);
      CHECK(A.rows[A.starts[k + 1] - 1] == k);
      A.diagonal(k) = k + 1;
    }
    const Vector numbers = Vector::LinSpaced(A.size(), 1, A.size());
    CHECK(distance(dense(A), Dense(numbers.asDiagonal())) == 0);
  }
}

TEST_CASE("blocks of a fixed size, and of one row or column, are added as dense ones") {
  BlockSymmetric A(pattern_of({3, 1, 2}, {{}, {0}, {1, 0}}));
  Mat<3, 2> B;
  B << 1, 2, 3, 4, 5, 6;
  A.add(0, 1, Vec3(7, 8, 9));
  A.add(0, 2, B);
  A.add(1, 2, Vec<2>(10, 11).transpose());
  A.add_diagonal(1, Mat<1>(12.));
  Dense expected = Dense::Zero(6, 6);
  expected.block<3, 1>(0, 3) = Vec3(7, 8, 9);
  expected.block<3, 2>(0, 4) = B;
  expected.block<1, 2>(3, 4) << 10, 11;
  expected(3, 3) = 12;
  CHECK(distance(dense(A), Dense(expected.selfadjointView<Eigen::Upper>())) == 0);
}

TEST_CASE("of a larger block only what fits is read") {
  BlockSymmetric A(pattern_of({2, 1}, {{}, {0}}));
  Mat3 B;
  B << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  A.add(0, 1, B);
  A.add_diagonal(0, B);
  A.add_diagonal(1, Mat3(10 * B));
  Mat3 expected;
  expected << 1, 2, 1, 2, 5, 4, 1, 4, 10;
  CHECK(distance(dense(A), Dense(expected)) == 0);
}

TEST_CASE("columns lead to the entries of a block, and can be cleared by themselves") {
  Random random(3);
  const Pattern pattern(random, 12);
  BlockSymmetric A(pattern_of(pattern.sizes, pattern.above));
  for (int J = 0; J < 12; ++J) {
    const int row = A.first(J), size = A.size_of(J);
    const auto columns = A.columns(row);
    for (int k = 0; k < size; ++k)
      for (int i = 0; i <= columns.above + k; ++i)
        columns[k][i] = A.rows[A.starts[row + k] + i] + 100 * (row + k);
  }
  for (int k = 0; k < A.size(); ++k)
    for (int p = A.starts[k]; p < A.starts[k + 1]; ++p) CHECK(A.values[p] == A.rows[p] + 100 * k);
  const int from = A.first(4), end = A.first(7);
  Dense expected = dense(A);
  for (int k = from; k < end; ++k) {
    expected.row(k).head(k + 1).setZero();
    expected.col(k).head(k + 1).setZero();
  }
  A.set_zero(from, end);
  CHECK(distance(dense(A), expected) == 0);
}

TEST_CASE("a chain of equal blocks has the pattern of the block tridiagonal matrix") {
  std::vector<int> starts{0}, rows;
  for (int j = 0; j < 5; ++j)
    for (int k = 0; k < 3; ++k) {
      for (int i = (j == 0 ? 0 : -3); i <= k; ++i) rows.push_back(3 * j + i);
      starts.push_back(int(rows.size()));
    }
  const BlockSymmetric A(pattern_of({3, 3, 3, 3, 3}, {{}, {0}, {1}, {2}, {3}}));
  CHECK(A.starts == starts);
  CHECK(A.rows == rows);
}

TEST_CASE("couplings in any order, and more than once, are the same pattern") {
  const BlockPattern pattern({1, 2, 3}, {{1, 2}, {0, 1}, {0, 2}, {1, 2}, {0, 2}});
  CHECK(pattern.starts == std::vector{0, 0, 1, 3});
  CHECK(pattern.above == std::vector{0, 0, 1});
  CHECK(pattern == pattern_of({1, 2, 3}, {{}, {0}, {1, 0}}));
  CHECK(pattern != pattern_of({1, 2, 3}, {{}, {0}, {1}}));
  CHECK(pattern != pattern_of({1, 2, 2}, {{}, {0}, {1, 0}}));
  CHECK(BlockPattern({2}, {}).blocks() == 1);
}
