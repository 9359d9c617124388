// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/statics/solution/extremes.hpp>

#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A rod of four edges whose vertices say these moments; curvatures are the same, forces zero.
Largest of_moments(const std::vector<double>& m, const std::vector<Before<Spatial>>& before) {
  const auto rod = Rod<Spatial>::uniform(Grid::uniform(4, 4), Vec3::Ones(), Vec3::Constant(1e3));
  RodSolution<Spatial> s;
  Extremes<Spatial> extremes(rod);
  for (const double value : m) {
    const Vec3 M(0, value, 0);
    s.vertex_frames.push_back(Quaternion::Identity());
    s.vertex_force.push_back(Vec3::Zero());
    s.moment.push_back(M);
    s.strains.K.push_back(M);
    extremes.add_cell(M, M);
    extremes.set_force(int(s.moment.size()) - 1, Vec3::Zero());
  }
  s.before = before;
  return extremes.largest(s, 1);
}

}  // namespace

TEST_CASE("seen from the middle of a cell, to the fourth power of its turn") {
  Random random(3);
  const Vec3 direction = random.vector<3>(), M = random.vector<3>();
  double before = 0;
  for (const double size : {0.4, 0.2}) {
    const Vec3 u = size * direction;
    // stiffness and curvature at rest so that the moment of the cell is M
    const Vec3 spatial = transmitted_moment<Spatial>(u, Vec3::Ones(), u - M, 1);
    const Vec3 exact = unrotate(exp(Vec3(u / 2)), spatial), told = M - u.cross(u.cross(M)) / 24;
    const double error = distance(exact, told);
    if (before > 0) CHECK(error < before / 14);
    before = error;
  }
}

TEST_CASE("no polynomial reaches across a jump, and both sides count") {
  const Before<Spatial> jump{2, Vec3::Zero(), Vec3(0, 3, 0), Vec3(0, 3, 0), false};
  const auto found = of_moments({1, 2, -1.5, -1, -1}, {jump});
  CHECK(found.moment == 3);
  CHECK(found.K == 3);
  CHECK(found.force == 0);
  CHECK(of_moments({1, 2, -1.5, -1, -1}, {}).moment > 2);  // without it the top of a curve
}
