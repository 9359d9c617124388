// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene/loads.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <numeric>

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Vec>
Vec sum(const std::vector<Vec>& all) {
  return std::accumulate(all.begin(), all.end(), Vec(Vec::Zero()));
}

/// Σ s_j F_j: what a lever sees.
template <class Space>
Point<Space> first_moment(const Grid& grid, const Loads<Space>& loads) {
  Point<Space> out = Point<Space>::Zero();
  for (int j = 0; j <= grid.edges(); ++j) out += grid.s(j) * loads.force[j];
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("a force keeps its sum and its moment, wherever it acts", Space, EACH_SPACE) {
  Random random(1);
  for (const int n : {1, 2, 9}) {
    const Grid grid = random.grid(n, 3);
    for (double s = 0; s <= 3; s += 0.0625) {
      CAPTURE(s);
      Loads<Space> loads(n);
      const Point<Space> F = random.vector<Space::dim>();
      loads.add_force(grid, F, s);
      CHECK(distance(sum(loads.force), F) < 1e-15);
      CHECK(distance(first_moment(grid, loads), s * F) < 1e-14);
      for (int j = 0; j <= n; ++j)  // only the neighbours take part, and none of them pulls back
        CHECK(loads.force[j].dot(F) >= (std::abs(grid.s(j) - s) < 1e-12 ? 0.99 * F.dot(F) : 0));
      for (int j = 0; j <= n; ++j)
        if ((j < n && grid.s(j + 1) <= s) || (j > 0 && grid.s(j - 1) >= s))
          CHECK(loads.force[j].norm() < 1e-14);
      CHECK_FALSE(loads.has_moments());
    }
  }
}

TEST_CASE_TEMPLATE("a force on a vertex stays there", Space, EACH_SPACE) {
  Random random(6);
  for (const Grid& grid : {Grid::uniform(1, 4), random.grid(7, 3), Grid::uniform(0.1, 1000)}) {
    for (int j = 0; j <= grid.edges(); j += 1 + j / 10) {
      Loads<Space> loads(grid.edges());
      loads.add_force(grid, Point<Space>::Ones(), grid.s(j));
      CHECK(loads.force[j] == Point<Space>::Ones());
      CHECK(sum(loads.force) == Point<Space>::Ones());
    }
    Loads<Space> loads(grid.edges());
    loads.add_force(grid, Point<Space>::Ones(), grid.length());
    CHECK(loads.section_forces()[0] == Point<Space>::Ones());
    CHECK(loads.force[grid.edges()] == Point<Space>::Ones());
  }
}

TEST_CASE("a place is the same on finer grids, by number") {
  const Grid grid((Vector(4) << 0.3, 0.7, 0.11, 0.89).finished());
  for (const int parts : {1, 2, 8, 1 << 18}) {
    for (int j = 0; j <= 4; ++j) {  // off by rounding as sums of many lengths are
      const double off = (j % 2 ? 1e-11 : -1e-11) * (j > 0 && j < 4);
      const Site at = Site::on(grid, grid.s(j) + off).refined(parts);
      CHECK(at.edge == (j < 4 ? j * parts : 4 * parts - 1));
      CHECK(at.part == (j < 4 ? 0 : 1));
    }
    const Site inside = Site::on(grid, 0.3 + 0.7 * 0.625);
    const Site finer = inside.refined(parts);
    CHECK((finer.edge + finer.part) / parts == doctest::Approx(1.625).epsilon(1e-12));
    CHECK(finer.part >= 0);
    CHECK(finer.part < 1);
  }
}

TEST_CASE_TEMPLATE("a moment keeps its sum, and its place between two edges", Space, EACH_SPACE) {
  Random random(2);
  for (const int n : {1, 2, 9}) {
    const Grid grid = random.grid(n, 3);
    for (double s = 0; s < 3; s += 0.0625) {
      CAPTURE(s);
      Loads<Space> loads(n);
      const Spin<Space> M = random.vector<Space::spin>();
      loads.add_moment(grid, M, s);
      CHECK(loads.end_moment.norm() == 0);
      Spin<Space> lever = Spin<Space>::Zero();
      for (int j = 0; j < n; ++j) lever += grid.centre(j) * loads.moment[j];
      if (s <= grid.centre(n - 1)) CHECK(distance(lever, s * M) < 1e-14);  // the clamp is at s = 0
      CHECK(distance(sum(loads.moment) + loads.start_moment, M) < 1e-15);
      if (s >= grid.centre(0)) CHECK(loads.start_moment.norm() == 0);
      if (s >= grid.centre(n - 1)) CHECK(distance(loads.moment[n - 1], M) == 0);
    }
    Loads<Space> loads(n);
    loads.add_moment(grid, Spin<Space>::Ones(), 3);
    loads.add_moment(grid, Spin<Space>::Ones(), 3 + 1e-13);
    CHECK(loads.end_moment == 2 * Spin<Space>::Ones());
    CHECK(sum(loads.moment).norm() == 0);
    CHECK(loads.has_moments());
  }
}

TEST_CASE_TEMPLATE("loads add up", Space, EACH_SPACE) {
  Random random(3);
  const Grid grid = random.grid(5);
  const Point<Space> F = random.vector<Space::dim>(), G = random.vector<Space::dim>();
  Loads<Space> loads(5);
  loads.add_force(grid, F, 0.3);
  loads.add_force(grid, G, 0.31);
  CHECK(distance(sum(loads.force), F + G) < 1e-15);
  CHECK(distance(first_moment(grid, loads), 0.3 * F + 0.31 * G) < 1e-15);
}

TEST_CASE_TEMPLATE("distributed loads", Space, EACH_SPACE) {
  Random random(4);
  const int n = 6;
  const Grid grid = random.grid(n, 3);
  std::vector<Point<Space>> f;
  std::vector<Spin<Space>> l;
  Point<Space> total = Point<Space>::Zero(), lever = Point<Space>::Zero();
  Spin<Space> moment = Spin<Space>::Zero();
  for (int j = 0; j < n; ++j) {
    f.push_back(random.vector<Space::dim>());
    l.push_back(random.vector<Space::spin>());
    total += grid.h(j) * f[j];
    lever += grid.h(j) * grid.centre(j) * f[j];
    moment += grid.h(j) * l[j];
  }
  Loads<Space> loads(n);
  loads.add_force_per_length(grid, f);
  loads.add_moment_per_length(grid, l);
  CHECK(distance(sum(loads.force), total) < 1e-14);
  CHECK(distance(first_moment(grid, loads), lever) < 1e-14);
  CHECK(distance(sum(loads.moment), moment) < 1e-14);
  CHECK(loads.end_moment.norm() == 0);
}

TEST_CASE_TEMPLATE("loads that are not finite, or add up to what is not, are refused", Space,
                   EACH_SPACE) {
  Loads<Space> loads(3);
  loads.force[2][0] = loads.moment[1][0] = 1e308;
  CHECK_NOTHROW(loads.check());
  loads.force[3][0] = 1e308;
  CHECK_REFUSED("loads: the section force is not finite", loads.check());
  loads.force[3][0] = 0;
  loads.end_moment[0] = 1e308;
  CHECK_REFUSED("loads: the moments add up to what is not finite", loads.check());
}

TEST_CASE_TEMPLATE("sections carry what acts behind them", Space, EACH_SPACE) {
  Random random(5);
  const int n = 7;
  Loads<Space> loads(n);
  for (auto& F : loads.force) F = random.vector<Space::dim>();
  for (auto& M : loads.moment) M = random.vector<Space::spin>();
  loads.end_moment = random.vector<Space::spin>();
  const auto force = loads.section_forces();
  const auto moment = loads.moments_behind();
  REQUIRE(force.size() == n);
  REQUIRE(moment.size() == n + 1);
  CHECK(distance(force[n - 1], loads.force[n]) == 0);
  CHECK(distance(moment[n], loads.end_moment) == 0);
  for (int j = 0; j < n; ++j) {
    if (j > 0) CHECK(distance(force[j - 1], force[j] + loads.force[j]) < 1e-15);
    CHECK(distance(moment[j], moment[j + 1] + loads.moment[j]) < 1e-15);
  }
}

TEST_CASE("only moments are moments") {
  Loads<Spatial> loads(3);
  CHECK_FALSE(loads.has_moments());
  loads.force[1] = Vec3::Ones();
  CHECK_FALSE(loads.has_moments());
  loads.moment[2][1] = 1e-300;
  CHECK(loads.has_moments());
}

TEST_CASE("loads beside the rod are refused") {
  const Grid grid = Grid::uniform(1, 3);
  Loads<Spatial> loads(3);
  CHECK_REFUSED("at: must be an arc length on the rod, in [0, 1], got 1.5",
                loads.add_force(grid, Vec3::Ones(), 1.5));
  CHECK_REFUSED("at:", loads.add_moment(grid, Vec3::Ones(), -0.1));
}
