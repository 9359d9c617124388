// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/averages.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

using Values = std::vector<double>;

template <class F>
Values on_centres(const Grid& grid, const F& f) {
  Values out;
  for (int j = 0; j < grid.edges(); ++j) out.push_back(f(grid.centre(j)));
  return out;
}

}  // namespace

TEST_CASE("what is linear along an open grid is met exactly at vertices, also at the ends") {
  Random random(1);
  for (const int n : {2, 3, 50}) {
    const Grid grid = random.grid(n, 2);
    const auto line = [](double s) { return 3 - 5 * s; };
    const Values x = at_vertices(grid, on_centres(grid, line));
    REQUIRE(int(x.size()) == n + 1);
    for (int j = 0; j <= n; ++j) CHECK(std::abs(x[j] - line(grid.s(j))) < 2e-14);
  }
}

TEST_CASE("what is linear is met exactly at the centres") {
  Random random(2);
  const Grid grid = random.grid(20, 2);
  Values x;
  for (int j = 0; j <= 20; ++j) x.push_back(1 + 2 * grid.s(j));
  const Values centres = at_centres(grid, x);
  REQUIRE(centres.size() == 20);
  for (int j = 0; j < 20; ++j) CHECK(std::abs(centres[j] - 1 - 2 * grid.centre(j)) < 1e-15);
}

TEST_CASE("of a square, the product of the distances to the two centres is too much") {
  Random random(3);
  const Grid grid = random.grid(20, 2);
  const Values x = at_vertices(grid, on_centres(grid, [](double s) { return s * s; }));
  for (int j = 1; j < 20; ++j)
    CHECK(std::abs(x[j] - std::pow(grid.s(j), 2) - grid.h(j - 1) * grid.h(j) / 4) < 4e-15);
  const auto beyond = [&](double end, double next) { return end / 2 * (end + next / 2); };
  CHECK(std::abs(x[0] + beyond(grid.h(0), grid.h(1))) < 1e-15);
  CHECK(std::abs(x[20] - 4 + beyond(grid.h(19), grid.h(18))) < 1e-14);
}

TEST_CASE("around a closed grid: linear between neighbours, also across the start") {
  Random random(4);
  for (const int n : {2, 3, 30}) {
    const Grid grid(random.grid(n, 2).edge_lengths(), Closure::closed);
    Values x = on_centres(grid, [](double s) { return s; });
    Values found = at_vertices(grid, x);
    REQUIRE(int(found.size()) == n);
    for (int j = 1; j < n; ++j) CHECK(std::abs(found[j] - grid.s(j)) < 1e-15);
    x.back() -= 2;  // the last edge seen from the start: before it
    CHECK(std::abs(at_vertices(grid, x)[0]) < 1e-15);
    Values at(std::size_t(n), 0);
    at[0] = 6;
    found = at_centres(grid, at);
    CHECK(found.front() == 3);
    CHECK(found.back() == 3);
  }
}

TEST_CASE("one edge: nothing to interpolate") {
  const Grid open(Vec<1>(3)), closed(Vec<1>(3), Closure::closed);
  CHECK(at_vertices(open, Values{7}) == Values{7, 7});
  CHECK(at_vertices(closed, Values{7}) == Values{7});
  CHECK(at_centres(open, Values{1, 2}) == Values{1.5});
  CHECK(at_centres(closed, Values{4}) == Values{4});
}

TEST_CASE("two edges by hand") {
  const Vec<2> h(2, 4);  // centres 1 and 4
  CHECK(at_vertices(Grid(h), Values{10, 13}) == Values{9, 11, 15});
  // closed: vertex 0 is 1 from the centre of edge 0 and 2 from that of edge 1
  CHECK(at_vertices(Grid(h, Closure::closed), Values{10, 13}) == Values{11, 11});
  CHECK(at_centres(Grid(h, Closure::closed), Values{10, 20}) == Values{15, 15});
}

TEST_CASE("vectors are averaged like numbers") {
  Random random(5);
  for (const Closure closure : {Closure::open, Closure::closed}) {
    const Grid grid(random.grid(8).edge_lengths(), closure);
    std::vector<Vec3> x;
    Values y;
    for (int j = 0; j < 8; ++j) x.push_back(random.vector<3>()), y.push_back(x[j].y());
    const auto vectors = at_vertices(grid, x);
    const Values numbers = at_vertices(grid, y);
    for (std::size_t j = 0; j < numbers.size(); ++j) CHECK(vectors[j].y() == numbers[j]);
  }
}
