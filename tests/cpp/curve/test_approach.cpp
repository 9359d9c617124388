// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/approach.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;

double to_segment(const Vec3& x, const Vec3& q, const Vec3& b) {
  const double along = std::clamp((x - q).dot(b) / b.squaredNorm(), 0., 1.);
  return (x - q - along * b).norm();
}

/// The distance of the points of one segment from another is convex along it: three parts at a
/// time.
double slow_distance(const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b) {
  const auto at = [&](double x) { return to_segment(p + x * a, q, b); };
  double low = 0, high = 1;
  for (int i = 0; i < 100; ++i) {
    const double third = (high - low) / 3;
    if (at(low + third) < at(high - third))
      high -= third;
    else
      low += third;
  }
  return std::min({at(0), at(1), at(low)});
}

/// Four ways to name the same two segments, and the two to exchange them.
void check_pair(const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b, double tolerance) {
  const double expected = slow_distance(p, a, q, b);
  for (const double found : {segment_distance(p, a, q, b), segment_distance(q, b, p, a),
                             segment_distance(p + a, -a, q, b), segment_distance(p, a, q + b, -b)})
    CHECK(std::abs(found - expected) <= tolerance);
}

double by_all_pairs(const Arc& arc, const Arc& other) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < arc.edges(); ++i)
    for (int j = 0; j < other.edges(); ++j)
      best = std::min(
          best, slow_distance(arc.positions[i], arc.edge(i), other.positions[j], other.edge(j)));
  return best;
}

}  // namespace

TEST_CASE("the distance of segments in any position to each other") {
  Random random(1);
  for (int i = 0; i < 2000; ++i)
    check_pair(random.vector<3>(), random.vector<3>(), 2 * random.vector<3>(), random.vector<3>(),
               2e-15);
}

TEST_CASE("segments between points of a lattice: parallel, in line, overlapping, crossing") {
  Random random(2);
  const auto point = [&] {
    return Vec3(std::floor(random.number(0, 3)), std::floor(random.number(0, 3)),
                std::floor(random.number(0, 2)));
  };
  int touching = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = point(), a = point() - p, q = point(), b = point() - q;
    if (a.isZero() || b.isZero()) continue;
    touching += segment_distance(p, a, q, b) < 1e-15;
    check_pair(p, a, q, b, 2e-15);
  }
  CHECK(touching > 100);
}

TEST_CASE("each region of the square of places by hand") {
  const Vec3 p(0, 0, 0), a(2, 0, 0);
  const auto d = [&](const Vec3& q, const Vec3& end) { return segment_distance(p, a, q, end - q); };
  CHECK(d({1, -1, 3}, {1, 1, 3}) == 3);    // inside both
  CHECK(d({1, 1, 0}, {1, 5, 0}) == 1);     // at the start of b
  CHECK(d({1, 5, 0}, {1, 1, 0}) == 1);     // at its end
  CHECK(d({-2, -1, 0}, {-2, 1, 0}) == 2);  // at the start of a
  CHECK(d({5, -1, 0}, {5, 1, 0}) == 3);    // at its end
  CHECK(d({5, 4, 0}, {6, 9, 0}) == 5);     // at two ends
  CHECK(d({-3, 4, 0}, {-4, 4, 0}) == 5);   // at two starts
  CHECK(d({1, 2, 0}, {9, 2, 0}) == 2);     // parallel, side by side
  CHECK(d({9, 2, 0}, {1, 2, 0}) == 2);     // and the other way
  CHECK(d({5, 4, 0}, {8, 4, 0}) == 5);     // parallel, apart
  CHECK(d({3, 0, 0}, {8, 0, 0}) == 1);     // in line
  CHECK(d({1, 0, 0}, {8, 0, 0}) == 0);     // overlapping
  CHECK(d({1, 1, 0}, {1, -1, 0}) == 0);    // crossing
}

TEST_CASE("nearly parallel segments") {
  Random random(3);
  for (const double apart : {1., 1e-3, 1e-6, 1e-9})
    for (double angle = 1e-16; angle < 1e-3; angle *= 3)
      for (int i = 0; i < 10; ++i) {
        const Vec3 a = random.turn<Spatial>(1), b = a + angle * random.vector<3>();
        const Vec3 p = random.vector<3>(), q = p + apart * random.vector<3>();
        CAPTURE(apart);
        CAPTURE(angle);
        check_pair(p, a, q, b, 2e-15);
      }
}

TEST_CASE("a circle comes near to itself from the other side") {
  for (const int n : {20, 101}) {
    CAPTURE(n);
    const Points r = regular_polygon(n);
    int k = 2;  // edges from one to the other: the first that is 1.5 times as far along the arc
    while (k * 2 * std::sin(π / n) <= 1.5 * 2 * std::cos(π / n) * std::sin(k * π / n)) ++k;
    const Approach found = self_approach({r, Closure::closed}, 1);
    CHECK(found.distance == doctest::Approx(2 * std::sin((k - 1) * π / n)).epsilon(1e-14));
    const int apart = found.other - found.edge;
    CHECK(std::min(apart, n - apart) == k);
  }
}

TEST_CASE("two strands that one bend joins are their distance apart") {
  Points r;
  for (int j = 0; j <= 20; ++j) r.push_back({double(j), 0, 0});
  for (int j = 20; j >= 0; --j) r.push_back({j + 0.25, 0.5, 0});
  const Approach found = self_approach(Arc{r}, 1);
  CHECK(found.distance == 0.5);
  CHECK(found.edge < 20);
  CHECK(found.other > 20);
}

TEST_CASE("a straight arc and a slightly bent one come near to themselves nowhere") {
  const Points line = points([](double t) { return Vec3(t, 2 * t, 3 * t); }, 1, 50);
  const Points bent = points([](double t) { return Vec3(std::cos(t), std::sin(t), 0); }, 2.9, 50);
  for (const Points& r : {line, bent}) {
    const Approach found = self_approach(Arc{r});
    CHECK(std::isinf(found.distance));
    CHECK(found.edge == -1);
    CHECK(found.other == -1);
  }
}

TEST_CASE("neighbours do not count, however sharp the corner, around the start neither") {
  const Points rhombus{{0, 0, 0}, {10, 1, 0}, {20, 0, 0}, {10, -1, 0}};
  Points r = rhombus;
  for (int start = 0; start < 4; ++start) {
    const Approach found = self_approach({r, Closure::closed});
    CHECK(found.distance == doctest::Approx(20 / std::sqrt(101.)).epsilon(1e-15));
    CHECK(found.other == found.edge + 2);
    std::rotate(r.begin(), r.begin() + 1, r.end());
  }
}

TEST_CASE("self-approach of random arcs, against all pairs that count") {
  Random random(4);
  for (const Closure closure : {Closure::open, Closure::closed})
    for (int i = 0; i < 5; ++i) {
      const Points r = random_points(random, 30);
      const Arc arc{r, closure};
      const Grid ς = arc_length(arc);
      double expected = std::numeric_limits<double>::infinity();
      for (int j = 0; j < arc.edges(); ++j)
        for (int k = j + 2; k < arc.edges(); ++k) {
          if (arc.closed() && j == 0 && k == arc.edges() - 1) continue;
          double along = ς.centre(k) - ς.centre(j);
          if (arc.closed()) along = std::min(along, ς.length() - along);
          if (along > 1.5 * distance(arc.centre(j), arc.centre(k)))
            expected = std::min(expected, slow_distance(r[j], arc.edge(j), r[k], arc.edge(k)));
        }
      const Approach found = self_approach(arc);
      CHECK(std::abs(found.distance - expected) < 1e-14);
      CHECK(slow_distance(r[found.edge], arc.edge(found.edge), r[found.other],
                          arc.edge(found.other)) == doctest::Approx(expected).epsilon(1e-12));
    }
}

TEST_CASE("the nearest edges of two arcs, against all pairs") {
  Random random(5);
  for (int i = 0; i < 10; ++i) {
    const Points r = random_points(random, 20), s = random_points(random, 31);
    const Arc arc{r, Closure::closed}, other{s};
    const Approach found = approach(arc, other);
    const double expected = by_all_pairs(arc, other);
    CHECK(std::abs(found.distance - expected) < 1e-14);
    CHECK(slow_distance(r[found.edge], arc.edge(found.edge), s[found.other],
                        other.edge(found.other)) == doctest::Approx(expected).epsilon(1e-12));
    CHECK(std::abs(approach(other, arc).distance - found.distance) < 1e-15);
  }
}

TEST_CASE("the same for any number of threads, and it can be told to stop") {
  const Points r = loop(torus_curve(2, 3, 2), 200), s = loop(torus_curve(2, 3, 2, 1), 200);
  const Arc arc{r, Closure::closed}, other{s, Closure::closed};
  const auto same = [](const Approach& a, const Approach& b) {
    return a.distance == b.distance && a.edge == b.edge && a.other == b.other;
  };
  for (const int threads : {2, 3, 8}) {
    CHECK(same(self_approach(arc, threads), self_approach(arc, 1)));
    CHECK(same(approach(arc, other, threads), approach(arc, other, 1)));
  }
  CHECK_THROWS_AS(self_approach(arc, 2, [] { return false; }), Interrupted);
  CHECK_THROWS_AS(approach(arc, other, 2, [] { return false; }), Interrupted);
}
