// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/link.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

double writhe_of(const Points& r, int threads = 1) { return writhe({r, Closure::closed}, threads); }

double link_of(const Points& r, const Points& s) {
  return gauss_integral({r, Closure::closed}, {s, Closure::closed}, 1);
}

Points reversed(Points r) {
  std::reverse(r.begin(), r.end());
  return r;
}

/// Gauss's integral over two edges that are apart, by five Gauss points either way on parts that
/// are small beside their distance.
double slow_integral(const Vec3& p, const Vec3& a, const Vec3& q, const Vec3& b) {
  const double between = (p + a / 2 - q - b / 2).norm();
  if (a.norm() + b.norm() > 0.4 * between) {
    double sum = 0;
    for (const double i : {0., 0.5})
      for (const double k : {0., 0.5}) sum += slow_integral(p + i * a, a / 2, q + k * b, b / 2);
    return sum;
  }
  constexpr double places[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                               0.9061798459386640};
  constexpr double weights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                0.4786286704993665, 0.2369268850561891};
  double sum = 0;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k) {
      const Vec3 d = q + (1 + places[k]) / 2 * b - p - (1 + places[i]) / 2 * a;
      sum += weights[i] * weights[k] / 4 * d.dot(b.cross(a)) / std::pow(d.norm(), 3);
    }
  return sum;
}

}  // namespace

TEST_CASE("a curve that passes up through a circle run counter-clockwise is linked by +1") {
  for (const int n : {3, 4, 50}) {
    const Points circle = regular_polygon(n, 2);
    const Points through{{0.1, 0.2, -5}, {0.2, 0.1, 5}, {9, 0, 5}, {9, 0, -5}};
    CHECK(link_of(circle, through) == doctest::Approx(1).epsilon(1e-14));
    CHECK(link_of(through, circle) == doctest::Approx(1).epsilon(1e-14));
    CHECK(link_of(circle, reversed(through)) == doctest::Approx(-1).epsilon(1e-14));
    CHECK(link_of(reversed(circle), reversed(through)) == doctest::Approx(1).epsilon(1e-14));
    CHECK(link_of(mirrored(circle), mirrored(through)) == -link_of(circle, through));
  }
}

TEST_CASE("two strands of a torus, wound around each other k times") {
  for (const int k : {1, 2, 5}) {
    CAPTURE(k);
    const Points a = loop(torus_curve(1, k, 3), 60);
    const Points b = loop(torus_curve(1, k, 3, std::numbers::pi), 60);
    CHECK(link_of(a, b) == doctest::Approx(-k).epsilon(1e-13));
    CHECK(link_of(mirrored(a), mirrored(b)) == doctest::Approx(k).epsilon(1e-13));
    CHECK(link_of(a, reversed(b)) == doctest::Approx(k).epsilon(1e-13));
  }
}

TEST_CASE("curves that are not linked: apart, one inside the other in a plane, entangled") {
  const Points circle = regular_polygon(30);
  const auto moved = [&](const Vec3& by) {
    return mapped(circle, [&](const Vec3& x) -> Vec3 { return x + by; });
  };
  CHECK(std::abs(link_of(circle, moved({5, 1, 0.3}))) < 1e-15);
  CHECK(std::abs(link_of(circle, moved({0.1, 0, 1e-3}))) < 1e-13);
  CHECK(link_of(circle, regular_polygon(30, 2)) == 0);
  // Whitehead's link: one curve passes through the other up and down again
  const Points hairpin{{0, 0.1, -2}, {0, 0.1, 2}, {0, -0.1, 2}, {0, -0.1, -2}};
  CHECK(std::abs(link_of(circle, hairpin)) < 1e-14);
}

TEST_CASE("any two closed polygons are linked a whole number of times") {
  Random random(1);
  int linked = 0;
  for (int i = 0; i < 200; ++i) {
    const Points r = random_points(random, 12), s = random_points(random, 9);
    const double link = link_of(r, s);
    CHECK(std::abs(link - std::round(link)) < 1e-12);
    linked += std::abs(link) > 0.5;
  }
  CHECK(linked > 10);
}

TEST_CASE("open arcs: the integral itself, edge by edge") {
  Random random(2);
  for (int i = 0; i < 10; ++i) {
    const Points r{random.vector<3>(), random.vector<3>()};
    const Points s = mapped(Points{random.vector<3>(), random.vector<3>()},
                            [](const Vec3& x) -> Vec3 { return x + Vec3(1.5, 1.5, 1.5); });
    const double expected =
        slow_integral(r[0], r[1] - r[0], s[0], s[1] - s[0]) / (4 * std::numbers::pi);
    CHECK(std::abs(gauss_integral(Arc{r}, Arc{s}, 1) - expected) < 1e-9 * std::abs(expected));
  }
}

TEST_CASE("writhe of a small knot, by quadrature") {
  const Points r{
      {1, 0, 0.4}, {-1, 0.9, -0.5}, {-0.3, -1.2, 0.6}, {0.7, 1.1, -0.4}, {-1.2, -0.5, 0.1}};
  for (const Closure closure : {Closure::open, Closure::closed}) {
    const Arc part{r, closure};
    double expected = 0;
    for (int i = 0; i < part.edges(); ++i)
      for (int j = i + 2; j < part.edges(); ++j)
        if (!(part.closed() && i == 0 && j == part.edges() - 1))
          expected += slow_integral(r[i], part.edge(i), r[j], part.edge(j));
    CHECK(std::abs(writhe(part, 1) - expected / (2 * std::numbers::pi)) < 1e-9);
  }
}

TEST_CASE("writhe of smooth knots, with second order") {
  struct Knot {
    int around, through;
    double R, writhe;
  };
  // of the reference curves G_torus_knot_2_3 and G_torus_knot_3_2
  for (const auto& k : {Knot{2, 3, 2, -3.51823923103885975}, Knot{3, 2, 3, -3.94478068387737251}}) {
    const auto error = [&](int n) {
      return writhe_of(loop(torus_curve(k.around, k.through, k.R), n)) - k.writhe;
    };
    CHECK(std::log2(error(150) / error(300)) == doctest::Approx(2).epsilon(0.01));
    CHECK(std::abs(error(300)) < 2e-3);
  }
}

TEST_CASE("plane polygons have no writhe, not even a rounding; two edges, a triangle neither") {
  CHECK(writhe_of(regular_polygon(50)) == 0);
  const Points comb{{0, 0, 0}, {3, 0, 0}, {3, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}};
  CHECK(writhe_of(comb) == 0);
  Random random(3);
  const Quaternion q = random.rotation<Spatial>();
  CHECK(std::abs(writhe_of(mapped(comb, [&](const Vec3& x) { return rotate(q, x); }))) < 1e-15);
  CHECK(writhe(Arc{random_points(random, 3)}, 1) == 0);
  CHECK(writhe_of(random_points(random, 3)) == 0);
}

TEST_CASE("writhe changes its sign in the mirror, and nowhere else") {
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    const Points r = random_points(random, 30);
    const double expected = writhe_of(r);
    CHECK(writhe_of(mirrored(r)) == -expected);
    CHECK(std::abs(writhe_of(reversed(r)) - expected) < 1e-13);
    CHECK(writhe_of(mapped(r, [](const Vec3& x) -> Vec3 { return 0x1p190 * x; })) == expected);
    CHECK(writhe_of(mapped(r, [](const Vec3& x) -> Vec3 { return 0x1p-190 * x; })) == expected);
    Points turned = r;
    std::rotate(turned.begin(), turned.begin() + 7, turned.end());
    CHECK(std::abs(writhe_of(turned) - expected) < 1e-13);
    const Quaternion q = random.rotation<Spatial>();
    const Points moved = mapped(r, [&](const Vec3& x) { return rotate(q, x); });
    CHECK(std::abs(writhe_of(moved) - expected) < 1e-12);
  }
}

TEST_CASE("vertices put onto edges change nothing") {
  Random random(5);
  const Points r = random_points(random, 15);
  Points finer;
  for (int j = 0; j < 15; ++j) {
    const Vec3& next = r[std::size_t((j + 1) % 15)];
    finer.push_back(r[j]);
    finer.push_back(r[j] + random.number(0.2, 0.8) * (next - r[j]));
  }
  CHECK(std::abs(writhe_of(finer) - writhe_of(r)) < 1e-12);
}

TEST_CASE("the same to the last bit on any number of threads; and told to stop it stops") {
  Random random(6);
  const Points r = random_points(random, 60), s = random_points(random, 40);
  const Arc arc{r, Closure::closed}, other{s, Closure::closed};
  for (const int threads : {0, 2, 3, 8}) {
    CHECK(writhe(arc, threads) == writhe(arc, 1));
    CHECK(gauss_integral(arc, other, threads) == gauss_integral(arc, other, 1));
  }
  CHECK_THROWS_AS(writhe(arc, 2, [] { return false; }), Interrupted);
  CHECK_THROWS_AS(gauss_integral(arc, other, 2, [] { return false; }), Interrupted);
}
