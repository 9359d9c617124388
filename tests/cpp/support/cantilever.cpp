// SPDX-License-Identifier: BSD-3-Clause
#include "support/cantilever.hpp"

#include "support/network.hpp"

namespace pyrod::test {

namespace {

template <class Space>
Network<Space> network(const Scene<Space>& scene) {
  return clamped<Space>(scene.rod, {scene.r0, scene.q0}, scene.loads);
}

template <class Space>
Solved<Space> the_rod(Solution<Space>&& from) {
  return {std::move(from.rods[0]), from.status,     from.index,
          from.residual,           from.load_steps, std::move(from.record)};
}

}  // namespace

template <class Space>
Solved<Space> solved(const Scene<Space>& scene, const Options& options, const Trace& trace,
                     bool stable) {
  return the_rod(solved(network(scene), {.stable = stable}, options, trace));
}

template <class Space>
Solved<Space> solved(const Scene<Space>& scene, std::vector<typename Space::Rotation> frames) {
  return the_rod(solved_from(network(scene), std::move(frames)));
}

#define INSTANTIATE(Space)                                                                       \
  template Solved<Space> solved<Space>(const Scene<Space>&, const Options&, const Trace&, bool); \
  template Solved<Space> solved<Space>(const Scene<Space>&, std::vector<Space::Rotation>);
INSTANTIATE(Planar)
INSTANTIATE(Spatial)
#undef INSTANTIATE

Solved<Spatial> solved(const Rod<Spatial>& rod, Dimension dimension, ModelKind model,
                       const Placement<Spatial>& clamp, const Loads<Spatial>& loads,
                       const std::vector<Quaternion>& start, bool stable) {
  const auto net = clamped(in_model(rod, model), clamp, loads);
  const auto from = start.empty() ? std::nullopt : std::optional(NetworkStart{start, {}, {}});
  return in_space(dimension, [&]<class Space>(Space) {
    return the_rod(run_in<Space>(net, clamp, from, {.stable = stable}));
  });
}

template <class Space>
Scene<Space> rich_scene(int edges, double length, double stiffness) {
  const double L = length, EI = stiffness, force = EI / (L * L), moment = EI / L;
  const auto s = [&](double ξ) { return L * (ξ + 0.05 * std::sin(2 * std::numbers::pi * ξ)); };
  const auto spin = [](double a, double b, double c) { return restrict_spin<Space>({a, b, c}); };
  const auto point = [](double a, double b, double c) { return restrict_point<Space>({a, b, c}); };

  Vector h(edges);
  for (int j = 0; j < edges; ++j) h[j] = s(double(j + 1) / edges) - s(double(j) / edges);
  Rod<Space> rod{Grid(h), {}, {}, {}};
  for (int j = 0; j <= edges; ++j) {
    const double x = rod.grid.s(j) / L;
    rod.bending.push_back(EI * spin(1.5 - 0.5 * x, 1 - 0.3 * x, 0.8 + 0.2 * x * x));
    rod.K0.push_back(spin(0.5, std::sin(3 * x), 1 - x) / L);
  }
  Scene<Space> scene{rod};
  std::vector<Point<Space>> weight;
  std::vector<Spin<Space>> twisting;
  for (int j = 0; j < edges; ++j) {
    const double x = rod.grid.centre(j) / L;
    scene.rod.stretching.push_back(force * point(40 + 10 * x, 60, 100 - 20 * x));
    weight.push_back(force / L * point(0.5, -1, -1 - x));
    twisting.push_back(moment / L * spin(0.1, 0.2 * x, 0.3));
  }
  scene.loads.add_force_per_length(rod.grid, weight);
  scene.loads.add_moment_per_length(rod.grid, twisting);
  scene.loads.add_force(rod.grid, force * point(2, 1, -1), L);
  scene.loads.add_force(rod.grid, force * point(-1, 1, 0.5), L / 2);
  scene.loads.add_moment(rod.grid, moment * spin(0.3, -0.4, 0.2), L);
  return scene;
}

template Scene<Planar> rich_scene(int, double, double);
template Scene<Spatial> rich_scene(int, double, double);

}  // namespace pyrod::test
