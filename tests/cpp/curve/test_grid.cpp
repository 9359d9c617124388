// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/grid.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

TEST_CASE("a grid of unequal edges") {
  const Grid grid(Vec<3>(1, 2, 4));
  CHECK(grid.edges() == 3);
  CHECK(grid.vertices() == 4);
  CHECK(grid.length() == 7);
  CHECK(grid.cell_lengths() == Vec<4>(0.5, 1.5, 3, 2));
  CHECK(grid.arc_lengths() == Vec<4>(0, 1, 3, 7));
  CHECK(grid.edge_lengths() == Vec<3>(1, 2, 4));
  CHECK(grid.h(2) == 4);
  CHECK(grid.Δs(2) == 3);
  CHECK(grid.s(2) == 3);
  CHECK(grid.centre(0) == 0.5);
  CHECK(grid.centre(2) == 5);
}

TEST_CASE("a grid of one edge has two half cells") {
  const Grid grid = Grid::uniform(3, 1);
  CHECK(grid.cell_lengths() == Vec<2>(1.5, 1.5));
  CHECK(grid.arc_lengths() == Vec<2>(0, 3));
}

TEST_CASE("a closed grid: as many vertices as edges, whole cells, and the last edge leads home") {
  const Grid grid(Vec<3>(1, 2, 4), Closure::closed);
  CHECK(grid.closed());
  CHECK(grid.closure() == Closure::closed);
  CHECK(grid.edges() == 3);
  CHECK(grid.vertices() == 3);
  CHECK(grid.length() == 7);
  CHECK(grid.cell_lengths() == Vec<3>(2.5, 1.5, 3));
  CHECK(grid.arc_lengths() == Vec<4>(0, 1, 3, 7));
  CHECK(grid.next(0) == 1);
  CHECK(grid.next(1) == 2);
  CHECK(grid.next(2) == 0);
  CHECK(grid.centre(2) == 5);
}

TEST_CASE("closed grids of one and of two edges") {
  const Grid one(Vec<1>(3), Closure::closed), two(Vec<2>(1, 3), Closure::closed);
  CHECK(one.vertices() == 1);
  CHECK(one.next(0) == 0);
  CHECK(one.cell_lengths() == Vec<1>(3));
  CHECK(two.vertices() == 2);
  CHECK(two.next(0) == 1);
  CHECK(two.next(1) == 0);
  CHECK(two.cell_lengths() == Vec<2>(2, 2));
}

TEST_CASE("an open grid's last edge leads to the last vertex") {
  const Grid grid = Grid::uniform(1, 3);
  CHECK_FALSE(grid.closed());
  CHECK(grid.next(2) == 3);
  CHECK(Grid(Vec<1>(3)).next(0) == 1);
  CHECK(Grid(Vec<2>(1, 3)).cell_lengths() == Vec<3>(0.5, 2, 1.5));
}

TEST_CASE("a million unequal edges: places along them are right to rounding") {
  Random random(2);
  for (const Closure closure : {Closure::open, Closure::closed}) {
    const Grid grid(random.grid(1000000).edge_lengths(), closure);
    long double sum = 0;
    double worst = 0;
    for (int j = 0; j < grid.edges(); ++j) {
      sum += static_cast<long double>(grid.h(j));
      worst = std::max(worst, std::abs(double(sum - static_cast<long double>(grid.s(j + 1)))));
    }
    CHECK(worst <= 2.3e-16);
    CHECK(grid.cell_lengths().sum() == doctest::Approx(1).epsilon(1e-13));
  }
}

TEST_CASE("cells and edges fill the rod, and the cells meet at the centres of the edges") {
  Random random(1);
  const Grid grid = random.grid(50, 7);
  CHECK(grid.edge_lengths().sum() == doctest::Approx(7).epsilon(1e-15));
  CHECK(grid.cell_lengths().sum() == doctest::Approx(7).epsilon(1e-15));
  for (int j = 1; j < grid.edges(); ++j)
    CHECK(std::abs(grid.centre(j) - grid.centre(j - 1) - grid.Δs(j)) < 1e-14);
}

TEST_CASE("a million equal edges end where they should") {
  for (const double length : {1., 0.1, 3.4e-8, 1e4 / 3}) {
    const Grid grid = Grid::uniform(length, 1000000);
    CHECK(grid.length() == length);
    CHECK(grid.s(500000) == length / 2);
    const Grid given(grid.edge_lengths());
    CHECK(std::abs(given.length() - length) <= 3e-16 * length);
  }
  for (int n = 1; n < 300; ++n) CHECK(Grid::uniform(0.3, n).length() == 0.3);
}

TEST_CASE("a place on the rod: within rounding of an end it is the end") {
  const Grid grid = Grid::uniform(2, 4);
  CHECK(grid.on_rod(0.3) == 0.3);
  CHECK(grid.on_rod(2 + 1e-12) == 2);
  CHECK(grid.on_rod(2 - 1e-12) == 2);
  CHECK(grid.on_rod(2 - 1e-11) == 2 - 1e-11);
  CHECK(grid.on_rod(-1e-12) == 0);
  CHECK_REFUSED("at: must be an arc length on the rod, in [0, 2], got 2.1", grid.on_rod(2.1));
  CHECK_REFUSED("at:", grid.on_rod(-0.1));
  CHECK_REFUSED("at:", grid.on_rod(std::nan("")));
}

TEST_CASE("what no grid can be made of is refused by name") {
  CHECK_REFUSED("edge_lengths: a rod needs at least one edge", Grid(Vector()));
  CHECK_REFUSED("edge_lengths[1]: must be positive, got 0", Grid(Vec<3>(1, 0, 1)));
  CHECK_REFUSED("edge_lengths[2]: must be positive, got -1", Grid(Vec<3>(1, 1, -1)));
  CHECK_REFUSED("edge_lengths[0]: expected finite", Grid(Vec<2>(std::nan(""), 1)));
  CHECK_REFUSED("edges: must be at least 1, got 0", Grid::uniform(1, 0));
  CHECK_REFUSED("edges:", Grid::uniform(1, -3));
  CHECK_REFUSED("length: must be positive, got 0", Grid::uniform(0, 3));
  CHECK_REFUSED("length:", Grid::uniform(-1, 3));
  CHECK_REFUSED("length:", Grid::uniform(std::numeric_limits<double>::infinity(), 3));
}
