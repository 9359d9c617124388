// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rotation/embedding.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;

template <class Space>
void check_same(const CosseratCurve<Space>& a, const CosseratCurve<Space>& b, double tolerance) {
  CHECK(distance(a.positions, b.positions) < tolerance);
  CHECK(distance(a.frames, b.frames) < tolerance);
  CHECK(distance(a.start_frame, b.start_frame) < tolerance);
  CHECK(distance(a.end_frame, b.end_frame) < tolerance);
}

/// Strains weighed with their cells: turns and edges.
template <class Space>
void check_same(const Grid& grid, const Strains<Space>& a, const Strains<Space>& b,
                double tolerance) {
  REQUIRE(a.K.size() == b.K.size());
  REQUIRE(a.Γ.size() == b.Γ.size());
  for (int j = 0; j <= grid.edges(); ++j) CHECK(grid.Δs(j) * distance(a.K[j], b.K[j]) < tolerance);
  CHECK(distance(a.Γ, b.Γ) < tolerance);
}

}  // namespace

TEST_CASE_TEMPLATE("curve and strains determine each other", Space, EACH_SPACE) {
  Random random(1);
  const double limit = Space::spin == 1 ? 40 : 6.2;  // both go beyond a half turn per vertex
  for (int edges : {1, 2, 30}) {
    const Grid grid = random.grid(edges, 5);
    const Strains<Space> given = random.strains<Space>(grid, limit);
    const Point<Space> r0 = random.vector<Space::dim>();
    const auto q0 = random.rotation<Space>();
    const CosseratCurve<Space> curve = reconstruct<Space>(grid, given, r0, q0);
    CHECK(curve.edges() == edges);
    CHECK(distance(curve.positions[0], r0) == 0);
    CHECK(distance(curve.start_frame, q0) == 0);
    const Strains<Space> found = strains(grid, curve);
    check_same(grid, found, given, 1e-13);
    check_same(reconstruct<Space>(grid, found, r0, q0), curve, 1e-13);
  }
}

TEST_CASE_TEMPLATE("the turn at a vertex leads from the frame before to the one behind", Space,
                   EACH_SPACE) {
  Random random(2);
  const Grid grid = random.grid(4);
  const auto curve = random.curve<Space>(grid, 5);
  for (int j = 0; j <= 4; ++j)
    CHECK(distance(curve.frame_before(j) * exp(turn(curve, j)), curve.frame_behind(j)) < 1e-14);
  CHECK(distance(curve.frame_before(0), curve.start_frame) == 0);
  CHECK(distance(curve.frame_behind(4), curve.end_frame) == 0);
  CHECK(distance(curve.frame_before(2), curve.frames[1]) == 0);
  CHECK(distance(curve.frame_behind(2), curve.frames[2]) == 0);
}

TEST_CASE_TEMPLATE("a straight curve along e3", Space, EACH_SPACE) {
  const Grid grid = Grid::uniform(2, 5);
  const Strains<Space> straight{std::vector<Spin<Space>>(6, Spin<Space>::Zero()),
                                std::vector<Point<Space>>(5, axis<Space>())};
  const auto curve =
      reconstruct<Space>(grid, straight, Point<Space>::Zero(), Space::Rotation::Identity());
  for (int j = 0; j <= 5; ++j)
    CHECK(distance(curve.positions[j], grid.s(j) * axis<Space>()) < 1e-15);
}

TEST_CASE("constant strains: vertices on one cylinder, images of each other under one screw") {
  Random random(3);
  const int n = 200;
  const Grid grid = Grid::uniform(30, n);
  const Vec3 K(0.9, -1.3, 2.1), Γ(0.2, -0.1, 1.1), r0 = random.vector<3>();
  const Quaternion q0 = random.rotation<Spatial>();
  const auto curve =
      reconstruct<Spatial>(grid, {std::vector<Vec3>(n + 1, K), std::vector<Vec3>(n, Γ)}, r0, q0);

  const Vec3 direction = rotate(q0, K).normalized();  // of the axis
  const double α = grid.h(0) * K.norm();
  const Vec3 edge = grid.h(0) * rotate(q0 * exp(Vec3(grid.h(0) / 2 * K)), Γ);
  const Vec3 rise = edge.dot(direction) * direction, chord = edge - rise;
  const Vec3 centre = r0 + chord / 2 + direction.cross(chord) / (2 * std::tan(α / 2));
  for (int j = 0; j <= n; ++j) {
    const Vec3 expected = centre + j * rise + rotate(exp(Vec3(j * α * direction)), r0 - centre);
    CHECK(distance(curve.positions[j], expected) < 1e-12);
  }
}

TEST_CASE("constant curvature in the plane: a regular polygon that closes") {
  const int n = 12;
  const Grid grid = Grid::uniform(1, n);
  const auto polygon = reconstruct<Planar>(
      grid, {std::vector<Vec1>(n + 1, Vec1(2 * π)), std::vector<Vec2>(n, Vec2(0, 1))}, Vec2(3, 4),
      Angle{1});
  CHECK(distance(polygon.positions[n], Vec2(3, 4)) < 1e-15);
  CHECK(polygon.end_frame.radians == doctest::Approx(1 + 2 * π).epsilon(1e-15));
  const double radius = 1. / n / (2 * std::sin(π / n));
  const Vec2 opposite = polygon.positions[n / 2] - polygon.positions[0];
  CHECK(opposite.norm() == doctest::Approx(2 * radius).epsilon(1e-14));
}

TEST_CASE_TEMPLATE("strains do not see a rigid motion", Space, EACH_SPACE) {
  Random random(4);
  const Grid grid = random.grid(20);
  const auto curve = random.curve<Space>(grid, 5);
  const auto Q = random.rotation<Space>();
  const Point<Space> t = random.vector<Space::dim>();
  auto moved = curve;
  for (auto& r : moved.positions) r = t + rotate(Q, r);
  for (auto& q : moved.frames) q = Q * q;
  moved.start_frame = Q * curve.start_frame;
  moved.end_frame = Q * curve.end_frame;
  check_same(grid, strains(grid, moved), strains(grid, curve), 1e-13);
}

TEST_CASE_TEMPLATE("the curve run backwards: frames half a turn about a2", Space, EACH_SPACE) {
  Random random(5);
  const int n = 20;
  const Grid grid = random.grid(n);
  const auto curve = random.curve<Space>(grid, 5);
  const auto half = restrict_rotation<Space>(exp(Vec3(0, π, 0)));

  const Grid backward_grid(grid.edge_lengths().reverse());
  CosseratCurve<Space> backward{
      curve.positions, {}, curve.end_frame * half, curve.start_frame * half};
  std::reverse(backward.positions.begin(), backward.positions.end());
  for (int j = n; j-- > 0;) backward.frames.push_back(curve.frames[j] * half);

  const auto forth = strains(grid, curve), back = strains(backward_grid, backward);
  for (int j = 0; j <= n; ++j) {
    const Vec3 K = embed_spin(forth.K[n - j]);
    CHECK(grid.Δs(n - j) * distance(embed_spin(back.K[j]), Vec3(K[0], -K[1], K[2])) < 1e-13);
  }
  for (int j = 0; j < n; ++j) {
    const Vec3 Γ = embed(forth.Γ[n - 1 - j]);
    CHECK(distance(embed(back.Γ[j]), Vec3(Γ[0], -Γ[1], Γ[2])) < 1e-13);
  }
}

TEST_CASE_TEMPLATE("under constant curvature every frame is where its arc length says", Space,
                   EACH_SPACE) {
  Random random(6);
  const int n = 15;
  const Grid grid = random.grid(n, 3);
  const Spin<Space> K = random.turn<Space>(4);
  const auto q0 = random.rotation<Space>();
  const auto curve = reconstruct<Space>(
      grid, {std::vector<Spin<Space>>(n + 1, K), std::vector<Point<Space>>(n, axis<Space>())},
      Point<Space>::Zero(), q0);
  for (int j = 0; j <= n; ++j)
    CHECK(distance(vertex_frame(grid, curve, j), q0 * exp(Spin<Space>(grid.s(j) * K))) < 1e-14);
  for (int j = 0; j < n; ++j)
    CHECK(distance(curve.frames[j], q0 * exp(Spin<Space>(grid.centre(j) * K))) < 1e-14);
}

TEST_CASE("planar curves are spatial ones in a plane") {
  Random random(7);
  const Grid grid = random.grid(20, 4);
  const auto plane = random.strains<Planar>(grid, 6);
  Strains<Spatial> space;
  for (const auto& K : plane.K) space.K.push_back(embed_spin(K));
  for (const auto& Γ : plane.Γ) space.Γ.push_back(embed(Γ));
  const auto flat = reconstruct<Planar>(grid, plane, Vec2(1, 2), Angle{0.4});
  const auto curve = reconstruct<Spatial>(grid, space, Vec3(1, 0, 2), embed(Angle{0.4}));
  for (int j = 0; j <= 20; ++j)
    CHECK(distance(embed(flat.positions[j]), curve.positions[j]) < 1e-13);
  for (int j = 0; j < 20; ++j) CHECK(distance(embed(flat.frames[j]), curve.frames[j]) < 1e-13);
  CHECK(distance(embed(flat.end_frame), curve.end_frame) < 1e-13);
}

TEST_CASE_TEMPLATE("in every measure curve and strains determine each other", Space, EACH_SPACE) {
  Random random(8);
  for (const Measure measure : {Measure::log, Measure::chord, Measure::cayley}) {
    CAPTURE(name(measure));
    const Grid grid = random.grid(30, 5);
    auto given = random.strains<Space>(grid, 2.5);
    for (int j = 0; j <= 30; ++j)  // sizes of turns by as much
      given.K[j] *=
          measured(grid.Δs(j) * given.K[j].norm(), measure) / (grid.Δs(j) * given.K[j].norm());
    const Point<Space> r0 = random.vector<Space::dim>();
    const auto q0 = random.rotation<Space>();
    const auto curve = reconstruct<Space>(grid, given, r0, q0, measure);
    const auto found = strains(grid, curve, measure);
    check_same(grid, found, given, 1e-13);
    check_same(reconstruct<Space>(grid, found, r0, q0, measure), curve, 1e-13);
    for (int j = 0; j <= 30; ++j)
      CHECK(grid.Δs(j) *
                distance(found.K[j], measured(difference(curve, j), measure) / grid.Δs(j)) <
            1e-14);
  }
}

TEST_CASE_TEMPLATE("strains of a smooth curve, sampled, give it back with second order", Space,
                   EACH_SPACE) {
  // R = exp(f e1) exp(g e3) in space, exp(f e2) in the plane, and any r
  const auto f = [](double s) { return std::sin(2 * s) + s; };
  const auto df = [](double s) { return 2 * std::cos(2 * s) + 1; };
  const auto g = [](double s) { return s * s; };
  const auto R = [&](double s) {
    if constexpr (Space::spin == 1)
      return Angle{f(s)};
    else
      return exp(Vec3(f(s), 0, 0)) * exp(Vec3(0, 0, g(s)));
  };
  const auto K = [&](double s) -> Spin<Space> {
    if constexpr (Space::spin == 1)
      return Vec1(df(s));
    else
      return Vec3(df(s) * std::cos(g(s)), -df(s) * std::sin(g(s)), 2 * s);
  };
  const auto r = [](double s) -> Point<Space> {
    if constexpr (Space::dim == 2)
      return Vec2(std::cos(s), 2 * s);
    else
      return Vec3(std::cos(s), 2 * s, std::exp(s));
  };
  const auto dr = [](double s) -> Point<Space> {
    if constexpr (Space::dim == 2)
      return Vec2(-std::sin(s), 2);
    else
      return Vec3(-std::sin(s), 2, std::exp(s));
  };
  const double length = 1.5;
  double frames[2], positions[2];
  for (int level = 0; level < 2; ++level) {
    const Grid grid = Grid::uniform(length, 100 << level);
    const auto given =
        sampled<Space>(grid, K, [&](double s) -> Point<Space> { return unrotate(R(s), dr(s)); });
    const auto curve = reconstruct<Space>(grid, given, r(0), R(0));
    frames[level] = distance(curve.end_frame, R(length));
    positions[level] = distance(curve.positions.back(), r(length));
  }
  CHECK(std::log2(frames[0] / frames[1]) == doctest::Approx(2).epsilon(0.01));
  CHECK(std::log2(positions[0] / positions[1]) == doctest::Approx(2).epsilon(0.01));
  CHECK(frames[1] < 1e-3);
  CHECK(positions[1] < 1e-3);
}
