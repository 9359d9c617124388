// SPDX-License-Identifier: BSD-3-Clause
// Shapes to start from.
#include "support/network.hpp"

#include "support/models.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;

template <class Space>
NetworkState<Space> start(const Structure<Space>& s) {
  const Layout<Space> layout(s.net);
  return Start<Space>(layout).state();
}

/// About a2.
template <class Space>
Spin<Space> bend() {
  return Spin<Space>::Unit(Space::spin / 2);
}

/// The ends of an unstretched rod with these frames, apart.
template <class Space>
Point<Space> reach(const Grid& grid, const std::vector<typename Space::Rotation>& frames) {
  Point<Space> sum = Point<Space>::Zero();
  for (int j = 0; j < grid.edges(); ++j) sum += grid.h(j) * rotate(frames[j], axis<Space>());
  return sum;
}

/// A rod along e3 from the origin, and its end moved to `end`.
template <class Space>
Structure<Space> moved_end(const Point<Space>& end, bool start_clamped, bool end_clamped) {
  Structure<Space> s;
  s.add(64);
  start_clamped ? s.clamp(0, 0) : s.hinge(0, 0);
  const int v = end_clamped ? s.clamp(0, 64) : s.hinge(0, 64);
  s.net.nodes[v].position = end;
  return s;
}

}  // namespace

TEST_CASE_TEMPLATE("supports that fit the shape at rest leave it as it is", Space, EACH_SPACE) {
  Random random(1);
  for (const bool clamped : {true, false}) {
    Structure<Space> s;
    s.add(random.rod<Space>(20), random.vector<Space::dim>(), random.rotation<Space>());
    clamped ? s.clamp(0, 0) : s.hinge(0, 0);
    clamped ? s.clamp(0, 13) : s.hinge(0, 13);
    const int free = s.hold(0, 17, s.anywhere(), s.turning(), false);
    const auto x = start(s);
    const auto rest = s.at_rest(0);
    CHECK(distance(x.frames, rest.frames) < 1e-13);
    CHECK(distance(x.positions[free], rest.positions[17]) < 1e-13);
    for (const auto& f : x.forces) CHECK(f.norm() == 0);
  }
}

TEST_CASE_TEMPLATE("one clamp elsewhere carries the shape at rest along", Space, EACH_SPACE) {
  Random random(2);
  for (const int vertex : {0, 9, 20}) {
    Structure<Space> s;
    s.add(random.rod<Space>(20));
    const int v = s.clamp(0, vertex);
    const auto turn = random.rotation<Space>(2);
    const auto rest = s.at_rest(0);
    s.net.nodes[v].frame = turn * s.net.nodes[v].frame;
    s.net.nodes[v].position = random.vector<Space::dim>();
    const auto x = start(s);
    for (int j = 0; j < 20; ++j)
      CHECK(distance(matrix(x.frames[j]), matrix(turn * rest.frames[j])) < 1e-13);
  }
}

TEST_CASE_TEMPLATE("a bow spans a shortened distance to some per cent", Space, EACH_SPACE) {
  for (const bool a : {true, false})
    for (const bool b : {true, false})
      for (const double d : {0.99, 0.8, 0.5}) {
        CAPTURE(a);
        CAPTURE(b);
        CAPTURE(d);
        const Point<Space> end = d * axis<Space>();
        const auto s = moved_end<Space>(end, a, b);
        const auto x = start(s);
        // with one clamp the bow is lopsided, and a high one misses to the side
        const double miss = distance(reach<Space>(s.net.rods[0].grid, x.frames), end);
        CHECK(miss < (a == b ? 0.06 : std::pow(1 - d, 1.5)));
        if (a) CHECK(log(x.frames[0]).norm() < 0.2);  // the clamps' frames, nearly
        if (b) CHECK(log(x.frames[63]).norm() < 0.2);
      }
}

TEST_CASE_TEMPLATE("the bow is tilted to a point beside the axis", Space, EACH_SPACE) {
  Point<Space> end = 0.7 * axis<Space>();
  end[0] = 0.3;
  const auto s = moved_end<Space>(end, false, false);
  const auto x = start(s);
  const Point<Space> r = reach<Space>(s.net.rods[0].grid, x.frames);
  CHECK(r.dot(end) > 0.99 * r.norm() * end.norm());
  CHECK(distance(r, end) < 0.06);
}

TEST_CASE_TEMPLATE("a closed rod starts from its shape at rest, cut open", Space, EACH_SPACE) {
  const int n = 12;
  auto rod = Rod<Space>::uniform(Grid(Vector::Constant(n, 1. / n), Closure::closed),
                                 Spin<Space>::Ones(), Point<Space>::Ones(), 2 * π * bend<Space>());
  rod.bending.pop_back(), rod.K0.pop_back();
  Structure<Space> s;
  s.add(rod);
  const auto x = start(s);
  REQUIRE(int(x.frames.size()) == n);
  CHECK(reach<Space>(rod.grid, x.frames).norm() < 1e-13);
  for (int j = 1; j < n; ++j)
    CHECK(distance(log(x.frames[j - 1].conjugate() * x.frames[j]),
                   Spin<Space>(2 * π / n * bend<Space>())) < 1e-13);
}

TEST_CASE_TEMPLATE("a straight rod whose ends are joined starts as a circle", Space, EACH_SPACE) {
  const int n = 40;
  Structure<Space> s;
  s.add(n);
  const int v = s.hold(0, 0, s.anywhere(), s.turning(), true);
  s.attach(0, n, v, true);
  const auto x = start(s);
  CHECK(reach<Space>(s.net.rods[0].grid, x.frames).norm() < 1e-13);
  for (int j = 1; j < n; ++j)
    CHECK(log(x.frames[j - 1].conjugate() * x.frames[j]).norm() ==
          doctest::Approx(2 * π / n).epsilon(1e-12));
}

TEST_CASE("turns are put in evenly, beside what the frames ask for") {
  const int n = 60;
  for (const int turns : {0, 1, -3})
    for (const double rest : {0., 0.7})
      for (const bool shortened : {false, true}) {
        if (rest == 0 && !shortened && turns == 0) continue;
        CAPTURE(turns);
        CAPTURE(rest);
        Structure<Spatial> s;
        s.add(n);
        s.clamp(0, 0);
        const int v = s.clamp(0, n);
        s.net.nodes[v].frame = exp(Vec3(0, 0, rest));
        if (shortened) s.net.nodes[v].position *= 0.8;
        s.net.attachments.back().turns = turns;
        const auto x = start(s);
        double twist = 0;
        for (int j = 1; j < n; ++j) {
          const double ψ = twist_angle(x.frames[j - 1].conjugate() * x.frames[j]);
          CHECK(ψ == doctest::Approx((2 * π * turns + rest) / n).epsilon(shortened ? 0.05 : 1e-9));
          twist += ψ;
        }
        CHECK(
            twist ==
            doctest::Approx((2 * π * turns + rest) * (n - 1) / n).epsilon(shortened ? 0.01 : 1e-9));
      }
}

TEST_CASE_TEMPLATE("a rod that is bent at rest keeps its bends when an end is moved a little",
                   Space, EACH_SPACE) {
  Random random(3);
  Structure<Space> s;
  s.add(Rod<Space>::uniform(Grid::uniform(1, 40), Spin<Space>::Ones(), Point<Space>::Ones(),
                            random.turn<Space>(3)));
  s.clamp(0, 0);
  const int v = s.clamp(0, 40);
  const auto rest = s.at_rest(0).frames;
  double farthest = 1;
  for (const double ε : {1e-2, 1e-3}) {
    auto near = s;
    near.net.nodes[v].frame = exp(Spin<Space>(Spin<Space>::Constant(ε))) * s.net.nodes[v].frame;
    near.net.nodes[v].position[0] += 1e-2 * ε;
    const double gap = distance(start(near).frames, rest);
    CHECK(gap < 0.3 * farthest);
    farthest = gap;
  }
}
