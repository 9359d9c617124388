// SPDX-License-Identifier: BSD-3-Clause
// Paths of families whose equilibria are known in closed form.
#include "support/flat_family.hpp"
#include "support/near.hpp"

#include <pyrod/solve/path.hpp>

#include <string>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// P = y³/3 − y + λ y: two folds, at y = ±1, λ = ±2/3 … in the form λ = y − y³/3.
OneCoordinate cubic() {
  return {[](double y, double λ) { return λ - (y - y * y * y / 3); },
          [](double y, double) { return y * y - 1; }, [](double, double) { return 1.; }};
}
/// sign y⁴/4 − (λ − 1) y²/2 + ε y.
OneCoordinate pitchfork(double sign, double ε = 0) {
  return {[=](double y, double λ) { return sign * y * y * y - (λ - 1) * y + ε; },
          [=](double y, double λ) { return 3 * sign * y * y - (λ - 1); },
          [](double y, double) { return -y; }};
}
/// y³/3 − (λ − 1) y²/2.
OneCoordinate transcritical() {
  return {[](double y, double λ) { return y * y - (λ - 1) * y; },
          [](double y, double λ) { return 2 * y - (λ - 1); }, [](double y, double) { return -y; }};
}

using Flat = FoundPath<Vector>;

Flat path(FlatFamily& family, const Vector& x, double start, double stop, int most = 500) {
  PathFollower<FlatFamily> follower(family, {start, stop, most});
  return follower.follow(x);
}

std::string kinds(const Flat& path) {
  std::string out;
  for (const auto& one : path.special) out += std::string(name(one.kind)) + "; ";
  return out;
}

/// Every point is an equilibrium, and so is no other branch in between: neighbours are near.
void check_points(const FlatFamily& family, const Flat& path) {
  auto at = family.linearisation();
  FamilyTangent<FlatFamily>* none = nullptr;
  CHECK(none == nullptr);
  FlatFamily copy = family;
  for (std::size_t i = 0; i < path.points.size(); ++i) {
    copy.set(path.points[i].λ);
    copy.linearise(path.points[i].x, Hessian::exact, at);
    CHECK(at.gradient.norm() < 1e-12);
    if (i > 0) CHECK((path.points[i].x - path.points[i - 1].x).lpNorm<Eigen::Infinity>() < 0.7);
  }
}

}  // namespace

TEST_CASE("a path goes through both of its folds, which are found to rounding") {
  for (const int size : {1, 2, 7}) {
    FlatFamily family(cubic(), size);
    const auto found = path(family, family.at(-2.5), -2.5 + 2.5 * 2.5 * 2.5 / 3, -5);
    INFO(kinds(found) << found.points.size());
    REQUIRE(found.special.size() == 2);
    CHECK(found.ended == PathEnd::reached);
    CHECK(found.points.back().λ == -5);
    check_points(family, found);
    for (int k = 0; k < 2; ++k) {
      const auto& fold = found.special[k];
      const double y = k ? 1 : -1;
      CHECK(fold.kind == Singularity::fold);
      CHECK(std::abs(fold.λ - y * 2 / 3) < 2e-14);
      CHECK(std::abs(fold.λ - y * 2 / 3) <= fold.error);
      CHECK(fold.error < 1e-12);
      CHECK(distance(fold.x, family.at(y)) < 1e-6);
      CHECK(fold.index_before == k);
      CHECK(fold.index_behind == 1 - k);
      // the null vector: y₀ and what follows it
      Vector mode = family.at(y + 1e-6) - family.at(y - 1e-6);
      CHECK(std::abs(std::abs(mode.normalized().dot(fold.mode.normalized())) - 1) < 1e-9);
    }
  }
}

TEST_CASE("a path without a potential: folds by λ alone") {
  FlatFamily family(cubic(), 4);
  Random random(3);
  family.Z = 0.02 * random_skew(random, 4);
  const auto found = path(family, family.at(-2.5), -2.5 + 2.5 * 2.5 * 2.5 / 3, -5);
  CHECK(found.ended == PathEnd::reached);
  CHECK(kinds(found) == "fold; fold; ");
  // there the tangent is singular
  for (const auto& fold : found.special) {
    auto at = family.linearisation();
    family.set(fold.λ);
    family.linearise(fold.x, Hessian::exact, at);
    Dense K(4, 4);
    for (int k = 0; k < 4; ++k) {
      Vector column;
      at.hessian.multiply(Vector::Unit(4, k), column);
      K.col(k) = column + family.Z.col(k);
    }
    CHECK(std::abs(K.determinant()) < 1e-7);  // λ is right to the square of that
    CHECK(at.gradient.norm() < 1e-12);
  }
}

TEST_CASE("pitchforks and transcritical points are found to rounding and told apart") {
  const auto check = [](OneCoordinate one, Singularity kind) {
    for (const int size : {1, 5}) {
      FlatFamily family(one, size);
      const auto found = path(family, family.at(0), 0, 3);
      INFO(kinds(found));
      REQUIRE(found.special.size() == 1);
      const auto& point = found.special[0];
      CHECK(point.kind == kind);
      CHECK(std::abs(point.λ - 1) < 1e-12);
      CHECK(std::abs(point.λ - 1) <= point.error);
      CHECK(distance(point.x, family.at(0)) < 1e-11);
      CHECK(point.index_before == 0);
      CHECK(point.index_behind == 1);
      CHECK(point.branches());
      check_points(family, found);
    }
  };
  check(pitchfork(1), Singularity::supercritical);
  check(pitchfork(-1), Singularity::subcritical);
  check(transcritical(), Singularity::transcritical);
}

TEST_CASE("branches that cross are followed to both sides") {
  for (const double sign : {1., -1.}) {
    FlatFamily family(pitchfork(sign), 3);
    PathFollower<FlatFamily> follower(family, {0, 3, 500});
    const auto found = follower.follow(family.at(0));
    REQUIRE(found.special.size() == 1);
    for (const double side : {1., -1.}) {
      const auto branch = follower.follow(found.special[0], side);
      CHECK(branch.ended == (sign > 0 ? PathEnd::reached : PathEnd::turned_back));
      CHECK(branch.special.empty());
      check_points(family, branch);
      for (const auto& point : branch.points) {
        const double y = family.first(point.x);
        CHECK(std::abs(sign * y * y - (point.λ - 1)) < 1e-12);
        CHECK(point.index == (sign > 0 ? 0 : 1));
      }
      const double first = family.first(branch.points[0].x),
                   mode = family.first(found.special[0].mode);
      CHECK(side * first * mode > 0);
    }
  }
  FlatFamily family(transcritical(), 3);
  PathFollower<FlatFamily> follower(family, {0, 3, 500});
  const auto found = follower.follow(family.at(0));
  REQUIRE(found.special.size() == 1);
  CHECK(std::abs(found.special[0].bend) < 1e-5);
  for (const double side : {1., -1.})
    for (const auto& point : follower.follow(found.special[0], side).points)
      CHECK(std::abs(family.first(point.x) - (point.λ - 1)) < 1e-11);
}

TEST_CASE("branches that come near each other are not taken for a crossing, nor is one left") {
  for (const double ε : {1e-1, 1e-3, 1e-5}) {
    FlatFamily family(pitchfork(1, -ε), 2);
    // y³ + y = ε at λ = 0
    double y = ε;
    for (int i = 0; i < 50; ++i) y -= (y * y * y + y - ε) / (3 * y * y + 1);
    const auto found = path(family, family.at(y), 0, 3);
    INFO(ε << " " << kinds(found));
    CHECK(found.special.empty());
    CHECK(found.ended == PathEnd::reached);
    CHECK(family.first(found.points.back().x) > 1);
    for (const auto& point : found.points) CHECK(point.index == 0);
    check_points(family, found);
  }
}

TEST_CASE("two modes at once are told, not guessed") {
  OneCoordinate one = pitchfork(1);
  FlatFamily family(one, 2);
  struct Twin : FlatFamily {
    /// (|x|² − (λ − 1))² /4: both coordinates buckle at once.
    void linearise(const Vector& x, Hessian, Storage& out) const {
      const double r = x.squaredNorm() - (λ - 1);
      out.gradient = r * x;
      out.hessian.values = sparse(r * Dense::Identity(2, 2) + 2 * x * x.transpose()).values;
    }
    void slope(const Vector& x, Vector& out) const { out = -x; }
  };
  Twin twin{family};
  PathFollower<Twin> follower(twin, {0, 3, 500});
  const auto found = follower.follow(Vector::Zero(2));
  REQUIRE(found.special.size() == 1);
  CHECK(found.special[0].kind == Singularity::multiple);
  CHECK(std::abs(found.special[0].λ - 1) <= found.special[0].error + 2e-6);
  CHECK(found.special[0].error < 1e-3);
  CHECK_FALSE(found.special[0].branches());
}

TEST_CASE("paths end where they are told to") {
  FlatFamily family(cubic(), 2);
  const auto start = family.at(-2.5);
  const double λ = -2.5 + 2.5 * 2.5 * 2.5 / 3;
  CHECK(path(family, start, λ, -5, 5).ended == PathEnd::most_points);
  CHECK(path(family, start, λ, -5, 5).points.size() == 5);
  int seen = 0;
  PathLimits limits{λ, -5};
  limits.look = [&](int points, double) { return (seen = points) < 7; };
  PathFollower<FlatFamily> follower(family, limits);
  CHECK(follower.follow(start).ended == PathEnd::interrupted);
  CHECK(seen == 7);
  CHECK(path(family, start, λ, 2 * λ + 1).ended == PathEnd::reached);
  CHECK(path(family, start, λ, λ + 0.5).points.back().λ == λ + 0.5);
  CHECK(path(family, Vector::Constant(2, std::nan("")), λ, -5).ended == PathEnd::lost);
}
