// SPDX-License-Identifier: BSD-3-Clause
// Closed curves, and turns that a measure loses.
#include <pyrod/curve/cosserat.hpp>

#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {
constexpr double π = std::numbers::pi;
}

TEST_CASE("a closed ring: one curvature all around, whatever the sign of the last frame") {
  const int n = 8;
  const double edge = 2 * std::sin(π / n);
  const Grid grid(Vector::Constant(n, edge), Closure::closed);
  std::vector<Vec3> r;
  std::vector<Quaternion> q;
  for (int j = 0; j < n; ++j) {  // in the plane of e3 and e1, turning about e2
    const double φ = 2 * π * j / n;
    r.push_back({-std::cos(φ), 0, std::sin(φ)});
    q.push_back(exp(Vec3(0, φ + π / n, 0)));
  }
  for (const double sign : {1., -1.}) {
    q.back().coeffs() *= sign;
    const auto ring = closed(r, q);
    CHECK(ring.edges() == n);
    CHECK(distance(ring.start_frame, ring.end_frame) == 0);
    CHECK(ring.start_frame.dot(ring.frames[0]) > 0);
    const auto found = strains(grid, ring);
    REQUIRE(found.K.size() == n);
    CHECK(distance(found.Γ, std::vector<Vec3>(n, Vec3::UnitZ())) < 1e-14);
    for (int j = 0; j < n - 1; ++j)
      CHECK(distance(found.K[j], Vec3(0, 2 * π / n / edge, 0)) < 1e-14);
    // with the other sign the last frame is the long way from its neighbour
    CHECK(found.K[n - 1].norm() * edge ==
          doctest::Approx(sign > 0 ? 2 * π / n : 2 * π - 2 * π / n).epsilon(1e-14));
  }
}

TEST_CASE("frames at the vertices of a closed curve, also at the first, by the lengths of edges") {
  const Grid grid(Vec<4>(1, 2, 3, 4), Closure::closed);
  std::vector<Quaternion> q;
  for (const double centre : {0.5, 2., 4.5, 8.}) q.push_back(exp(Vec3(0, 0, 0.1 * centre)));
  const auto curve = closed(std::vector<Vec3>(4, Vec3::Zero()), q);
  const auto frames = vertex_frames(grid, curve);
  REQUIRE(frames.size() == 4);
  for (int j = 1; j < 4; ++j) CHECK(distance(frames[j], exp(Vec3(0, 0, 0.1 * grid.s(j)))) < 1e-15);
  // from 0.8 at the last centre to 0.05 at the first, 2 of 2.5 on the way
  CHECK(distance(frames[0], exp(Vec3(0, 0, 0.8 - 0.75 * 2 / 2.5))) < 1e-15);
}

TEST_CASE("a turn that its measure loses is refused, with the place and the remedy") {
  const auto refused = [](double θ, Measure measure) {
    return refusal([&] { check_turn(exp(Vec3(0, θ, 0)), 7, measure); });
  };
  for (const double θ : {0., π, 4., 2 * π - 2e-6, 2 * π + 2e-6})
    CHECK(refused(θ, Measure::log) == "(not refused)");
  for (const double θ : {2 * π, 2 * π - 0.5e-6})
    CHECK(refused(θ, Measure::log) ==
          "frames[7]: turned by 2 pi from its neighbour, so that the axis of the turn is lost; use "
          "the other sign of the quaternion, or more edges");
  for (const Measure measure : {Measure::chord, Measure::cayley}) {
    for (const double θ : {0., 3., π - 2e-9}) CHECK(refused(θ, measure) == "(not refused)");
    for (const double θ : {π - 0.5e-9, π, 4., 2 * π})
      CHECK(refused(θ, measure) ==
            "frames[7]: turned by pi or more from its neighbour, which the " +
                std::string(name(measure)) +
                " measure cannot tell; use measure log, the other sign of the quaternion, or more "
                "edges");
  }
}
