// SPDX-License-Identifier: BSD-3-Clause
// Straight stretches have no binormals of their own.
#include <pyrod/curve/frenet.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();

/// From one vertex to the next.
Points walk(const std::vector<Vec3>& steps) {
  Points out{Vec3::Zero()};
  for (const Vec3& step : steps) out.push_back(out.back() + step);
  return out;
}

Vector angles(const Arc& arc, double straight = 0) {
  return dihedral_angles(arc, binormals(arc, straight));
}

}  // namespace

TEST_CASE("in the middle the binormal waits, and turns on the edge into the next bend") {
  const Points r = walk({x, y, y, y, -z});  // turns about z, then about -x
  CHECK(binormals(Arc{r}) == Points{z, z, z, z, -x, -x});
  Vector expected = Vector::Zero(5);
  expected[3] = -π / 2;  // about y, which turns z to x
  CHECK(angles(Arc{r}) == expected);
}

TEST_CASE("at the start the first axis counts, at the end the last") {
  const Points r = walk({2 * x, x, x, y, z, z, 3 * z});  // turns about z, then about x
  CHECK(binormals(Arc{r}) == Points{z, z, z, z, x, x, x, x});
  Vector expected = Vector::Zero(7);
  expected[3] = π / 2;
  CHECK(angles(Arc{r}) == expected);
}

TEST_CASE("a closed arc that starts straight takes the last axis") {
  const Points r = walk({x, y, y, z, z, -x, -x, -z - y, -z - y});  // and x back to the start
  const Arc arc{r, Closure::closed};
  const auto b = binormals(arc);
  const int n = arc.vertices();
  int straight = 0;
  for (int j = 0; j < n; ++j) {
    CHECK(std::abs(b[j].norm() - 1) < 4e-16);
    CHECK(std::abs(b[j].dot(arc.before(j).normalized())) < 4e-16);
    CHECK(std::abs(b[j].dot(arc.behind(j).normalized())) < 4e-16);
    if (arc.turning(j).angle() > 0) {
      CHECK(distance(b[j], arc.turning(j).binormal()) == 0);
    } else {
      CHECK(distance(b[j], b[j == 0 ? n - 1 : j - 1]) < 4e-16);
      ++straight;
    }
  }
  CHECK(straight == 5);
}

TEST_CASE("wherever a closed arc starts, its dihedral angles are the same") {
  const std::vector<Vec3> steps{x, x, y, y, z, z, z, -x, -x, -y, -y, -z, -z, -z};
  for (std::size_t start = 0; start < steps.size(); ++start) {
    CAPTURE(start);
    std::vector<Vec3> from = steps;
    std::rotate(from.begin(), from.begin() + std::ptrdiff_t(start), from.end());
    Points r = walk(from);
    r.pop_back();
    Vector α = angles({r, Closure::closed});
    std::rotate(α.begin(), α.end() - std::ptrdiff_t(start), α.end());
    Vector expected = Vector::Zero(14);
    // into each bend, on the second edge of its stretch (the third of z)
    expected[1] = -π / 2, expected[3] = π / 2, expected[6] = -π / 2;
    expected[8] = π / 2, expected[10] = -π / 2, expected[13] = π / 2;
    CHECK(((α - expected).isZero(1e-15) || (α + expected).isZero(1e-15)));
  }
}

TEST_CASE("a straight arc has one normal everywhere and no torsion") {
  Random random(1);
  for (const Vec3& d : {x, y, z, random.vector<3>(), Vec3(1, 1, 1)}) {
    const Points r = walk({d, 2 * d, d, 5 * d});
    const auto b = binormals(Arc{r});
    for (const Vec3& v : b) {
      CHECK(std::abs(v.norm() - 1) < 4e-16);
      CHECK(std::abs(v.dot(d.normalized())) < 4e-16);
      CHECK(distance(v, b[0]) < 4e-16);
    }
    CHECK(angles(Arc{r}).isZero(1e-15));
  }
}

TEST_CASE("straight up to rounding, far from the origin: no torsion out of noise") {
  Random random(2);
  for (double far = 1; far < 1e10; far *= 10)
    for (int i = 0; i < 20; ++i) {
      CAPTURE(far);
      const Vec3 start = random.turn<Spatial>(far), d = random.turn<Spatial>(1);
      Points line;
      for (int j = 0; j < 50; ++j) line.push_back(start + j * d);
      const double noise = 4e-16 * (far + 50);  // of the edges; torsion sees its square
      CHECK(angles(Arc{line}).cwiseAbs().maxCoeff() < 1e-15 + noise * noise);
      const Vec3 aside = detail::any_normal(d);  // one bend, and its axis is that of all
      for (int j = 25; j < 50; ++j) line[j] += (j - 24) * aside;
      for (const Vec3& b : binormals(Arc{line})) CHECK(distance(b, d.cross(aside)) < 3 * noise);
    }
}

TEST_CASE("bends of no more than `straight` count as none") {
  const double small = 1e-3;
  const Points r = walk({x, x + small * y, x + small * y + small * z, y, z});
  const auto b = binormals(Arc{r});
  CHECK(distance(b[1], z) < 1e-15);
  CHECK(distance(b[2], Vec3(0, -1, 0)) < 2e-3);
  // with these bends left out, the first axis is that of the turn towards y, carried back to x
  const auto waited = binormals(Arc{r}, 2 * small);
  CHECK(distance(waited[3], Arc{r}.turning(3).binormal()) == 0);
  for (int j = 0; j < 3; ++j) {
    CHECK(distance(waited[j], z) < 2e-3);
    CHECK(std::abs(waited[j].dot(Arc{r}.edge(j).normalized())) < 4e-16);
  }
  // transport across these bends shows in their square
  CHECK(angles(Arc{r}, 2 * small).head(2).cwiseAbs().maxCoeff() < small * small);
  CHECK(std::abs(angles(Arc{r})[1]) > 1.5);
}

TEST_CASE("every vertex may have its own `straight`") {
  const double small = 1e-3;
  const Points r = walk({x, x + small * y, x + small * y + small * z, y, z});
  Vector straight = Vector::Zero(Eigen::Index(r.size()));
  straight[2] = 2 * small;
  const auto b = binormals(Arc{r}, straight);
  CHECK(distance(b[1], z) < 1e-15);      // bent
  CHECK(distance(b[2], z) < 2 * small);  // carried there, not its own
  CHECK_THROWS_AS(binormals(Arc{r}, Vector::Zero(2)), InvalidArgument);
}
