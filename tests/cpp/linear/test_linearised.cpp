// SPDX-License-Identifier: BSD-3-Clause
// What eigenvalue solvers multiply by: moments as loads, and the inverse in the rows of unknowns.
#include <pyrod/linear/linearised.hpp>
#include <pyrod/scene.hpp>

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

using namespace pyrod;

namespace {

Scene bent(Dimension space) {
  const bool flat = space == Dimension::planar;
  const Vec3 force(1.5, flat ? 0 : 1, -0.5);
  return Scene(precurved(1.0, 12, Section(1, 1.4, 0.8), Vec3(0, 1.2, flat ? 0 : 0.4)), {Clamp{}},
               {Force{force}}, space);
}

/// By power iteration on W^½ K⁻¹ W^½.
double lowest(const Linearised& linear) {
  const Vector root = linear.weights().cwiseSqrt();
  Vector v = Vector::Ones(root.size());
  double μ = 0;
  for (int i = 0; i < 200; ++i) {
    v = root.cwiseProduct(linear.solved(root.cwiseProduct(v)));
    μ = v.norm();
    v /= μ;
  }
  return 1 / μ;
}

}  // namespace

TEST_CASE("a moment on a vertex is that of the compliance, and one on an edge works on its frame") {
  for (const auto space : {Dimension::planar, Dimension::spatial}) {
    const Solver solver(bent(space));
    const Linearised linear(solver, solver.solve());
    const Vec3 M(space == Dimension::planar ? 0 : 0.3, 1, 0);
    const Mat<6> C = linear.compliance(0, 7);
    const auto told = linear.push(linear.of_moment(0, 7, M)).rods[0];
    const Vec3 expected = C.topRightCorner<3, 3>().col(1) + M[0] * C.topRightCorner<3, 3>().col(0);
    if (space == Dimension::planar)
      CHECK((told.positions[7] - C.topRightCorner<3, 3>().col(1)).norm() < 1e-13);
    else
      CHECK((told.positions[7] - expected).norm() < 1e-13);

    std::vector<std::vector<Vec3>> on(1, std::vector<Vec3>(12, Vec3::Zero())), other = on;
    on[0][4] = other[0][9] = Vec3::UnitY();
    const double there = linear.push(linear.of_moments(on)).rods[0].frames[9].y();
    const double back = linear.push(linear.of_moments(other)).rods[0].frames[4].y();
    CHECK(std::abs(there) > 1e-3);
    CHECK(std::abs(there - back) < 1e-13);
  }
}

TEST_CASE("the inverse tells the lowest eigenvalue, and its vector the shape") {
  for (const auto space : {Dimension::planar, Dimension::spatial}) {
    const Solver solver(bent(space));
    const auto found = solver.solve({.eigenvalue = true});
    const Linearised linear(solver, found);
    CHECK(lowest(linear) == doctest::Approx(found.course.lowest_eigenvalue).epsilon(1e-6));

    const Vector rows = Vector::Ones(linear.weights().size());
    const auto told = linear.follow(rows).rods[0];
    double off = (told.frames[3] - told.frames[8]).norm();  // all frames turn by ones
    CHECK(off < 1e-14);
    CHECK(told.frames[3].y() == doctest::Approx(1));
    CHECK(told.positions[0].norm() < 1e-14);
    CHECK(told.positions[12].norm() > 0.1);
  }
}
