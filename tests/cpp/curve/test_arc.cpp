// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/arc.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
const double infinite = std::numeric_limits<double>::infinity();

const Points corner{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 1, 4}};

std::string refused(const Arc& arc) {
  return refusal([&] { arc.check(); });
}
std::string refused(const Points& r, Closure closure = Closure::open) {
  return refused({r, closure});
}

}  // namespace

TEST_CASE("an open arc: edges, centres, lengths, tangents") {
  const Arc arc{corner};
  CHECK_FALSE(arc.closed());
  CHECK(arc.vertices() == 4);
  CHECK(arc.edges() == 3);
  CHECK(arc.edge(2) == Vec3(0, 0, 4));
  CHECK(arc.centre(1) == Vec3(2, 0.5, 0));
  CHECK(arc_length(arc).edge_lengths() == Vec3(2, 1, 4));
  CHECK(arc_length(arc).cell_lengths() == Vec<4>(1, 1.5, 2.5, 2));
  CHECK(tangents(arc) == Points{Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()});
  CHECK_NOTHROW(arc.check());
}

TEST_CASE("a closed arc: the last edge leads to the first vertex") {
  const Arc arc{corner, Closure::closed};
  CHECK(arc.closed());
  CHECK(arc.edges() == 4);
  CHECK(arc.next(3) == 0);
  CHECK(arc.next(2) == 3);
  CHECK(arc.edge(3) == Vec3(-2, -1, -4));
  CHECK(arc.centre(3) == Vec3(1, 0.5, 2));
  CHECK(arc.before(0) == arc.edge(3));
  CHECK(arc.behind(3) == arc.edge(3));
  const Grid ς = arc_length(arc);
  CHECK(ς.closed());
  CHECK(ς.h(3) == std::sqrt(21.));
  CHECK(ς.Δs(0) == (2 + std::sqrt(21.)) / 2);
  CHECK(tangents(arc).size() == 4);
  CHECK_NOTHROW(arc.check());
}

TEST_CASE("directions before and behind a vertex; at ends that nothing holds those of the edge") {
  const Arc arc{corner};
  CHECK(arc.before(1) == arc.edge(0));
  CHECK(arc.behind(1) == arc.edge(1));
  CHECK(arc.before(0) == arc.edge(0));
  CHECK(arc.behind(3) == arc.edge(2));
  CHECK(arc.turning(0).angle() == 0);
  CHECK(arc.turning(1).angle() == π / 2);
  CHECK(arc.turning(3).angle() == 0);
}

TEST_CASE("an end held by a tangent turns, over half an edge") {
  const Arc arc{corner, Closure::open, Vec3(0, 7, 0), Vec3(0, 3, 3)};
  CHECK(arc.before(0) == Vec3(0, 7, 0));
  CHECK(arc.behind(3) == Vec3(0, 3, 3));
  CHECK(arc.turning(0).angle() == π / 2);
  CHECK(arc.turning(0).binormal() == -Vec3::UnitZ());
  CHECK(arc.turning(3).angle() == doctest::Approx(π / 4).epsilon(1e-15));
  CHECK_NOTHROW(arc.check());
}

TEST_CASE("the shortest arcs") {
  const Points two{{0, 0, 0}, {0, 3, 4}}, triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  CHECK_NOTHROW(Arc{two}.check());
  CHECK(arc_length(Arc{two}).length() == 5);
  CHECK(Arc{two}.turning(0).angle() == 0);
  CHECK_NOTHROW((Arc{triangle, Closure::closed}.check()));
  CHECK(refused(Points{{0, 0, 0}}) == "positions: expected at least 2 vertices, got 1");
  CHECK(refused(Points{}) == "positions: expected at least 2 vertices, got 0");
  CHECK(refused(two, Closure::closed) == "positions: expected at least 3 vertices, got 2");
}

TEST_CASE("positions that are no numbers, edges of no length and of too much are refused by name") {
  CHECK(refused(Points{{0, 0, 0}, {1, infinite, 0}}) ==
        "positions[1]: expected finite numbers, got   1 inf   0");
  CHECK_REFUSED("positions[0]: expected finite",
                Arc{Points{{0, std::nan(""), 0}, {1, 0, 0}}}.check());
  CHECK(refused(Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}) ==
        "positions[2]: coincides with positions[1]; leave one of the two out");
  CHECK(refused(Points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}}, Closure::closed) ==
        "positions[0]: coincides with positions[3]; leave one of the two out (a closed arc returns "
        "to its first vertex by itself)");
  CHECK_NOTHROW(Arc{Points{{0, 0, 0}, {1.1e-60, 0, 0}}}.check());
  CHECK_REFUSED("positions[1]: coincides", Arc{Points{{0, 0, 0}, {0.9e-60, 0, 0}}}.check());
  CHECK_NOTHROW(Arc{Points{{0, 0, 0}, {0.9e60, 0, 0}}}.check());
  CHECK(refused(Points{{0, 0, 0}, {0, 1.5e60, 0}}) ==
        "positions[1]: the edge before has length 1.5e+60; use other units of length");
}

TEST_CASE("edges that fold back are refused at the vertex between them") {
  const std::string antiparallel =
      ": the edges before and behind are antiparallel, so that the plane of their turn is lost; "
      "put "
      "a vertex aside of the fold or leave one out";
  CHECK(refused(Points{{0, 0, 0}, {1, 0, 0}, {0.5, 0, 0}}) == "positions[1]" + antiparallel);
  CHECK(refused(Points{{1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 0, 0}, {3, 0, 0}}) == "(not refused)");
  const Points closed{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  CHECK(refused(closed) == "(not refused)");
  CHECK(refused(closed, Closure::closed) == "positions[0]" + antiparallel);
  CHECK(refused({corner, Closure::open, Vec3(-1, 0, 0)}) == "positions[0]" + antiparallel);
  CHECK(refused({corner, Closure::open, std::nullopt, Vec3(0, 0, -2)}) ==
        "positions[3]" + antiparallel);
}

TEST_CASE("a fold is one also where rounded positions hide it, and none where they do not") {
  const Vec3 far(1e6, -2e6, 3e6), d = Vec3(0.6, 0.3, -0.7);
  const auto fold = [&](double aside) {
    return Points{far, far + d, far + d / 3 + aside * Vec3::UnitY()};
  };
  CHECK(refused(fold(0)).starts_with("positions[1]: the edges before and behind are anti"));
  CHECK(refused(fold(1e-7)) == "(not refused)");
}

TEST_CASE("tangents at ends: directions, and only where there is an end") {
  const std::string closed = "start_tangent, end_tangent: a closed arc has no ends";
  CHECK(refused({corner, Closure::closed, Vec3(1, 0, 0)}) == closed);
  CHECK(refused({corner, Closure::closed, std::nullopt, Vec3(1, 0, 0)}) == closed);
  CHECK(refused({corner, Closure::open, Vec3(0, 0, 0)}) ==
        "start_tangent: expected a direction, finite and not zero, got 0 0 0");
  CHECK(refused({corner, Closure::open, std::nullopt, Vec3(0, infinite, 0)}) ==
        "end_tangent: expected a direction, finite and not zero, got   0 inf   0");
  for (const double size : {0.9e-60, 1.1e60, std::nan("")})
    CHECK(
        refused({corner, Closure::open, Vec3(0, size, 0)}).starts_with("start_tangent: expected"));
}

TEST_CASE("a straight line stays within what rounded positions may turn, wherever it is") {
  Random random(1);
  double largest = 0;
  for (double far = 1; far < 1e12; far *= 3)
    for (int i = 0; i < 30; ++i) {
      const Vec3 start = random.turn<Spatial>(far), d = random.turn<Spatial>(1);
      Points line{start};
      for (int j = 1; j < 20; ++j) line.push_back(start + (j + random.number(-0.3, 0.3)) * d);
      const Arc arc{line};
      for (int j = 1; j < arc.edges(); ++j) {
        CHECK(arc.turning(j).straight(arc.rounding(j)));
        largest = std::max(largest, arc.turning(j).angle() / arc.rounding(j));
      }
    }
  CHECK(largest > 0.05);  // the tolerance is not a multiple of what is needed
}

TEST_CASE("what rounding may turn does not grow without need") {
  CHECK(Arc{corner}.rounding(1) < 1e-14);
  const Points bend{{1e6, 0, 0}, {1e6 + 1, 0, 0}, {1e6 + 2, 1e-7, 0}};
  CHECK_FALSE(Arc{bend}.turning(1).straight(Arc{bend}.rounding(1)));
}

TEST_CASE("an arc of any size has the same angles") {
  Random random(2);
  const Points r = random_points(random, 30);
  for (const double size : {0x1p-196, 0x1p196}) {
    const Points scaled = mapped(r, [&](const Vec3& x) -> Vec3 { return size * x; });
    const Arc arc{r, Closure::closed}, other{scaled, Closure::closed};
    CHECK_NOTHROW(other.check());
    CHECK(arc_length(other).length() == size * arc_length(arc).length());
    CHECK(tangents(other) == tangents(arc));
    for (int j = 0; j < 30; ++j) {
      CHECK(other.turning(j).angle() == arc.turning(j).angle());
      CHECK(other.rounding(j) == arc.rounding(j));
    }
  }
}
