// SPDX-License-Identifier: BSD-3-Clause
// Networks that depend on a number: the same by sums and made anew, slopes against differences.
#include "support/near.hpp"
#include "support/random.hpp"

#include <pyrod/paths/branch.hpp>
#include <pyrod/paths/network_family.hpp>
#include <pyrod/scene/scene_between.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/statics/ladder/compiled.hpp>
#include <pyrod/statics/start/start.hpp>

#include <memory>
#include <string>

using namespace pyrod;
using namespace pyrod::test;

namespace {

SceneNetwork network_in(const Scene& scene) {
  return network_of(SceneOnGrids(with_vertices_at_places(scene, false)));
}

const Section soft(1.0, 1.3, 0.8, 60.0, 80.0, 150.0), stiff(1, 1, 1);

struct Pair {
  const char* name;
  Scene first, second;
};

std::vector<Pair> pairs() {
  std::vector<Pair> out;
  const auto rod = [](const Section& section) { return straight(1.0, 8, section); };
  for (const auto& section : {soft, stiff}) {
    const auto loaded = [&](double t) {
      return Scene(rod(section), {Clamp{}, Hinge{Vec3(0.2, 0.1, 0.8), End::end}},
                   {Force{Vec3(t, 0.3, -1), 0.5}, DistributedForce{Vec3(0, 1 - t, 0)},
                    Gravity{Vec3(0, 0, 0)}});
    };
    auto first = loaded(0.2), second = loaded(1.7);
    for (auto* scene : {&first, &second}) scene->loads.pop_back();
    out.push_back({"dead", first, second});
    const auto moments = [&](double t) {
      return Scene(rod(section), {Clamp{}, Slider{.along = Vec3(0, 0, 1)}},
                   {Moment{Vec3(t, 0.2, 0.1), 0.5}, Moment{Vec3(0, t, 0)},
                    DistributedMoment{Vec3(0, 0, t)}});
    };
    out.push_back({"moments", moments(0), moments(1)});
    const auto following = [&](double t) {
      return Scene(rod(section), {Clamp{}, Hinge{Vec3(0.2, 0.1, 0.8), End::end}},
                   {Force{Vec3(t, 1, 0.2), 0.4, true}, DistributedForce{Vec3(1, t, 0), 0, true},
                    Moment{Vec3(0.1, 0.2, 0.3), 0.5, true}});
    };
    out.push_back({"following", following(0), following(2)});
    const auto moved = [&](double t) {
      return Scene(rod(section),
                   {Clamp{.position = Vec3(0, 0.1 * t, 0)},
                    Slider{.along = Vec3(1, 1, 0), .position = Vec3(0.1, 0, 0.9 - 0.2 * t)},
                    Hinge{Vec3(0.1 * t, 0, 0.45), 0.5}},
                   {Force{Vec3(t, 0, 0), 0.75}});
    };
    out.push_back({"moved", moved(0), moved(1)});
  }
  return out;
}

template <class Space>
struct Both {
  Placement<Spatial> at;
  NetworkFamily<Space> blended, remade;

  Both(const Scene& a, const Scene& b)
      : at(network_in(a).plane),
        blended(std::make_unique<BlendedNetwork<Space>>(network_in(a).network,
                                                        network_in(b).network, at)),
        remade(std::make_unique<RemadeNetwork<Space>>(
            [a, b](double λ) { return network_in(scene_between(a, b, λ)).network; }, 0.3, 1e-3,
            at)) {}

  /// Any shape.
  NetworkState<Space> state(unsigned seed) {
    Random random(seed);
    auto x = Start<Space>(blended.layout()).state();
    NetworkState<Space> out;
    Vector δ = random.vector(blended.layout().unknowns());
    blended.move(x, 0.3 * δ, out);
    return out;
  }
};

}  // namespace

TEST_CASE("what acts on the line between two scenes is what a scene on it says") {
  for (const auto& [name, first, second] : pairs()) {
    INFO(std::string(name));
    Both<Spatial> both(first, second);
    auto a = both.blended.linearisation(), b = both.remade.linearisation();
    Vector slope, other, skew, skew_other;
    const Vector v = Random(4).vector(int(a.gradient.size()));
    for (const double λ : {0., 0.3, 1., -0.8}) {
      auto x = both.state(3), y = x;
      both.blended.set(λ), both.remade.set(λ);
      both.blended.place(x), both.remade.place(y);
      for (std::size_t k = 0; k < x.positions.size(); ++k)
        CHECK(distance(x.positions[k], y.positions[k]) < 1e-13);
      both.blended.linearise(x, Hessian::exact, a), both.remade.linearise(y, Hessian::exact, b);
      const double unit = 1 + a.gradient.norm();
      CHECK(distance(a.gradient, b.gradient) < 1e-12 * unit);
      CHECK(both.blended.conservative() == both.remade.conservative());
      for (std::size_t k = 0; k < a.hessian.values.size(); ++k)
        CHECK(std::abs(a.hessian.values[k] - b.hessian.values[k]) < 1e-11 * unit);
      both.blended.multiply_skew(x, v, skew), both.remade.multiply_skew(x, v, skew_other);
      CHECK(distance(skew, skew_other) < 1e-11 * unit);
      both.blended.slope(x, slope), both.remade.slope(x, other);
      CHECK(slope.norm() > 1e-3);
      CHECK(distance(slope, other) < 1e-9 * unit);
    }
  }
}

TEST_CASE("in the plane, too, where its first support is moved") {
  const auto moved = [](double t) {
    return Scene(straight(1.0, 8, soft),
                 {Clamp{.position = Vec3(0.1 * t, 0, 0)}, Hinge{Vec3(0.2, 0, 0.8), End::end}},
                 {Force{Vec3(t, 0, -1), 0.5}}, Dimension::planar);
  };
  Both<Planar> both(moved(0), moved(1));
  auto a = both.blended.linearisation(), b = both.remade.linearisation();
  Vector slope, other;
  auto x = both.state(5), y = x;
  both.blended.set(0.7), both.remade.set(0.7);
  both.blended.place(x), both.remade.place(y);
  both.blended.linearise(x, Hessian::exact, a), both.remade.linearise(y, Hessian::exact, b);
  CHECK(distance(a.gradient, b.gradient) < 1e-12);
  both.blended.slope(x, slope), both.remade.slope(y, other);
  CHECK(distance(slope, other) < 1e-9);
}

TEST_CASE("the amplitude of a mode, and its gradient") {
  const auto family = pairs()[0];
  Both<Spatial> both(family.first, family.second);
  const auto x0 = both.state(1), x = both.state(2);
  const int n = both.blended.layout().unknowns();
  Random random(7);
  const Vector mode = random.vector(n), δ = random.vector(n);
  Vector gradient, unused;
  CHECK(both.blended.amplitude(x0, x0, mode, gradient) == 0);
  NetworkState<Spatial> near;
  both.blended.move(x0, 1e-6 * δ, near);
  CHECK(std::abs(both.blended.amplitude(x0, near, mode, unused) - 1e-6 * gradient.dot(δ)) < 1e-11);
  both.blended.amplitude(x0, x, mode, gradient);
  const auto at = [&](double t) {
    both.blended.move(x, t * δ, near);
    return both.blended.amplitude(x0, near, mode, unused);
  };
  CHECK(std::abs((at(1e-4) - at(-1e-4)) / 2e-4 - gradient.dot(δ)) < 1e-7);
}

TEST_CASE("two scenes that no line connects are refused") {
  const auto scene = [](Support end, Load load, int edges = 8) {
    return Scene(straight(1.0, edges, stiff), {Clamp{}, end}, {load});
  };
  const auto hinge = [](double z) { return Hinge{Vec3(0, 0, z), End::end}; };
  const Force force{Vec3(1, 0, 0), 0.5};
  const auto line = [](const Scene& a, const Scene& b) {
    scene_between(a, b, 0.5);
    BlendedNetwork<Spatial>(network_in(a).network, network_in(b).network, {});
  };
  const Scene plain = scene(hinge(0.9), force);
  line(plain, scene(hinge(0.8), force));
  CHECK_REFUSED("family: the two scenes have supports of different kinds",
                line(plain, scene(Clamp{.at = End::end}, force)));
  CHECK_REFUSED("family: the two scenes have loads of different kinds",
                line(plain, scene(hinge(0.9), Moment{Vec3(1, 0, 0), 0.5})));
  CHECK_REFUSED("family: at differs", line(plain, scene(hinge(0.9), Force{Vec3(1, 0, 0), 0.25})));
  CHECK_REFUSED("family: scenes of all values must have the same rods",
                line(plain, scene(hinge(0.9), force, 9)));
  CHECK_REFUSED("family: the rods of the two scenes differ", [&] {
    Scene other = plain;
    other.rods[0] = straight(1.0, 8, soft);
    line(plain, other);
  }());
  CHECK_REFUSED("family: the rods of the two scenes differ",
                line(scene(hinge(0.9), Moment{Vec3(1, 0, 0), 0.5, true}),
                     scene(hinge(0.9), Moment{Vec3(2, 0, 0), 0.5, true})));
  CHECK_REFUSED(
      "family: the supports of the two scenes differ in more than positions",
      line(scene(Spring{1, 0, Vec3(0, 0, 1)}, force), scene(Spring{1, 0, Vec3(0, 0, 2)}, force)));
  CHECK_REFUSED("family: stiffness differs", line(scene(Spring{1, 0, Vec3(0, 0, 1)}, force),
                                                  scene(Spring{2, 0, Vec3(0, 0, 1)}, force)));
}
