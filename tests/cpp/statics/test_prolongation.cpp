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

/// What is expected on a finer grid: of what is known on one, or on two.
template <class Rotation>
std::vector<Rotation> prolonged(const Grid& grid, const std::vector<Rotation>& frames,
                                const Grid& to) {
  std::vector<Rotation> out;
  prolong(Stretch(grid), components(frames.data(), int(frames.size())), Stretch(to), out);
  return out;
}

template <class Rotation>
std::vector<Rotation> prolonged(const Grid& before, const std::vector<Rotation>& then,
                                const Grid& grid, const std::vector<Rotation>& frames,
                                const Grid& to) {
  const Stretch from(before), on(grid);
  auto values = components(frames.data(), on.edges());
  const auto was = interpolated(from, components(then.data(), from.edges()), on);
  const double part = still_to_come(from.edges(), on.edges(), to.edges());
  for (std::size_t j = 0; j < values.size(); ++j) values[j] += part * (values[j] - was[j]);
  std::vector<Rotation> out;
  prolong(on, values, Stretch(to), out);
  return out;
}

double error(const std::vector<Quaternion>& found, const Grid& grid) {
  return distance(found, at_centres(grid, winding));
}

}  // namespace

TEST_CASE("in the plane a cubic is continued exactly, whatever the edges") {
  Random random(1);
  for (const Grid& grid :
       {Grid::uniform(1, 4), Grid::uniform(1, 9), random.grid(4), random.grid(11), graded(16)})
    for (const Grid& fine : {halved(grid), Grid::uniform(grid.length(), 57), grid}) {
      const auto exact = at_centres(fine, cubic);
      CHECK(distance(prolonged(grid, at_centres(grid, cubic), fine), exact) < 1e-12);
      // nothing changed from grid to grid, so nothing is expected to
      const Grid finer = halved(fine);
      CHECK(distance(prolonged(grid, at_centres(grid, cubic), fine, exact, finer),
                     at_centres(finer, cubic)) < 1e-12);
    }
}

TEST_CASE("in space errors are of fourth order, on unequal edges as well") {
  for (const auto make : {+[](int n) { return Grid::uniform(1, n); }, &graded}) {
    std::vector<double> errors;
    for (int n : {32, 64, 128, 256}) {
      const Grid grid = make(n), fine = halved(grid);
      const auto start = prolonged(grid, at_centres(grid, winding), fine);
      errors.push_back(error(start, fine));
      for (const auto& q : start) CHECK(q.norm() == doctest::Approx(1).epsilon(1e-15));
    }
    for (std::size_t i = 1; i < errors.size(); ++i) CHECK(errors[i - 1] / errors[i] > 13);
    CHECK(errors.back() < 1e-7);
  }
}

TEST_CASE("errors of second order on two grids tell those on a third one") {
  const auto found = [](const Grid& grid, double h) {
    return at_centres(grid, [&](double s) { return winding(s) * exp(Vec3(h * h * wave(s))); });
  };
  for (const auto& [now, next] : {std::pair{2, 4}, {4, 16}, {4, 100}, {2, 3}}) {
    CAPTURE(next);
    std::vector<double> plain, predicted;
    for (int n : {32, 64, 128}) {
      const Grid grid = graded(n), finer = graded(now * n), finest = graded(next * n);
      const auto frames = found(finer, 1. / (now * n));
      const auto expected = found(finest, 1. / (next * n));
      plain.push_back(distance(prolonged(finer, frames, finest), expected));
      predicted.push_back(
          distance(prolonged(grid, found(grid, 1. / n), finer, frames, finest), expected));
    }
    for (std::size_t i = 1; i < plain.size(); ++i) {
      CHECK(plain[i - 1] / plain[i] == doctest::Approx(4).epsilon(0.1));
      CHECK(predicted[i - 1] / predicted[i] > 10);
    }
    CHECK(predicted.back() < plain.back() / 20);
  }
  CHECK(still_to_come(8, 16, 32) == 0.25);
  CHECK(still_to_come(8, 8, 32) == 0);  // nothing changed
}

TEST_CASE("with too few edges for a cubic, through as many as there are") {
  const auto square = [](double s) { return Angle{1 - s + 3 * s * s}; };
  const auto line = [](double s) { return Angle{1 - s}; };
  for (const Grid& fine : {Grid::uniform(1, 6), Grid::uniform(1, 50)}) {
    const auto continued = [&](int edges, const auto& frame) {
      const Grid grid = Grid::uniform(1, edges);
      return distance(prolonged(grid, at_centres(grid, frame), fine), at_centres(fine, frame));
    };
    CHECK(continued(3, square) < 1e-14);
    CHECK(continued(2, line) < 1e-14);
    CHECK(continued(1, [](double) { return Angle{0.7}; }) == 0);
  }
}
