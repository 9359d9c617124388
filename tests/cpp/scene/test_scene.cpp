// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene.hpp>
#include <pyrod/scene/scene_on_grids.hpp>

#include <doctest/doctest.h>

#include <numbers>

using namespace pyrod;

namespace {

const Section round_one(1, 1, 0.7), flat(1, 3, 0.8, 80, 90, 300);
const Vec3 elastica(0.8106090248802964, 0, 0.4450044022462487);  // F L²/EI = 10

Scene bent(std::optional<int> edges, double force = 10) {
  return {straight(1.0, edges, round_one), {Clamp{}}, {Force{{force, 0, 0}}}, Dimension::planar};
}

void balances(const Equilibrium& found) {
  const auto [force, moment] = found.balance();
  CHECK(found.converged());
  CHECK(force < 1e-12);
  CHECK(moment < 1e-12);
}

}  // namespace

TEST_CASE("the elastica to a tolerance: true errors are those that are told, or less") {
  for (const double tol : {1e-4, 1e-7, 1e-9})
    for (const std::optional<int> edges : {std::optional<int>(), std::optional(10)}) {
      const auto found = solve(bent(edges), {.tol = tol});
      balances(found);
      REQUIRE(found.accuracy);
      CHECK(found.accuracy->largest() <= tol);
      CHECK((found.tip() - elastica).norm() <= found.accuracy->error(Quantity::positions));
      CHECK(found.accuracy->reached.regular);
      CHECK(found.doubts.empty());
    }
  CHECK(solve(bent(automatic)).accuracy->largest() <= 1e-6);
  CHECK(!solve(bent(64)).accuracy);
}

TEST_CASE("grids as they are given converge with order two") {
  double before = 0;
  for (const int edges : {32, 64, 128}) {
    const double error = (solve(bent(edges)).tip() - elastica).norm();
    if (before > 0) CHECK(before / error == doctest::Approx(4).epsilon(0.02));
    before = error;
  }
}

TEST_CASE("a scene is a value") {
  Scene scene = bent(32);
  const Scene kept = scene;
  scene.loads.clear();
  CHECK((solve(scene).tip() - Vec3(0, 0, 1)).norm() < 1e-14);
  CHECK(solve(kept).tip().x() > 0.8);
}

TEST_CASE("as a network it is the same as by itself") {
  for (const auto space : {Dimension::planar, Dimension::spatial}) {
    Scene scene = bent(48);
    scene.space = space;
    scene.loads.push_back(Moment{{0, 0.4, 0}, 0.3});
    const auto plain = solve(scene), network = solve(scene, {.eigenvalue = true});
    CHECK((plain.tip() - network.tip()).norm() < 1e-12);
    CHECK((plain.reactions()[0].moment - network.reactions()[0].moment).norm() < 1e-11);
    balances(plain), balances(network);
  }
}

TEST_CASE("supports exert nothing along what they leave free") {
  const auto held = [](Support support) {
    const auto found = solve(
        {straight(1.0, 30, flat), {Clamp{}, std::move(support)}, {Force{{1, -0.5, 0.3}, 0.7}}});
    balances(found);
    return found;
  };
  const Vec3 there(0.1, 0.05, 0.9), axis = Vec3(0.3, 1, 0.2).normalized();
  const Quaternion turned = frame_along({0.3, 0.1, 1});

  const auto hinge = held(Hinge{there, End::end});
  CHECK((hinge.tip() - there).norm() < 1e-12);
  CHECK(hinge.reactions()[1].moment.norm() < 1e-11);

  const auto slide = held(Slider{.along = axis, .position = there});
  CHECK(std::abs(slide.reactions()[1].force.dot(axis)) < 1e-11);
  CHECK((slide.tip() - there).cross(axis).norm() < 1e-12);

  const auto plane = held(Slider{.normal = axis, .position = there, .frame = turned});
  CHECK(plane.reactions()[1].force.cross(axis).norm() < 1e-11);
  CHECK(std::abs((plane.tip() - there).dot(axis)) < 1e-12);
  CHECK(plane.tip_frame().angularDistance(turned) < 1e-12);

  const auto sleeve = held(Sleeve{there, turned, End::end});
  CHECK(std::abs(sleeve.reactions()[1].force.dot(rotate(turned, Vec3::UnitZ()))) < 1e-11);
  CHECK(sleeve.tip_frame().angularDistance(turned) < 1e-12);

  const auto pin = held(Pivot{axis, there, turned, End::end});
  CHECK(std::abs(pin.reactions()[1].moment.dot(axis)) < 1e-11);
  CHECK((pin.tip() - there).norm() < 1e-12);

  const auto spring = held(Spring{5, 2, there, turned});
  CHECK((spring.reactions()[1].force - 5 * (there - spring.tip())).norm() < 1e-11);
}

TEST_CASE("two rods joined rigidly are one; a ball joint hands on no moment") {
  const auto half = straight(0.5, 16, round_one);
  const std::vector<Load> loads{Force{{1, 2, 0.5}, {1, End::end}}};
  const Scene joined({half, half.placed({Vec3(0, 0, 0.5)})}, {Clamp{}}, loads, Dimension::spatial,
                     {Joint{{{0, End::end}, {1, End::start}}}});
  const auto two = solve(joined);
  const auto one = solve({straight(1.0, 32, round_one), {Clamp{}}, {Force{{1, 2, 0.5}}}});
  CHECK((two.tip(1) - one.tip()).norm() < 1e-12);
  CHECK(two.energy() == doctest::Approx(one.energy()).epsilon(1e-12));

  Scene loose = joined;
  loose.joints[0].kind = JointKind::ball;
  loose.supports.push_back(Hinge{Vec3(0, 0, 0.95), {1, End::end}});
  loose.loads = {Force{{1, 0, 0}, {0, End::end}}};
  const auto ball = solve(loose);
  balances(ball);
  CHECK(ball.rod(0).moment.back().norm() < 1e-11);
}

TEST_CASE("a ring with a turn of twist stays flat below its threshold") {
  const double turn = 2 * std::numbers::pi;
  const Scene ring({straight(1.0, 64, round_one)}, {Clamp{}}, {}, Dimension::spatial,
                   {Joint{.points = {End::start, End::end}, .turns = 1}});
  const auto found = solve(ring, {.tol = 1e-8});
  CHECK(found.stable());
  CHECK(found.energy() == doctest::Approx((1 + 0.7) * turn * turn / 2).epsilon(2e-8));
}

TEST_CASE("loads that follow have no index, gravity weighs, lists go with their edges") {
  const auto follows =
      solve({straight(1.0, 32, round_one),
             {Clamp{}},
             {Force{{2, 1, 0}, 0.6, true}, DistributedForce{Vec3(1, 0, 0), 0, true}}});
  balances(follows);
  CHECK(follows.index() == -1);

  const Section heavy(1, 1, 0.7, Section::rigid, Section::rigid, Section::rigid, 0.5);
  const auto hanging = solve({straight(2.0, 16, heavy), {Clamp{}}, {Gravity{}}});
  CHECK((hanging.reactions()[0].force - Vec3(0, 0, 9.81)).norm() < 1e-12);

  const std::vector<Vec3> steps{{1, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  const Scene stepped(straight(1.0, 4, round_one), {Clamp{}, Spring{7, 0, {}, {}, 0.33}},
                      {DistributedForce{steps}});
  const auto given = solve(stepped), fine = solve(stepped, {.tol = 1e-6});
  for (const auto* found : {&given, &fine}) {
    Vec3 sum = Vec3::Zero();
    for (const auto& F : found->rod().load) sum += F;
    CHECK((sum - Vec3(0.75, 0.75, 1)).norm() < 1e-12);
  }
}

TEST_CASE("places are the same vertices, by number, on every grid") {
  const std::vector<double> places{0.1, 1. / 3, 0.4234658589667165, 0.7, 0.93};
  std::vector<Support> held{Clamp{}};
  for (const double at : places) held.push_back(Spring{3, 0, {}, {}, at});
  for (const std::optional<int> edges : {std::optional<int>(), std::optional(7)}) {
    const Scene scene =
        with_vertices_at_places({straight(1.0, edges, flat), held, {Force{{1, 0, 0}, 0.77}}}, true);
    const SceneOnGrids base(scene);
    for (const int level : {1, 4, 9}) {
      const SceneOnGrids fine(scene, level);
      for (const double at : places) {
        CHECK(fine.vertex(at) == base.vertex(at) << level);
        CHECK(fine.rod(0).grid.s(fine.vertex(at)) == doctest::Approx(at).epsilon(1e-13));
      }
      CHECK(fine.loads(0).force[std::size_t(base.vertex(0.77) << level)] == Vec3(1, 0, 0));
    }
  }
}

TEST_CASE("a start that is near takes fewer steps, and finds the same") {
  Scene scene({straight(1.0, 32, flat),
               {Clamp{}, Hinge{Vec3(0.1, 0.2, 0.8), End::end}},
               {Force{{0.5, 0, 0}, 0.5}}});
  const auto first = solve(scene);
  scene.loads = {Force{{0.6, 0, 0}, 0.5}};
  const auto cold = solve(scene), warm = solve(scene, {.start = &first});
  CHECK(warm.course.record.size() < cold.course.record.size());
  CHECK((warm.rod().curve.positions[16] - cold.rod().curve.positions[16]).norm() < 1e-9);
}

TEST_CASE("a start of the edges that were given will do, whatever its signs") {
  const Scene scene(straight(1.0, 10, flat), {Clamp{}}, {Force{{1, 0.5, 0}, 0.33}});
  const auto plain = solve(scene), fine = solve(scene, {.tol = 1e-6});
  const auto from = solve(scene, {.tol = 1e-6, .start = &plain});
  CHECK((from.tip() - fine.tip()).norm() < 1e-9);
  std::vector<Quaternion> frames = plain.rod().curve.frames;
  for (auto& q : frames) q.coeffs() *= -1;
  const auto again = solve(scene, {.frames = frames});
  CHECK((again.tip() - plain.tip()).norm() < 1e-12);
  CHECK(again.course.record.size() <= 2);
}

TEST_CASE("places that differ by rounding are one vertex") {
  const Scene scene(straight(1.0, 11, flat), {Clamp{}, Hinge{Vec3(0.05, 0, 0.28), 0.1 + 0.2}},
                    {Force{{1, 0, 0}, 0.3}});
  const auto found = solve(scene, {.tol = 1e-6});
  CHECK(found.shape().made[0].edges() == 12);
  balances(found);
}

TEST_CASE("lists keep the ends of their edges on the solver's own grid, and so do functions") {
  const auto tip = [](const Along<Section>& section, const Along<Vec3>& force) {
    const Scene scene(straight(1.0, automatic, section), {Clamp{}},
                      {Force{{1, 0, 0}, 0.37}, DistributedForce{force}});
    const auto found = solve(scene, {.tol = 1e-8});
    CHECK(found.doubts.empty());
    return found.tip();
  };
  std::vector<Section> sections(8, round_one);
  sections.insert(sections.end(), 8, Section(4, 4, 3));
  std::vector<Vec3> forces(7, Vec3(2, 0, 0));
  forces.insert(forces.end(), 9, Vec3(0, 0, 0));
  const auto section = [&](double s) { return s < 0.5 ? sections[0] : sections[15]; };
  const auto force = [&](double s) { return s < 7. / 16 ? forces[0] : forces[15]; };
  CHECK((tip(section, force) - tip(sections, forces)).norm() < 2e-8);
}

TEST_CASE("saddles are left for stable shapes, or kept and doubted") {
  const Scene column(straight(1.0, 32, Section(1, 3, 0.8)), {Clamp{}}, {Force{{0, 0, -4}}});
  const auto buckled = solve(column), upright = solve(column, {.stable = false});
  CHECK(buckled.stable());
  CHECK(buckled.tip().z() < 0.9);
  CHECK(upright.index() == 1);
  CHECK(upright.tip().z() == doctest::Approx(1));
}
