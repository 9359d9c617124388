// SPDX-License-Identifier: BSD-3-Clause
// Frenet's numbers, Bishop's numbers and the curve: each gives the other two back.
#include <pyrod/curve/conversion.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
constexpr Measure all[] = {Measure::log, Measure::chord, Measure::cayley};

/// Turns θ at the vertices, α on the edges, both in radians.
struct Turns {
  Grid grid;
  Vector θ, α;

  Vector κ(Measure measure) const { return curvature(grid, θ, measure); }
  Vector τ(Measure measure) const { return torsion(grid, α, measure); }
};

Turns random_turns(Random& random, int n) {
  Turns out{random.grid(n, n), Vector(n + 1), Vector(n)};
  for (double& θ : out.θ) θ = random.number(0.3, 2.2);
  for (double& α : out.α) α = random.number(-3, 3);
  return out;
}

/// The arc of a curve that is held at both ends.
Arc arc_of(const CosseratCurve<Spatial>& c) {
  return {c.positions, Closure::open, rotate(c.start_frame, Vec3::UnitZ()),
          rotate(c.end_frame, Vec3::UnitZ())};
}

double largest(const Vector& v) { return v.cwiseAbs().maxCoeff(); }

}  // namespace

TEST_CASE("the reconstructed curve has the curvatures and torsions that it was made of") {
  Random random(1);
  for (const Measure measure : all)
    for (const int n : {1, 2, 30}) {
      CAPTURE(name(measure));
      CAPTURE(n);
      const Turns given = random_turns(random, n);
      const auto curve =
          reconstruct_frenet(given.grid, given.κ(measure), given.τ(measure), random.vector<3>(),
                             random.rotation<Spatial>(), measure);
      const Arc arc = arc_of(curve);
      const auto b = binormals(arc);
      const Grid ς = arc_length(arc);
      const Vector θ = turning_angles(arc), α = dihedral_angles(arc, b);
      CHECK(largest(ς.edge_lengths() - given.grid.edge_lengths()) < 1e-13);
      CHECK(largest(θ - given.θ) < 1e-13);
      CHECK(largest(α - given.α) < 1e-13);
      CHECK(distance(b[0], matrix(curve.start_frame).col(1)) < 1e-14);
      const Vector κ = curvature(ς, θ, measure), τ = torsion(ς, α, measure);
      CHECK(largest((κ - given.κ(measure)).cwiseQuotient(κ)) < 2e-13);
      // in the Cayley measure an error of α grows by 1 + tan²(α/2) < 200
      CHECK(largest((τ - given.τ(measure)).cwiseProduct(ς.edge_lengths())) <
            (measure == Measure::cayley ? 2e-11 : 1e-13));
    }
}

TEST_CASE("any arc is reconstructed from its curvatures and torsions, with its Bishop frames") {
  Random random(2);
  for (const Measure measure : all) {
    CAPTURE(name(measure));
    Points r = random_points(random, 30);
    Arc arc{r};  // the axes at its ends are those of its neighbours, its half cells do not turn
    const auto b = binormals(arc);
    const Grid grid = arc_length(arc);
    const Vector κ = curvature(grid, turning_angles(arc), measure);
    const Vector τ = torsion(grid, dihedral_angles(arc, b), measure);
    const Quaternion start = frenet_frame(arc.edge(0).normalized(), b[0], Quaternion::Identity());
    const auto curve = reconstruct_frenet(grid, κ, τ, r[0], start, measure);
    CHECK(distance(curve.positions, r) < 1e-12);
    CHECK(distance(curve.frames, bishop_frames(arc, start)) < 1e-12);
  }
}

TEST_CASE("strains in Bishop frames are the curvatures about the binormals") {
  Random random(3);
  for (const Measure measure : all) {
    CAPTURE(name(measure));
    const Turns given = random_turns(random, 20);
    const auto curve = reconstruct_frenet(given.grid, given.κ(measure), given.τ(measure),
                                          Vec3::Zero(), random.rotation<Spatial>(), measure);
    const auto found = strains(given.grid, curve, measure);
    const auto K = bishop_curvature(given.κ(measure), given.α);
    for (int j = 0; j <= 20; ++j) CHECK(given.grid.Δs(j) * distance(found.K[j], K[j]) < 1e-13);
    CHECK(distance(found.Γ, std::vector<Vec3>(20, Vec3::UnitZ())) < 1e-13);
    CHECK(twist_angles(given.grid, curve).isZero(1e-13));
  }
}

TEST_CASE("Bishop's numbers of given ones") {
  const auto K = bishop_curvature(Vec<4>(1, 2, 3, 4), Vec3(π / 2, π / 2, -π));
  CHECK(distance(K[0], Vec3(0, 1, 0)) == 0);
  CHECK(distance(K[1], Vec3(-2, 0, 0)) < 1e-15);
  CHECK(distance(K[2], Vec3(0, -3, 0)) < 1e-15);
  CHECK(distance(K[3], Vec3(0, 4, 0)) < 1e-15);
  CHECK(bishop_curvature(Vec3(1, 2, 3), Vec3(1, 1, 1)).size() == 3);  // closed: one α too many
}

TEST_CASE("Frenet's numbers and Bishop's: there and back") {
  Random random(4);
  const Vector κ = random.vector(40).array() + 1.5, α = π * random.vector(39);
  const FrenetNumbers back = frenet_numbers(bishop_curvature(κ, α));
  CHECK(largest(back.κ - κ) < 1e-15);
  CHECK(largest(back.α - α) < 4e-14);

  std::vector<Vec3> K{Vec3(0, 2, 0)};
  while (K.size() < 40) K.push_back({random.number(), random.number(), 0});
  K[5] = K[6] = K[20] = K[39] = Vec3::Zero();
  const FrenetNumbers found = frenet_numbers(K);
  CHECK(distance(bishop_curvature(found.κ, found.α), K) < 1e-13);
}

TEST_CASE("where the curvature vanishes the angle waits for the next bend") {
  const std::vector<Vec3> K{{0, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 0, 0}, {-2, 0, 0}, {0, 0, 0}};
  const FrenetNumbers found = frenet_numbers(K);
  CHECK(found.κ == Vec<6>(0, 1, 0, 0, 2, 0));
  CHECK(found.α == Vec<5>(0, 0, 0, π / 2, 0));
  const FrenetNumbers straight = frenet_numbers(std::vector<Vec3>(3, Vec3::Zero()));
  CHECK(straight.κ == Vec3::Zero());
  CHECK(straight.α == Vec<2>::Zero());
}

TEST_CASE("the angle before the first bend is that of the bend: nothing turns on the way to it") {
  const FrenetNumbers found = frenet_numbers({{0, 0, 0}, {-1, 0, 0}, {-1, 0, 0}});
  CHECK(found.α == Vec<2>::Zero());
}

TEST_CASE("an inflection is half a turn, and comes back through every measure") {
  const FrenetNumbers found = frenet_numbers({{0, 1, 0}, {0, -1, 0}, {0, 1, 0}});
  CHECK(found.α == Vec<2>(π, π));
  const Grid grid(Vec<4>(1, 1, 2, 1));
  const Vec<5> θ(0, 0.5, 0.7, 0.4, 0);
  const Vec<4> α(0, π, π, 0);
  for (const Measure measure : all) {
    const auto curve =
        reconstruct_frenet(grid, curvature(grid, θ, measure), torsion(grid, α, measure),
                           Vec3::Zero(), Quaternion::Identity(), measure);
    CHECK(std::abs(curve.positions[4].y()) < 1e-15);  // b is e2: in the plane of e3 and e1
    const double φ[] = {0, 0.5, -0.2, 0.2};           // bends to and fro
    Vec3 end = Vec3::Zero();
    for (int j = 0; j < 4; ++j) end += grid.h(j) * Vec3(std::sin(φ[j]), 0, std::cos(φ[j]));
    CHECK(distance(curve.positions[4], end) < 1e-14);
    const Arc arc{curve.positions};
    CHECK(dihedral_angles(arc, binormals(arc)).segment(1, 2) == Vec<2>(π, π));
  }
}

TEST_CASE("the chord of a curvature is exact on circles: 1/R in, the regular polygon out") {
  const int n = 12;
  const double R = 3, edge = 2 * R * std::sin(π / n);
  const Grid grid(Vector::Constant(n, edge));
  const auto curve = reconstruct_frenet(grid, Vector::Constant(n + 1, 1 / R), Vector::Zero(n),
                                        Vec3::Zero(), Quaternion::Identity(), Measure::chord);
  for (int j = 1; j < n; ++j)
    CHECK(std::abs(Arc{curve.positions}.turning(j).angle() - 2 * π / n) < 1e-14);
  // half a chord at the start is not half an angle: the polygon is turned, not bent
  CHECK(distance(curve.positions[n], curve.positions[0]) < 1e-13);
}

TEST_CASE("a fold by a chord of 2 is no NaN for rounding") {
  const Grid grid(Vec<2>(1, 1));
  for (double α = -3; α < 3; α += 0.01) {
    const auto folded =
        reconstruct_frenet(grid, Vec3(1, 2, 0), torsion(grid, Vec<2>(α, 0), Measure::chord),
                           Vec3::Zero(), Quaternion::Identity(), Measure::chord);
    CHECK(folded.frames[1].coeffs().allFinite());
  }
}
