// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene/plane.hpp>

#include <doctest/doctest.h>

#include <string>
#include <vector>

using namespace pyrod;

namespace {

const Section section(1, 1, 0.7, 1, 1, 1, 2.0);
const RodSpec rod = straight(1.0, 8, section);

std::string leaving(const Scene& scene, int across = 1) {
  const SceneOnGrids on(with_vertices_at_places(scene, false));
  return leaving_plane(on, network_of(on), across);
}

}  // namespace

TEST_CASE("a scene in a plane has nothing that leaves it") {
  const Scene scene(rod, {Clamp{}, Slider{.along = Vec3(1, 0, 1)}},
                    {Force{{1, 0, -2}}, Moment{{0, 3, 0}}, Gravity{{1, 0, 0}}});
  CHECK(leaving(scene) == "");
  CHECK(leaving(scene, 0) == "support 1 (Slider) may move aslant to the plane");
  CHECK(leaving({rod, {Clamp{}}, {Force{{0, 1, 1}}}}, 0) == "");
}

TEST_CASE("what leaves the plane is told in words") {
  CHECK(leaving({rod, {Clamp{}}, {Force{{0.25, 0.125, 0}}}}) ==
        "load 0 (Force) has a component 0.125 along a2");
  CHECK(leaving({rod, {Clamp{}}, {Moment{{0, 1, -1. / 3}}}}) ==
        "load 0 (Moment) has a component -0.333 along a3");
  CHECK(leaving({rod, {Clamp{}}, {Force{{1, 1e-20, 0}, End::end, true}}}) ==
        "load 0 (Force) has a component 1e-20 along a2");
  CHECK(leaving({rod, {Clamp{}}, {Gravity{{0, 5, 0}}}}) ==
        "load 0 (Gravity) has a component 5 along a2");
  CHECK(leaving({rod, {Clamp{}}, {DistributedForce{[](double s) { return Vec3(0, s, 0); }}}}) ==
        "load 0 (DistributedForce) has a component 0.938 along a2");
  CHECK(leaving({precurved(1.0, 8, section, Vec3(0, 1, 0.5)), {Clamp{}}}) ==
        "rod 0 is twisted at rest, K0 = 0.5");
  CHECK(leaving({rod, {Clamp{.turns = 2}}}) == "support 0 (Clamp) twists the rod, turns = 2");
}

TEST_CASE("what is rounding beside all that acts does not leave the plane") {
  CHECK(leaving({rod, {Clamp{}}, {Force{{1, 1e-14, 0}}}}) == "");
  CHECK(leaving({rod, {Clamp{}}, {Force{{1, 1e-10, 0}}}}) != "");
}
