// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/frenet.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
constexpr Measure all[] = {Measure::log, Measure::chord, Measure::cayley};

/// The numbers and frames of an arc, computed one from the other.
struct Frenet {
  explicit Frenet(const Arc& a, double straight = 0)
      : arc(a),
        grid(arc_length(arc)),
        θ(turning_angles(arc)),
        b(binormals(arc, straight)),
        α(dihedral_angles(arc, b)) {}

  Arc arc;
  Grid grid;
  Vector θ;
  std::vector<Vec3> b;
  Vector α;
};

double farthest(const Vector& values, double from) {
  return (values.array() - from).abs().maxCoeff();
}

}  // namespace

TEST_CASE("regular polygons have one curvature and no torsion, at any n and in any measure") {
  for (const int n : {3, 4, 5, 17, 1000}) {
    CAPTURE(n);
    const Points r = regular_polygon(n, 2);
    const Frenet f({r, Closure::closed});
    const double edge = 4 * std::sin(π / n), angle = 2 * π / n;
    const double rounding = 2e-15 + 1e-16 * n;  // of positions, seen from a neighbour
    CHECK(farthest(f.θ, angle) < rounding);
    for (const Measure measure : all) {
      const double κ = measured(angle, measure) / edge;
      CHECK(farthest(curvature(f.grid, f.θ, measure), κ) < rounding / edge);
    }
    CHECK(farthest(curvature(f.grid, f.θ, Measure::chord), 0.5) < rounding / edge);  // 1/R
    CHECK(f.α.isZero(0));
    CHECK(distance(f.b, std::vector<Vec3>(n, Vec3::UnitZ())) == 0);
  }
}

TEST_CASE("part of a circle held by its tangents: the half cells have the same curvature") {
  const int n = 6;
  const Points r = points([](double t) { return Vec3(std::cos(t), std::sin(t), 0); }, 4, n);
  const Frenet f({r, Closure::open, Vec3(0, 1, 0), Vec3(-std::sin(4), std::cos(4), 0)});
  const double φ = 4. / n, κ = φ / (2 * std::sin(φ / 2));
  CHECK(farthest(curvature(f.grid, f.θ), κ) < 1e-14);
  const Frenet free(Arc{r});  // nothing turns its ends
  CHECK(free.θ[0] == 0);
  CHECK(free.θ[n] == 0);
  CHECK(farthest(curvature(free.grid, free.θ).segment(1, n - 1), κ) < 1e-14);
}

TEST_CASE("discrete helices have one curvature and one torsion, however coarse") {
  for (const double φ : {0.01, 0.5, 1.5, 2.5, 3.}) {  // from vertex to vertex about the axis
    for (const double rise : {0.3, -0.8}) {
      CAPTURE(φ);
      CAPTURE(rise);
      const int n = 40;
      const Points r =
          points([&](double t) { return Vec3(std::cos(t), std::sin(t), rise * t); }, n * φ, n);
      const Frenet f(Arc{r});
      const double chord = 2 * std::sin(φ / 2), length = std::hypot(chord, rise * φ);
      const double slope = chord / length;  // sine of the angle between edges and axis
      const double θ = 2 * std::asin(slope * std::sin(φ / 2));
      const double bz = slope * slope * std::sin(φ) / std::sin(θ);
      const double α = std::copysign(2 * std::asin(std::sqrt(1 - bz * bz) * std::sin(φ / 2)), rise);
      const double rounding = 1e-14 + 1e-15 / φ;  // positions reach to n φ, edges to φ
      CHECK(farthest(f.θ.segment(1, n - 1), θ) < rounding);
      CHECK(farthest(f.α.segment(1, n - 2), α) < rounding / θ);
      CHECK(farthest(torsion(f.grid, f.α).segment(1, n - 2), α / length) < rounding / θ / length);
      CHECK(std::abs(f.α[0]) < 1e-15);  // free ends have the binormals of their neighbours
      CHECK(std::abs(f.α[n - 1]) < 1e-15);
    }
  }
}

TEST_CASE("curvature and torsion of a smooth curve are of second order, in every measure") {
  // (t, t²/2, t³/3): κ and τ from the derivatives (1, t, t²), (0, 1, 2t), (0, 0, 2)
  const auto exact = [](double t) {
    const Vec3 v(1, t, t * t), w = v.cross(Vec3(0, 1, 2 * t));
    return std::pair(w.norm() / std::pow(v.norm(), 3), 2 * w.z() / w.squaredNorm());
  };
  for (const Measure measure : all) {
    CAPTURE(name(measure));
    double κ_error[2], τ_error[2];
    for (int level = 0; level < 2; ++level) {
      const int n = 200 << level;
      const Points r = points([](double t) { return Vec3(t, t * t / 2, t * t * t / 3); }, 1.5, n);
      const Frenet f(Arc{r});
      const Vector κ = curvature(f.grid, f.θ, measure), τ = torsion(f.grid, f.α, measure);
      κ_error[level] = τ_error[level] = 0;
      for (int j = 1; j < n; ++j)
        κ_error[level] = std::max(κ_error[level], std::abs(κ[j] - exact(1.5 * j / n).first));
      for (int j = 1; j < n - 1; ++j)
        τ_error[level] =
            std::max(τ_error[level], std::abs(τ[j] - exact(1.5 * (j + 0.5) / n).second));
    }
    CHECK(std::log2(κ_error[0] / κ_error[1]) == doctest::Approx(2).epsilon(0.01));
    CHECK(std::log2(τ_error[0] / τ_error[1]) == doctest::Approx(2).epsilon(0.01));
    CHECK(κ_error[1] < 1e-4);
    CHECK(τ_error[1] < 1e-4);
  }
}

TEST_CASE("where a plane arc bends the other way its binormal turns by pi exactly") {
  Random random(1);
  const Points zigzag{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {4, 2, 0}};
  for (int i = 0; i < 200; ++i) {
    const Quaternion q = i == 0 ? Quaternion::Identity() : random.rotation<Spatial>();
    const Points r = mapped(zigzag, [&](const Vec3& x) { return rotate(q, x); });
    const Frenet f(Arc{r});
    CHECK(f.α.segment(1, 3) == Vec3(π, π, π));
    CHECK(std::abs(f.α[0]) + std::abs(f.α[4]) < 1e-15);
    for (int j = 1; j < 5; ++j)
      CHECK(distance(f.b[j], rotate(q, (j % 2 ? 1 : -1) * Vec3::UnitZ())) < 2e-15);
    CHECK(torsion(f.grid, f.α)[1] == doctest::Approx(π).epsilon(1e-15));
    for (const auto& frame : edge_frenet_frames(f.arc, f.b, f.α)) CHECK(frame.coeffs().allFinite());
  }
}

TEST_CASE("Sauer's torsion is the sine of the dihedral angle, read off the binormals") {
  Random random(2);
  const Points r = random_points(random, 30);
  const Frenet f({r, Closure::closed});
  const Vector τ = sauer_torsion(f.grid, f.α);
  for (int j = 0; j < 30; ++j) {
    const Vec3 t = f.arc.edge(j).normalized();
    CHECK(τ[j] * f.grid.h(j) ==
          doctest::Approx(t.dot(f.b[j].cross(f.b[f.arc.next(j)]))).epsilon(1e-14));
  }
}

TEST_CASE("the difference of binormals about their mean is twice the tangent of half the angle") {
  Random random(3);  // Linn A.4.2, with the mean binormal scaled as in 4.2
  const Points r = random_points(random, 200);
  const Frenet f({r, Closure::closed});
  for (int j = 0; j < 200; ++j) {
    const Vec3 t = f.arc.edge(j).normalized(), &b = f.b[j], &next = f.b[f.arc.next(j)];
    const Vec3 mean = (b + next) / (1 + b.dot(next));
    const double tangent = measured(f.α[j], Measure::cayley);
    CHECK(std::abs(mean.dot(b) - 1) < 1e-13 * (1 + tangent * tangent));
    CHECK(std::abs(t.dot(mean.cross(next - b)) - tangent) <
          1e-14 * (1 + std::pow(std::abs(tangent), 3)));
  }
}

TEST_CASE("frames of the edges: orthonormal, half-way between the binormals, signs continued") {
  Random random(4);
  const Points r = random_points(random, 60);
  for (const Closure closure : {Closure::open, Closure::closed}) {
    const Frenet f({r, closure});
    const auto frames = edge_frenet_frames(f.arc, f.b, f.α);
    REQUIRE(int(frames.size()) == f.arc.edges());
    for (int j = 0; j < f.arc.edges(); ++j) {
      const Mat3 R = matrix(frames[j]);
      const Vec3 t = f.arc.edge(j).normalized();
      CHECK(std::abs(frames[j].norm() - 1) < 4e-16);
      CHECK(distance(R.col(2), t) < 2e-15);
      const auto from_mean = [&](const Vec3& b) {
        return std::atan2(t.dot(R.col(1).cross(b)), R.col(1).dot(b));
      };
      CHECK(std::abs(from_mean(f.b[j]) + f.α[j] / 2) < 3e-15);
      CHECK(std::abs(from_mean(f.b[f.arc.next(j)]) - f.α[j] / 2) < 3e-15);
      if (j > 0) CHECK(frames[j].dot(frames[j - 1]) >= 0);
    }
  }
}

TEST_CASE("frames of the vertices: the tangent halves the turn") {
  Random random(5);
  const Points r = random_points(random, 60);
  const Frenet f({r, Closure::open, random.vector<3>(), random.vector<3>()});
  const auto frames = vertex_frenet_frames(f.arc, f.b);
  REQUIRE(frames.size() == 60);
  for (int j = 0; j < 60; ++j) {
    const Mat3 R = matrix(frames[j]);
    CHECK(distance(R.col(1), f.b[j]) < 2e-15);
    const auto half = exp(Vec3(0, f.θ[j] / 2, 0));  // about b, in the components of the frame
    CHECK(distance(rotate(frames[j] * half, Vec3::UnitZ()), f.arc.behind(j).normalized()) < 4e-15);
    CHECK(distance(rotate(frames[j] * half.conjugate(), Vec3::UnitZ()),
                   f.arc.before(j).normalized()) < 4e-15);
    if (j > 0) CHECK(frames[j].dot(frames[j - 1]) >= 0);
  }
}
