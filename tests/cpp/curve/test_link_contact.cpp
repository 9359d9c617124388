// SPDX-License-Identifier: BSD-3-Clause
// Knots whose framings close: whole numbers. And edges that meet, where no number is right.
#include <pyrod/curve/bishop.hpp>
#include <pyrod/curve/frenet.hpp>
#include <pyrod/curve/link.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;

/// Of the Frenet frames of a closed polygon.
double self_link(const Points& r) {
  const Arc arc{r, Closure::closed};
  return writhe(arc, 1) + dihedral_angles(arc, binormals(arc)).sum() / (2 * π);
}

Vec3 unknot(double t) {
  return {std::cos(t) + 0.2 * std::cos(2 * t) + 0.1 * std::sin(2 * t),
          std::sin(t) - 0.15 * std::cos(2 * t),
          0.3 * std::cos(2 * t) + 0.25 * std::sin(2 * t) + 0.1 * std::sin(3 * t)};
}

std::string refused(const Points& r, Closure closure = Closure::open) {
  return refusal([&] { writhe({r, closure}, 1); });
}

std::string meeting(int i, int j, const std::string& whose) {
  return "positions: edge " + std::to_string(i) + " meets edge " + std::to_string(j) + " of the " +
         whose + " curve, so that crossings cannot be counted; move the curve apart there";
}

/// Up to a vertical edge, over to the start of the last edge, and along it.
Points crossing(const Vec3& from, const Vec3& to) {
  return {{0, 0, -1}, {0, 0, 1}, {3, 3, 3}, from, to};
}

}  // namespace

TEST_CASE("writhe and torsion of knots add up to the self-link of their Frenet frames") {
  for (const int n : {60, 200, 500}) {
    CAPTURE(n);
    CHECK(std::abs(self_link(loop(torus_curve(2, 3, 2), n)) + 6) < 1e-10);
    CHECK(std::abs(self_link(loop(torus_curve(3, 2, 3), n)) + 4) < 1e-10);
    CHECK(std::abs(self_link(loop(unknot, n))) < 1e-10);
    CHECK(std::abs(self_link(mirrored(loop(torus_curve(2, 3, 2), n))) - 6) < 1e-10);
  }
}

TEST_CASE("writhe and torsion of any polygon add up to a whole number") {
  Random random(1);
  for (int i = 0; i < 100; ++i) {
    const double link = self_link(random_points(random, 20));
    CHECK(std::abs(link - std::round(link)) < 1e-12);
  }
}

TEST_CASE("a curve and the edge of its ribbon are linked by twist and writhe") {
  const Points r = loop(torus_curve(2, 3, 2), 120);
  const Arc arc{r, Closure::closed};
  const Grid grid = arc_length(arc);
  const auto bishop = bishop_frames(arc, adapted(Quaternion::Identity(), arc.edge(0)));
  for (const int k : {-2, 0, 3}) {
    CAPTURE(k);
    const double rest = -holonomy(arc);  // closes the ribbon
    Vector φ(120);
    for (int j = 0; j < 120; ++j) φ[j] = (2 * π * k + rest) * grid.centre(j) / grid.length();
    const auto curve = closed(r, turned_about_tangents(bishop, φ));
    const double expected = twist_angles(grid, curve).sum() / (2 * π) + writhe(arc, 1);
    CHECK(std::abs(expected - std::round(expected)) < 1e-12);
    Points edge = r;
    for (int j = 0; j < 120; ++j)
      edge[j] += 0.05 * rotate(vertex_frame(grid, curve, j), Vec3::UnitX());
    CHECK(std::abs(gauss_integral(arc, {edge, Closure::closed}, 1) - expected) < 1e-12);
  }
}

TEST_CASE("edges that cross, touch or overlap are refused, with both numbers") {
  const std::string same = meeting(0, 3, "same");
  CHECK(refused(crossing({-1, 0, 0}, {1, 0, 0})) == same);  // crosses
  CHECK(refused(crossing({-1, 0.5, 0.2}, {1, -0.5, 0.2})) == same);
  CHECK(refused(crossing({1, 1, 0.5}, {0, 0, 0.5})) == same);  // ends on the edge
  CHECK(refused(crossing({0, 0, 0.5}, {1, 1, 0})).find("edge 0 meets edge ") != std::string::npos);
  CHECK(refused(crossing({2, 2, 1}, {-2, -2, -3})) == same);  // passes through its start
  CHECK(refused(crossing({0, 0, -3}, {0, 0, 0})) == same);    // overlaps
  CHECK(refused(crossing({0, 0, -3}, {0, 0, -1})) == same);   // in line, end to start
  CHECK(refused(crossing({0, 0, -3}, {0, 0, -2})) == "(not refused)");
  CHECK(refused(crossing({-1, 1e-6, 0}, {1, 1e-6, 0})) == "(not refused)");
}

TEST_CASE("a polygon that runs through one of its vertices twice is refused") {
  const Points eight{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 0, 0}, {-1, 0, 0}, {-1, 1, 1}};
  CHECK(refused(eight, Closure::closed) == meeting(0, 2, "same"));
}

TEST_CASE("two curves that meet are refused, wherever they are") {
  Random random(2);
  const Points square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (int i = 0; i < 300; ++i) {
    const Quaternion q = random.rotation<Spatial>();
    const auto placed = [&](const Points& r) {
      return mapped(r, [&](const Vec3& x) { return rotate(q, x); });
    };
    const double y = random.number(-0.9, 0.9);
    // through edge 1 of the square, by the middle of edge 0
    const Points through = placed({{1, y, -3}, {1, y, 2}, {5, 6, 7}}), held = placed(square);
    const std::string message =
        refusal([&] { gauss_integral({held, Closure::closed}, {through, Closure::closed}, 1); });
    CHECK(message == meeting(1, 0, "other"));
  }
}

TEST_CASE("a curve meets itself, taken as another one, in its own edges") {
  const Points r = regular_polygon(5), copy = r;
  CHECK_REFUSED("positions: edge 0 meets edge 0 of the other curve",
                gauss_integral({r, Closure::closed}, {copy, Closure::closed}, 1));
}

TEST_CASE("near passes jump by one crossing, and are counted however near") {
  Random random(3);
  const Points square{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  for (const double gap : {1e-3, 1e-6, 1e-9, 1e-12, 1e-13})
    for (int i = 0; i < 50; ++i) {
      CAPTURE(gap);
      const Quaternion q = random.rotation<Spatial>();
      const double y = random.number(-0.9, 0.9), up = random.number(0.5, 3);
      const auto link = [&](double x) {
        const Points loop{{x, y, -3}, {x, y, up}, {5, y, up}, {5, y, -3}};
        const auto placed = [&](const Vec3& v) { return rotate(q, v); };
        const Points r = mapped(square, placed), s = mapped(loop, placed);
        return gauss_integral({r, Closure::closed}, {s, Closure::closed}, 1);
      };
      CHECK(link(1 - gap) == doctest::Approx(1).epsilon(1e-13));
      CHECK(std::abs(link(1 + gap)) < 1e-13);
    }
}
