// SPDX-License-Identifier: BSD-3-Clause
// Coarser copies of networks, and the way back.
#include "support/network.hpp"

#include "support/models.hpp"
#include "support/near.hpp"

#include <pyrod/rod/section.hpp>

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
struct Totals {
  Spin<Space> give = Spin<Space>::Zero(), turn = Spin<Space>::Zero();
  Point<Space> stretch = Point<Space>::Zero();
};

template <class Space>
Totals<Space> totals(const Rod<Space>& rod) {
  Totals<Space> out;
  for (int j = 0; j < rod.grid.vertices(); ++j) {
    out.give += rod.grid.Δs(j) * rod.bending[j].cwiseInverse();
    out.turn += rod.grid.Δs(j) * rod.K0[j];
  }
  for (int j = 0; j < rod.edges(); ++j)
    out.stretch += rod.grid.h(j) * rod.stretching[j].cwiseInverse();
  return out;
}

/// Dead and following, on vertices and edges: sums, and first moments about the start.
template <class Space>
struct Sums {
  Point<Space> force = Point<Space>::Zero(), lever = Point<Space>::Zero();
  Point<Space> following = Point<Space>::Zero(), follower_lever = Point<Space>::Zero();
  Spin<Space> moment = Spin<Space>::Zero(), follower_moment = Spin<Space>::Zero();
};

template <class Space>
Sums<Space> sums(const Loads<Space>& loads, const Grid& grid) {
  Sums<Space> out;
  for (int j = 0; j <= grid.edges(); ++j) {
    out.force += loads.force[j];
    out.lever += grid.s(j) * loads.force[j];
  }
  for (const auto& f : loads.follower_forces) {
    out.following += f.force;
    out.follower_lever += grid.s(f.vertex) * f.force;
  }
  out.moment = loads.total_moment();
  for (const auto& m : loads.follower_moments) out.follower_moment += m.moment;
  return out;
}

template <class Space>
Rod<Space> random_closed_rod(Random& random, int edges) {
  auto rod = random.rod<Space>(edges);
  rod.grid = Grid(rod.grid.edge_lengths(), Closure::closed);
  rod.bending.pop_back(), rod.K0.pop_back();
  return rod;
}

}  // namespace

TEST_CASE("a coarser grid: it keeps the ends of spans, and is even between them") {
  Random random(1);
  for (const int n : {5, 40, 41, 200}) {
    const Grid grid = random.grid(n);
    const std::vector<int> ends{0, n / 3, n};
    for (const int edges : {1, 4, 16}) {
      const auto to = detail::coarser_grid(grid, ends, {}, edges);
      REQUIRE(to.fine == ends);
      for (std::size_t i = 1; i < ends.size(); ++i) {
        const int fine = ends[i] - ends[i - 1], first = to.coarse[i - 1], last = to.coarse[i];
        CHECK(last - first == std::min(edges, fine));
        const double length = grid.s(ends[i]) - grid.s(ends[i - 1]);
        CHECK(to.grid.s(last) == doctest::Approx(grid.s(ends[i])).epsilon(1e-14));
        for (int j = first; j < last; ++j) {
          const double h = fine <= edges ? grid.h(ends[i - 1] + j - first) : length / edges;
          CHECK(to.grid.h(j) == doctest::Approx(h).epsilon(1e-14));
        }
        CHECK(to.vertex(ends[i]) == last);
      }
      CHECK(to.vertex(n / 3 + 1) == -1);
    }
  }
}

TEST_CASE("a coarser grid keeps kinks, as far as they are few") {
  const Grid grid = Grid::uniform(1, 400);
  const auto to = detail::coarser_grid(grid, {0, 400}, {0, 100, 111, 350}, 16);
  CHECK(to.fine == std::vector{0, 100, 111, 350, 400});
  CHECK(to.coarse == std::vector{0, 4, 5, 15, 17});
  for (const int j : to.fine) CHECK(to.grid.s(to.vertex(j)) == doctest::Approx(grid.s(j)));
  std::vector<int> many;
  for (int j = 0; j < 400; ++j) many.push_back(j);
  CHECK(detail::coarser_grid(grid, {0, 400}, many, 16).fine == std::vector{0, 400});
}

TEST_CASE_TEMPLATE("a merged rod gives as much and is bent as much, in all", Space, EACH_SPACE) {
  Random random(2);
  for (const bool closed : {false, true})
    for (const int n : {12, 32, 61}) {
      CAPTURE(n);
      const auto rod = closed ? random_closed_rod<Space>(random, n) : random.rod<Space>(n);
      const auto merged = detail::merged(rod, detail::coarser_grid(rod.grid, {0, n / 4, n}, {}, 3));
      CHECK(merged.edges() < n);
      CHECK(merged.grid.closed() == closed);
      CHECK(merged.grid.length() == doctest::Approx(rod.grid.length()).epsilon(1e-14));
      const auto a = totals(rod), b = totals(merged);
      CHECK(distance(a.give, b.give) < 1e-13 * a.give.norm());
      CHECK(distance(a.turn, b.turn) < 1e-13);
      CHECK(distance(a.stretch, b.stretch) < 1e-13 * a.stretch.norm());
    }
}

TEST_CASE_TEMPLATE("a uniform rod, merged, is the uniform rod on the coarse grid", Space,
                   EACH_SPACE) {
  Random random(3);
  const Spin<Space> C = random.between<Space::spin>(1, 2), K0 = random.vector<Space::spin>();
  const Point<Space> S = random.between<Space::dim>(10, 20);
  for (const bool even : {true, false}) {
    const Grid grid = even ? Grid::uniform(1, 64) : random.grid(64);
    const auto merged = detail::merged(Rod<Space>::uniform(grid, C, S, K0),
                                       detail::coarser_grid(grid, {0, 64}, {}, 8));
    REQUIRE(merged.edges() == 8);
    for (const auto& c : merged.bending) CHECK(distance(c, C) < 1e-13);
    for (const auto& k : merged.K0) CHECK(distance(k, K0) < 1e-13);
    for (const auto& s : merged.stretching) CHECK(distance(s, S) < 1e-12);
  }
}

TEST_CASE_TEMPLATE("a rigid strain stays rigid", Space, EACH_SPACE) {
  const Grid grid = Grid::uniform(1, 12);
  const Point<Space> S = Point<Space>::Constant(Section::rigid);
  const auto merged = detail::merged(Rod<Space>::uniform(grid, Spin<Space>::Ones(), S),
                                     detail::coarser_grid(grid, {0, 12}, {}, 4));
  for (const auto& s : merged.stretching) CHECK(s == S);
}

TEST_CASE_TEMPLATE("merged loads have the sums and the first moments of all", Space, EACH_SPACE) {
  Random random(4);
  const int n = 37;
  const Grid grid = random.grid(n);
  Loads<Space> loads(n);
  for (auto& F : loads.force) F = random.vector<Space::dim>();
  for (auto& m : loads.moment) m = random.vector<Space::spin>();
  loads.start_moment = random.vector<Space::spin>();
  loads.end_moment = random.vector<Space::spin>();
  loads.follower_end_moment = random.vector<Space::spin>();
  for (int k = 0; k < 9; ++k) {
    const int j = std::min(n - 1, int(random.number(0, n)));
    loads.follower_forces.push_back({j, j + k % 2, random.vector<Space::dim>()});
    loads.follower_moments.push_back({j, random.vector<Space::spin>()});
  }
  const auto to = detail::coarser_grid(grid, {0, 11, n}, {}, 4);
  const auto merged = detail::merged(loads, grid, to);
  const auto a = sums(loads, grid), b = sums(merged, to.grid);
  CHECK(distance(a.force, b.force) < 1e-14);
  CHECK(distance(a.lever, b.lever) < 1e-14);
  CHECK(distance(a.following, b.following) < 1e-14);
  CHECK(distance(a.follower_lever, b.follower_lever) < 1e-14);
  CHECK(distance(a.moment, b.moment) < 1e-14);
  CHECK(distance(a.follower_moment, b.follower_moment) < 1e-14);
  CHECK(merged.start_moment == loads.start_moment);
  CHECK(merged.end_moment == loads.end_moment);
  CHECK(merged.follower_end_moment == loads.follower_end_moment);
  for (const auto& f : merged.follower_forces)  // on an end of the edge that it follows
    CHECK((f.edge >= 0 && f.edge < to.grid.edges() &&
           (f.vertex == f.edge || f.vertex == f.edge + 1)));
}

TEST_CASE_TEMPLATE("a coarser network: its supports stay where they are", Space, EACH_SPACE) {
  Random random(5);
  Structure<Space> s;
  s.add(random.rod<Space>(50));
  s.clamp(0, 0), s.hinge(0, 17), s.roller(0, 20, 0), s.clamp(0, 50);
  const auto coarse = coarsened(s.net, 4);
  REQUIRE(coarse.attachments.size() == 4);
  const Grid &grid = coarse.rods[0].grid, &fine = s.net.rods[0].grid;
  CHECK(coarse.rods[0].edges() == 4 + 3 + 4);
  for (int i = 0; i < 4; ++i)
    CHECK(grid.s(coarse.attachments[i].vertex) ==
          doctest::Approx(fine.s(s.net.attachments[i].vertex)).epsilon(1e-14));
  const auto same = coarsened(s.net, 50);  // nothing to merge
  CHECK(same.rods[0].edges() == 50);
  for (int j = 0; j <= 50; ++j) {
    CHECK(distance(same.rods[0].K0[j], s.net.rods[0].K0[j]) < 1e-12);
    CHECK(distance(same.rods[0].bending[j], s.net.rods[0].bending[j]) < 1e-12);
    CHECK(distance(same.loads[0].force[j], s.net.loads[0].force[j]) < 1e-15);
  }
}

TEST_CASE_TEMPLATE("forces and moments that follow everywhere do not pile up on coarse edges",
                   Space, EACH_SPACE) {
  Random random(7);
  const int n = 400;
  const Grid grid = Grid::uniform(1, n);
  Loads<Space> loads(n);
  loads.add_follower_force_per_length(grid, std::vector(n, random.vector<Space::dim>()));
  loads.add_follower_moment_per_length(grid, std::vector(n, random.vector<Space::spin>()));
  const auto to = detail::coarser_grid(grid, {0, n}, {}, 16);
  const auto merged = detail::merged(loads, grid, to);
  CHECK(merged.follower_forces.size() <= 3 * 16);
  CHECK(merged.follower_moments.size() == 16);
  const auto a = sums(loads, grid), b = sums(merged, to.grid);
  CHECK(distance(a.following, b.following) < 1e-13);
  CHECK(distance(a.follower_lever, b.follower_lever) < 1e-13);
  CHECK(distance(a.follower_moment, b.follower_moment) < 1e-13);
}

TEST_CASE_TEMPLATE("point loads and jumps of a rod stay at their vertices", Space, EACH_SPACE) {
  Structure<Space> s;
  s.clamp(s.add(100), 0);
  auto& rod = s.net.rods[0];
  auto& loads = s.net.loads[0];
  const Spin<Space> one = Spin<Space>::Ones();
  rod.jumps.push_back({25, one, one, one, one});
  loads.add_force(rod.grid, Point<Space>::Ones(), 0.4);
  loads.add_moment(rod.grid, one, 0.6);
  const auto coarse = coarsened(s.net, 10);
  const auto at = [&](int j) { return coarse.rods[0].grid.s(j); };
  REQUIRE(coarse.rods[0].jumps.size() == 1);
  CHECK(at(coarse.rods[0].jumps[0].vertex) == doctest::Approx(0.25));
  REQUIRE(coarse.loads[0].pushed.size() == 1);
  CHECK(at(coarse.loads[0].pushed[0]) == doctest::Approx(0.4));
  CHECK(distance(coarse.loads[0].force[coarse.loads[0].pushed[0]], Point<Space>::Ones()) < 1e-15);
  REQUIRE(coarse.loads[0].vertex_moments.size() == 1);
  CHECK(at(coarse.loads[0].vertex_moments[0].vertex) == doctest::Approx(0.6));
  CHECK(kinks(coarse.rods[0], coarse.loads[0]).size() == 3);
}
