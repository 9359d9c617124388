// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rotation/frame_along.hpp>
#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/scene/rod_spec.hpp>

#include <doctest/doctest.h>

#include <numbers>

using namespace pyrod;

namespace {

const Section stiff(4, 3, 2), soft(1, 1.5, 0.5);

double total(const Rod<Spatial>& rod) {
  double turn = 0;
  for (int j = 0; j <= rod.edges(); ++j) turn += rod.grid.Δs(j) * rod.K0[std::size_t(j)].y();
  return turn;
}

}  // namespace

TEST_CASE("one section and one curvature are everywhere, on every grid") {
  const auto spec = precurved(2.0, 8, stiff, Vec3(0.1, 0.2, 0.3));
  for (const int parts : {1, 4}) {
    const auto made = on_grid(spec, parts);
    CHECK(made.rod.edges() == 8 * parts);
    CHECK(made.rod.grid.length() == doctest::Approx(2));
    for (const auto& C : made.rod.bending) CHECK(C == Vec3(4, 3, 2));
    for (const auto& K : made.rod.K0) CHECK(K == Vec3(0.1, 0.2, 0.3));
    CHECK(made.rod.jumps.empty());
    CHECK(made.richest == ModelKind::inextensible);
    CHECK(std::isinf(made.rod.stretching[0].z()));
  }
}

TEST_CASE("sections edge by edge jump at their vertices, where compliances add") {
  const auto spec = straight(1.0, 4, std::vector{stiff, stiff, soft, soft});
  for (const int parts : {1, 2, 8}) {
    const auto rod = on_grid(spec, parts).rod;
    REQUIRE(rod.jumps.size() == 1);
    CHECK(rod.jumps[0].vertex == 2 * parts);
    CHECK(rod.jumps[0].bending_before == Vec3(4, 3, 2));
    CHECK(rod.jumps[0].bending_behind == Vec3(1, 1.5, 0.5));
    const Vec3 cell = rod.bending[std::size_t(2 * parts)];
    CHECK((cell.cwiseInverse() -
           (Vec3(4, 3, 2).cwiseInverse() + Vec3(1, 1.5, 0.5).cwiseInverse()) / 2)
              .norm() < 1e-15);
  }
}

TEST_CASE("a function that jumps at a vertex is asked on both sides, if that is told") {
  const auto section = [](double s) { return s < 0.3 ? stiff : soft; };
  const auto bend = [](double s) { return Vec3(0, s < 0.3 ? 1 : 2, 0); };
  const auto spec = with_vertices(precurved(1.0, 4, section, bend), {0.3});
  const auto rod = on_grid(spec, 2).rod;
  CHECK(rod.edges() == 10);
  REQUIRE(rod.jumps.size() == 1);
  const auto& jump = rod.jumps[0];
  CHECK(rod.grid.s(jump.vertex) == doctest::Approx(0.3).epsilon(1e-15));
  CHECK(jump.K0_before.y() == 1);
  CHECK(jump.K0_behind.y() == 2);
  CHECK(jump.bending_before.x() == 4);
  CHECK(jump.bending_behind.x() == 1);
}

TEST_CASE("curvature vertex by vertex is linear between; that of a polygon stays at its corners") {
  std::vector<Vec3> K;
  for (int j = 0; j <= 4; ++j) K.emplace_back(0, j, 0);
  auto spec = precurved(1.0, 4, stiff, K);
  const auto linear = on_grid(spec, 4).rod;
  for (int j = 0; j <= 16; ++j) CHECK(linear.K0[std::size_t(j)].y() == doctest::Approx(j / 4.));
  spec.corners = true;
  const double turn = total(on_grid(spec).rod);
  for (const int parts : {2, 8}) {
    const auto rod = on_grid(spec, parts).rod;
    CHECK(total(rod) == doctest::Approx(turn).epsilon(1e-14));
    for (int j = 0; j <= rod.edges(); ++j)
      CHECK((rod.K0[std::size_t(j)].y() != 0) == (j % parts == 0 && j > 0));
  }
}

TEST_CASE("the solver's own grid turns little from edge to edge, and keeps vertices") {
  CHECK(straight(1.0, automatic, stiff).edges() == 16);
  const auto coil = precurved(1.0, automatic, stiff, Vec3(0, 20 * std::numbers::pi, 0));
  CHECK(20 * std::numbers::pi / coil.edges() <= 0.4);
  const auto held = with_vertices(straight(1.0, automatic, stiff), {0.4234658589667165, 0.7});
  for (const double at : {0.4234658589667165, 0.7}) {
    const Grid grid(held.edge_lengths);
    CHECK((grid.arc_lengths().array() - at).abs().minCoeff() < 1e-15);
  }
  CHECK(with_vertices(held, {0.7 + 1e-12}).edges() == held.edges());
}

TEST_CASE("a rod made from points is these points, placed where they are") {
  std::vector<Vec3> points;
  std::vector<Quaternion> frames;
  for (int j = 0; j <= 12; ++j) points.emplace_back(std::cos(0.4 * j), std::sin(0.4 * j), 0.05 * j);
  for (int j = 0; j < 12; ++j)
    frames.push_back(
        frame_along(points[std::size_t(j) + 1] - points[std::size_t(j)], Vec3(0.1, 0, 1)));
  const auto spec = from_curve(points, frames, stiff);
  for (const int parts : {1, 2, 4}) {
    const auto rod = on_grid(spec, parts).rod;
    const auto shape = rod.at_rest(spec.placement.position, spec.placement.frame);
    for (std::size_t j = 0; j < points.size(); ++j)
      CHECK((shape.positions[j * std::size_t(parts)] - points[j]).norm() < 1e-13);
  }
  frames[3] = frames[3] * exp(Vec3(0.6, 0, 0));
  CHECK_THROWS_WITH_AS(from_curve(points, frames, stiff), doctest::Contains("frames[3]: its a3 is"),
                       InvalidArgument);
}
