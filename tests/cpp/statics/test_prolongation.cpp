// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/start/prolongation.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

#include <numbers>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Every edge in two.
Grid halved(const Grid& grid) {
  Vector h(2 * grid.edges());
  for (int j = 0; j < grid.edges(); ++j) h[2 * j] = h[2 * j + 1] = grid.h(j) / 2;
  return Grid(h);
}

/// Edges whose lengths vary smoothly, of length 1.
Grid graded(int edges) {
  const auto s = [&](int j) {
    const double x = double(j) / edges;
    return x + 0.1 * std::sin(2 * std::numbers::pi * x);
  };
  return Grid(
      Vector::NullaryExpr(edges, [&](Eigen::Index j) { return s(int(j) + 1) - s(int(j)); }));
}

template <class Frame>
auto at_centres(const Grid& grid, const Frame& frame) {
  std::vector<decltype(frame(0.))> out;
  for (int j = 0; j < grid.edges(); ++j) out.push_back(frame(grid.centre(j)));
  return out;
}

Angle cubic(double s) { return {0.3 - 2 * s + 4 * s * s - 1.5 * s * s * s}; }

Quaternion winding(double s) {
  return exp(Vec3(std::sin(3 * s), s * s, 1 - 2 * s)) * exp(Vec3(0, 0, 4 * s));
}

/// What the errors of a scheme of second order look like: smooth.
Vec3 wave(double s) { return {std::cos(2 * s), 0.5 - s, std::sin(5 * s)}; }

double error(const std::vector<Quaternion>& found, const Grid& grid) {
  return distance(found, at_centres(grid, winding));
}

}  // namespace

TEST_CASE("in the plane a cubic is continued exactly, whatever the edges") {
  Random random(1);
  for (const Grid& grid :
       {Grid::uniform(1, 4), Grid::uniform(1, 9), random.grid(4), random.grid(11), graded(16)}) {
    const Grid fine = halved(grid);
    const auto exact = at_centres(fine, cubic);
    const auto once = prolonged(grid, at_centres(grid, cubic));
    CHECK(distance(once.start, exact) < 1e-13);
    // nothing changed from grid to grid, so nothing is expected to
    const auto twice = prolonged(fine, exact, once);
    CHECK(distance(twice.start, at_centres(halved(fine), cubic)) < 1e-13);
  }
}

TEST_CASE("in space errors are of fourth order, on unequal edges as well") {
  for (const auto make : {+[](int n) { return Grid::uniform(1, n); }, &graded}) {
    std::vector<double> errors;
    for (int n : {32, 64, 128, 256}) {
      const Grid grid = make(n);
      const auto start = prolonged(grid, at_centres(grid, winding)).start;
      errors.push_back(error(start, halved(grid)));
      for (const auto& q : start) CHECK(q.norm() == doctest::Approx(1).epsilon(1e-15));
    }
    for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i - 1] / errors[i] > 13);
    CHECK(errors.back() < 1e-7);
  }
}

TEST_CASE("what changed from grid to grid is expected to change by a quarter of it again") {
  const auto found = [](const Grid& grid, double h) {
    return at_centres(grid, [&](double s) { return winding(s) * exp(Vec3(h * h * wave(s))); });
  };
  std::vector<double> plain, predicted;
  for (int n : {32, 64, 128}) {
    const Grid grid = graded(n), finer = halved(grid), finest = halved(finer);
    const auto frames = found(finer, 0.5 / n);
    const auto expected = found(finest, 0.25 / n);
    plain.push_back(distance(prolonged(finer, frames).start, expected));
    const auto below = prolonged(grid, found(grid, 1. / n));
    predicted.push_back(distance(prolonged(finer, frames, below).start, expected));
  }
  for (std::size_t i = 1; i < plain.size(); ++i) {
    CHECK(plain[i - 1] / plain[i] == doctest::Approx(4).epsilon(0.1));
    CHECK(predicted[i - 1] / predicted[i] > 10);
  }
  CHECK(predicted.back() < plain.back() / 20);
}

TEST_CASE("what a grid of another scene said is not used") {
  const Grid grid = Grid::uniform(1, 8);
  const auto other = prolonged(Grid::uniform(1, 16), at_centres(Grid::uniform(1, 16), winding));
  const auto frames = at_centres(grid, winding);
  CHECK(distance(prolonged(grid, frames, other).start, prolonged(grid, frames).start) == 0);
}

TEST_CASE("with too few edges for a cubic the halves start as the whole") {
  const Grid grid = Grid::uniform(1, 3);
  const auto frames = at_centres(grid, winding);
  const auto start = prolonged(grid, frames).start;
  REQUIRE(start.size() == 6);
  for (std::size_t j = 0; j < 6; ++j) CHECK(distance(start[j], frames[j / 2]) == 0);
}
