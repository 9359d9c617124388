// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>

#include <doctest/doctest.h>

#include <cmath>

using namespace pyrod;

namespace {

const Section section(1, 1, 0.7);
const RodSpec rod = straight(1.0, 8, section);

void refuses(const char* words, const Scene& scene, const Settings& settings = {}) {
  CHECK_THROWS_WITH_AS(solve(scene, settings), doctest::Contains(words), InvalidArgument);
}

}  // namespace

TEST_CASE("what a scene cannot be is refused before any work, by the argument's name") {
  refuses("rods: expected at least one", Scene(std::vector<RodSpec>{}));
  refuses("supports: nothing holds the rod", {rod, {}, {Force{{1, 0, 0}}}});
  refuses("at: must be an arc length on the rod, in [0, 1], got 1.5", {rod, {Clamp{.at = 1.5}}});
  refuses("at: there is no rod 1, the scene has 1", {rod, {Clamp{.at = {1, End::start}}}});
  refuses("rod: there is no rod 2, the scene has 1",
          {rod, {Clamp{}}, {DistributedForce{Vec3(1, 0, 0), 2}}});
  refuses("supports: vertex 0 of rod 0 is held twice", {rod, {Clamp{}, Hinge{}}});
  refuses("force_per_length: expected 3 numbers, or 8 times 3 (one per edge), got shape (2, 3)",
          {rod, {Clamp{}}, {DistributedForce{std::vector<Vec3>(2, Vec3::Zero())}}});
  refuses("Gravity: no rod has a mass", {rod, {Clamp{}}, {Gravity{}}});
  refuses("section: expected 8 rows (one per edge), got 3",
          {straight(1.0, 8, std::vector<Section>(3, section)), {Clamp{}}});
}

TEST_CASE("supports and joints say what they lack") {
  refuses("along: give either it or the normal of a plane", {rod, {Clamp{}, Slider{}}});
  refuses("axis: expected a vector of 3 finite numbers, not zero", {rod, {Pivot{Vec3(0, 0, 0)}}});
  refuses("stiffness: must be finite and not negative, got -1", {rod, {Clamp{}, Spring{-1}}});
  refuses("supports: frame: expected a unit quaternion",
          {rod, {Clamp{.frame = Quaternion(2, 0, 0, 0)}}});
  const auto joined = [](Joint joint) {
    return Scene({rod, rod}, {Clamp{}}, {}, Dimension::spatial, {std::move(joint)});
  };
  refuses("points: a joint needs two or more, got 1", joined({.points = {{0, End::end}}}));
  refuses("axis: a hinge needs one, other joints have none",
          joined({.points = {{0, End::end}, {1, End::start}}, .kind = JointKind::hinge}));
  refuses("joints: the points of joint 0 are not different vertices",
          joined({.points = {{0, End::end}, {0, 1.0}}}));
}

TEST_CASE("numbers that mean nothing are refused wherever they stand") {
  const double nan = std::nan("");
  refuses("supports: position: expected finite numbers", {rod, {Clamp{Vec3(nan, 0, 0)}}});
  refuses("at: there is no rod -1", {rod, {Clamp{.at = {-1, End::start}}}});
  refuses("turns: must be at most", {rod, {Clamp{}, Clamp{.at = End::end, .turns = 1 << 30}}});
  CHECK_THROWS_AS(rod.placed({Vec3(nan, 0, 0)}), InvalidArgument);
  CHECK_THROWS_AS(with_vertices(straight(1.0, automatic, section), {1e8}), InvalidArgument);
  CHECK_THROWS_WITH_AS(precurved(1.0, automatic, section, Vec3(1e9, 0, 0)),
                       doctest::Contains("edges would be needed"), InvalidArgument);
}

TEST_CASE("loads that follow and find no hold along a slide are no equilibrium") {
  const Slider slide{.along = Vec3(1, 0, 0), .clamped = true, .at = End::start};
  refuses("supports: nothing holds the rods against the force",
          {rod, {slide}, {Force{{1, 0, 0}, End::end, true}}});
}

TEST_CASE("settings are looked at as well") {
  const Scene scene(rod, {Clamp{}}, {Force{{1, 0, 0}}});
  refuses("tol: must be a number in (0, 0.1], got 0.2", scene, {.tol = 0.2});
  refuses("start: expected 8 rows (one frame per edge), got 3", scene,
          {.frames = std::vector<Quaternion>(3, Quaternion::Identity())});
  refuses("max_iterations", scene, {.options = {.max_iterations = 0}});
  CHECK_THROWS_AS(straight(-1.0, 8, section), InvalidArgument);
  CHECK_THROWS_AS(straight(1.0, 0, section), InvalidArgument);
  CHECK_THROWS_WITH_AS(precurved(1.0, automatic, section, std::vector<Vec3>(4, Vec3::Zero())),
                       doctest::Contains("one per vertex needs edges"), InvalidArgument);
}

TEST_CASE("what leaves the plane of a planar scene is refused") {
  refuses("leaves the plane of the clamp", {rod, {Clamp{}}, {Force{{0, 1, 0}}}, Dimension::planar});
  refuses("choose the spatial scene",
          {rod, {Clamp{}, Hinge{Vec3(0, 0.2, 0.9), End::end}}, {}, Dimension::planar});
}
