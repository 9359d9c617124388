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
