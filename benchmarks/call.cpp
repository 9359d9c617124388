// SPDX-License-Identifier: BSD-3-Clause
// The solves of call_overhead.py without Python: prints median times in seconds, of Newton's method
// alone, of a new scene and its solve, of these and the tip, which has the whole shape worked out,
// and of the next solve with another force, without and with its tip.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cmath>
#include <cstdio>

namespace {

using namespace pyrod;

/// F along x [N].
Scene scene(double F, Dimension dimension) {
  const Section section(1, 1, 0.7, 4e3, 4e3, 1e4);
  return Scene({straight(1.0, 64, section)}, {Clamp{}}, {Force{{F, 0, 0}}}, dimension);
}

template <class Space>
double newton_alone(const Scene& given) {
  const auto on = network_of(SceneOnGrids(with_vertices_at_places(given, false)));
  const Posed<Space> posed(on.network, on.plane);
  const ClampedStart<Space> start(posed.layout());
  Newton<NetworkProblem<Space>> newton(posed.problem());
  return benchmark::seconds([&] { newton.solve(start.state(), start.first()); });
}

}  // namespace

int main() {
  for (const auto dimension : {Dimension::planar, Dimension::spatial}) {
    const double newton = in_space(
        dimension, [&]<class Space>(Space) { return newton_alone<Space>(scene(10, dimension)); });
    const double call = benchmark::seconds([&] { solve(scene(10, dimension)); });
    double sum = 0;
    const double tip = benchmark::seconds([&] { sum += solve(scene(10, dimension)).tip().x(); });
    Solver solver(scene(10, dimension));
    int k = 0;
    const auto next = [&] {
      return solver.solve(Changes{.loads = {{0, Force{{10 + 0.01 * std::sin(++k), 0, 0}}}}});
    };
    const double again = benchmark::seconds([&] { next(); });
    const double again_tip = benchmark::seconds([&] { sum += next().tip().x(); });
    std::printf("%.9f %.9f %.9f %.9f %.9f\n", newton, call, tip, again, again_tip);
    if (!(sum > 0)) return 1;
  }
}
