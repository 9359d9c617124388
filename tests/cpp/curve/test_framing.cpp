// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/curve/bishop.hpp>

#include "support/arcs.hpp"
#include "support/near.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double π = std::numbers::pi;
const Vec3 e3 = Vec3::UnitZ();

/// A turn by θ about an axis across e3.
Quaternion across(Random& random, double θ) {
  const double φ = random.number(-π, π);
  return exp(Vec3(θ * std::cos(φ), θ * std::sin(φ), 0));
}

Quaternion about_e3(double ψ) { return exp(Vec3(0, 0, ψ)); }

/// Frames of a random open arc that are adapted, and not Bishop's.
std::vector<Quaternion> framing(Random& random, const Arc& arc) {
  std::vector<Quaternion> out;
  for (int j = 0; j < arc.edges(); ++j)
    out.push_back(adapted(random.rotation<Spatial>(), arc.edge(j)));
  return out;
}

}  // namespace

TEST_CASE("an adapted frame has a3 along the tangent, and got there the least way") {
  Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Quaternion q = random.rotation<Spatial>(random.number(0, 6));
    const Vec3 t = random.turn<Spatial>(random.number(0.1, 5));
    const Quaternion p = adapted(q, t);
    CHECK(std::abs(p.norm() - 1) < 4e-16);
    CHECK(distance(rotate(p, e3), t.normalized()) < 1e-15);
    CHECK(p.dot(q) >= 0);
    const double away = Turning(rotate(q, e3), t).angle();
    CHECK(std::abs(log(q.conjugate() * p).norm() - away) < 2e-15);
    CHECK(std::abs(twist_angle(q.conjugate() * p)) < 4e-15 / std::cos(away / 2));
    CHECK(distance(adapted(p, t), p) < 1e-15);
  }
}

TEST_CASE("the twist of a turn is its part about a3, up to two pi and with its sign") {
  Random random(2);
  for (double ψ = -6.28; ψ <= 6.28; ψ += 0.01) {
    const double θ = random.number(0, 3);
    CAPTURE(ψ);
    CHECK(std::abs(twist_angle(across(random, θ) * about_e3(ψ)) - ψ) < 4e-15 / std::cos(θ / 2));
  }
  CHECK(twist_angle(Quaternion::Identity()) == 0);
  CHECK(twist_angle(quaternion(-1, Vec3::Zero())) == 2 * π);
  CHECK(twist_angle(quaternion(0, e3)) == π);
  CHECK(twist_angle(quaternion(0, -e3)) == -π);
}

TEST_CASE("the twist does not see on which side of the turn it happens") {
  Random random(3);
  for (int i = 0; i < 100; ++i) {
    const Quaternion B = across(random, random.number(0, 2));
    const double ψ = random.number(-6, 6);
    CHECK(std::abs(twist_angle(about_e3(ψ) * B) - ψ) < 1e-14);
    CHECK(std::abs(twist_angle((B * about_e3(ψ)).conjugate()) + ψ) < 1e-14);
  }
}

TEST_CASE("turned about its tangents, a Bishop framing twists by the differences of the angles") {
  Random random(4);
  const Points r = random_points(random, 30);
  const Arc arc{r};
  const auto bishop = bishop_frames(arc, adapted(random.rotation<Spatial>(), arc.edge(0)));
  Vector φ = 3 * random.vector(29);
  φ[0] = 0.5;
  const auto frames = turned_about_tangents(bishop, φ);
  for (const auto& q : frames) CHECK(std::abs(q.norm() - 1) < 4e-16);
  const Vector ψ =
      twist_angles(arc_length(arc), CosseratCurve<Spatial>{r, frames, bishop[0], frames[28]});
  CHECK(std::abs(ψ[0] - 0.5) < 1e-15);
  for (int j = 1; j < 29; ++j) CHECK(std::abs(ψ[j] - (φ[j] - φ[j - 1])) < 1e-13);
  CHECK(std::abs(ψ[29]) < 1e-15);
}

TEST_CASE("angles about tangents undo the turning, for many turns along the curve") {
  Random random(5);
  const Points r = random_points(random, 200);
  const auto from = framing(random, Arc{r});
  Vector φ(199);
  double sum = random.number(-3, 3);
  for (double& angle : φ) angle = sum, sum += random.number(-1, 3.1);
  REQUIRE(φ[198] > 30);
  const auto frames = turned_about_tangents(from, φ);
  CHECK((angles_about_tangents(from, frames) - φ).cwiseAbs().maxCoeff() < 1e-12);
  CHECK((angles_about_tangents(frames, from) + φ).cwiseAbs().maxCoeff() < 1e-12);
  auto negative = frames;  // the same frames by other quaternions
  for (std::size_t j = 0; j < negative.size(); j += 3) negative[j].coeffs() *= -1;
  CHECK((angles_about_tangents(from, negative) - φ).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(angles_about_tangents(from, from).isZero(1e-15));
}

TEST_CASE("on a circle, a framing that goes round k times twists by 2 pi k") {
  const int n = 40;
  const Points r = regular_polygon(n);
  const Arc arc{r, Closure::closed};
  const auto bishop = bishop_frames(arc, adapted(Quaternion::Identity(), arc.edge(0)));
  for (const int k : {-3, 0, 1, 2}) {
    CAPTURE(k);
    const auto frames =
        turned_about_tangents(bishop, Vector::LinSpaced(n, 0, 2 * π * k * (n - 1.) / n));
    const Vector ψ = twist_angles(arc_length(arc), closed(r, frames));
    REQUIRE(ψ.size() == n);
    CHECK((ψ.array() - 2 * π * k / n).abs().maxCoeff() < 3e-14);
  }
}

TEST_CASE("continued frames are the same, each nearer to the one before than its negative is") {
  Random random(6);
  std::vector<Quaternion> frames;
  for (int i = 0; i < 100; ++i) frames.push_back(random.rotation<Spatial>(random.number(0, 6)));
  const auto out = continued(frames);
  CHECK(distance(out[0], frames[0]) == 0);
  int changed = 0;
  for (int j = 1; j < 100; ++j) {
    CHECK(out[j].dot(out[j - 1]) >= 0);
    CHECK(out[j].coeffs().cwiseAbs() == frames[j].coeffs().cwiseAbs());
    CHECK(std::abs(out[j].dot(frames[j])) == doctest::Approx(1).epsilon(1e-15));
    changed += out[j].dot(frames[j]) < 0;
  }
  CHECK(changed > 20);
  CHECK(distance(continued(out), out) == 0);
}

TEST_CASE("a frame turned by pi from its neighbour is refused where signs mean nothing") {
  const auto pair = [](double θ) {
    return std::vector<Quaternion>{Quaternion::Identity(), about_e3(0.5), about_e3(0.5 + θ)};
  };
  CHECK_NOTHROW(check_continued(pair(0)));
  CHECK_NOTHROW(check_continued(pair(π - 2e-9)));
  CHECK_NOTHROW(check_continued(pair(π + 2e-9)));
  CHECK_NOTHROW(check_continued(pair(2 * π)));
  const std::string message =
      "frames[2]: turned by pi from the one before, so that the sense of the turn is lost; use "
      "more "
      "edges";
  for (const double θ : {π, -π, π - 0.5e-9, π + 0.5e-9})
    CHECK(refusal([&] { check_continued(pair(θ)); }) == message);
}
