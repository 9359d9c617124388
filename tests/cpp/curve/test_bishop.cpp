// SPDX-License-Identifier: BSD-3-Clause
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
const Vec3 e1 = Vec3::UnitX(), e2 = Vec3::UnitY(), e3 = Vec3::UnitZ();

/// How far from 0 an angle is on the circle.
double modulo(double angle) { return std::abs(std::remainder(angle, 2 * π)); }

double holonomy_of(const Points& r) { return holonomy({r, Closure::closed}); }
double writhe_of(const Points& r) { return writhe({r, Closure::closed}, 1); }

}  // namespace

TEST_CASE("each frame is the one before, turned least") {
  Random random(1);
  const Points r = random_points(random, 50);
  const Arc arc{r, Closure::open, random.vector<3>()};
  const Quaternion start = adapted(random.rotation<Spatial>(), arc.before(0));
  const auto frames = bishop_frames(arc, start);
  REQUIRE(frames.size() == 49);
  CHECK(distance(frames[0], arc.turning(0).rotation() * start) < 2e-15);
  for (int j = 1; j < 49; ++j) {
    CHECK(distance(frames[j], arc.turning(j).rotation() * frames[j - 1]) < 2e-15);
    CHECK(std::abs(twist_angle(frames[j - 1].conjugate() * frames[j])) < 1e-14);
    for (int k = 0; k < 2; ++k)  // directors keep their component along the axis of the turn
      CHECK(std::abs((matrix(frames[j]).col(k) - matrix(frames[j - 1]).col(k))
                         .dot(arc.turning(j).binormal())) < 4e-15);
  }
}

TEST_CASE("a million edges leave frames orthonormal, adapted, and at their angle to each other") {
  Random random(2);
  const int n = 1000000;
  const Points r = points(
      [&](double t) -> Vec3 {
        return Vec3(std::cos(t), std::sin(t), 0.1 * t) + 0.01 * random.vector<3>();
      },
      1e5, n);
  const Arc arc{r};
  const Quaternion start = adapted(Quaternion::Identity(), arc.edge(0));
  const double φ = 0.7;
  const auto a = bishop_frames(arc, start), b = bishop_frames(arc, start * exp(Vec3(0, 0, φ)));
  double length = 0, aside = 0, angle = 0;
  for (int j = 0; j < n; ++j) {
    const Mat3 A = matrix(a[j]), B = matrix(b[j]);
    length = std::max(length, std::abs(a[j].norm() - 1));
    aside = std::max(aside, distance(A.col(2), arc.edge(j).normalized()));
    angle = std::max(angle, std::abs(A.col(0).dot(B.col(0)) - std::cos(φ)));
  }
  CHECK(length < 4e-16);
  CHECK(aside < 1e-15);
  CHECK(angle < 1e-12);  // a million roundings of 1e-16, in random directions: 1e-13
}

TEST_CASE("along a plane curve the director across the plane stays") {
  Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Quaternion q = random.rotation<Spatial>();
    Points r{Vec3::Zero()};
    double φ = 0;
    for (int j = 0; j < 40; ++j) {
      r.push_back(r.back() + rotate(q, Vec3(std::cos(φ), 0, std::sin(φ))));
      φ += random.number(-2, 2);
    }
    const Arc arc{r};
    const Vec3 normal = rotate(q, e2), t = arc.edge(0).normalized();
    Mat3 R;
    R << normal.cross(t), normal, t;
    for (const auto& frame : bishop_frames(arc, Quaternion(R)))
      CHECK(distance(matrix(frame).col(1), normal) < 1e-14);
  }
}

TEST_CASE("transport around an octant turns by its area") {
  // edges along e1, e2, e3, e1: the tangents run around an eighth of the sphere, of area π/2
  const Points r{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {2, 1, 1}};
  const Quaternion start = adapted(Quaternion::Identity(), e1);
  const auto frames = bishop_frames(Arc{r}, start);
  const Quaternion W = start.conjugate() * frames[3];
  CHECK(distance(W, exp(Vec3(0, 0, π / 2))) < 1e-15);
  CHECK(distance(rotate(frames[3], e1), rotate(exp(Vec3(π / 2, 0, 0)), rotate(start, e1))) < 1e-15);
}

TEST_CASE("a skew quadrilateral: the holonomy is the area that its tangents enclose") {
  for (const double height : {0.1, 0.5, 1., -2.}) {
    CAPTURE(height);
    const Points r{{1, 0, 0}, {0, 1, height}, {-1, 0, 0}, {0, -1, height}};
    const auto t = tangents({r, Closure::closed});
    const auto area = [](const Vec3& a, const Vec3& b, const Vec3& c) {
      return 2 * std::atan2(a.dot(b.cross(c)), 1 + a.dot(b) + b.dot(c) + c.dot(a));
    };
    const double enclosed = area(t[0], t[1], t[2]) + area(t[0], t[2], t[3]);
    CHECK(modulo(holonomy_of(r) - enclosed) < 1e-14);
  }
}

TEST_CASE("plane closed arcs have no holonomy; those that wind up have minus their torsion") {
  CHECK(modulo(holonomy_of(regular_polygon(7))) < 1e-14);
  Random random(4);
  for (int i = 0; i < 50; ++i) {
    const Points r = random_points(random, 20);
    const Arc arc{r, Closure::closed};
    const double torsion = dihedral_angles(arc, binormals(arc)).sum();
    CHECK(modulo(holonomy(arc) + torsion) < 2e-14);
    CHECK(std::abs(holonomy(arc)) <= π);
  }
}

TEST_CASE("once around, a frame has turned by 2 pi times the writhe, up to whole turns") {
  Random random(5);
  for (int i = 0; i < 50; ++i) {
    const Points r = random_points(random, 15);
    CHECK(modulo(holonomy_of(r) - 2 * π * writhe_of(r)) < 1e-12);
    CHECK(modulo(holonomy_of(r) + holonomy_of(mirrored(r))) < 1e-13);
  }
  for (const int n : {20, 100}) {
    const Points knot = loop(torus_curve(2, 3, 2), n);
    CHECK(modulo(holonomy_of(knot) - 2 * π * writhe_of(knot)) < 1e-12);
  }
}

TEST_CASE("the holonomy of a smooth knot, with second order") {
  const double exact = 3.0269921851121758;  // of the reference curve G_torus_knot_2_3
  const auto error = [&](int n) { return holonomy_of(loop(torus_curve(2, 3, 2), n)) - exact; };
  CHECK(std::log2(error(400) / error(800)) == doctest::Approx(2).epsilon(0.005));
  CHECK(std::abs(error(800)) < 1e-3);
}

TEST_CASE("the holonomy does not depend on where the arc starts") {
  Random random(6);
  Points r = random_points(random, 20);
  const double once = holonomy_of(r);
  for (int i = 0; i < 20; ++i) {
    std::rotate(r.begin(), r.begin() + 1, r.end());
    CHECK(modulo(holonomy_of(r) - once) < 2e-14);
  }
}
