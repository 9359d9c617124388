// SPDX-License-Identifier: BSD-3-Clause
#include "support/network.hpp"

#include <type_traits>

namespace pyrod::test {

namespace {

template <class Space>
Spin<Space> about_normal(double angle) {
  return angle * Spin<Space>::Unit(Space::spin / 2);
}

/// Nearly a circle at rest.
template <class Space>
Rod<Space> closed_rod(Random& random, int edges, double length) {
  auto rod = random.rod<Space>(edges, length);
  rod.grid = Grid(rod.grid.edge_lengths(), Closure::closed);
  rod.bending.pop_back();
  rod.K0.pop_back();
  for (auto& K : rod.K0) K += about_normal<Space>(2 * std::numbers::pi / length);
  return rod;
}

template <class Space>
void load(Random& random, Network<Space>& net, const Acting& acting) {
  const auto force = [&] { return random.vector<Space::dim>(); };
  const auto moment = [&] { return random.vector<Space::spin>(); };
  for (int rod = 0; rod < int(net.rods.size()); ++rod) {
    auto& loads = net.loads[rod];
    const int n = net.rods[rod].edges();
    const bool closed = net.rods[rod].grid.closed();
    for (auto& F : loads.force) F = force();
    if (acting.moments) {
      for (auto& m : loads.moment) m = moment();
      if (!closed) loads.start_moment = moment(), loads.end_moment = moment();
    }
    if (!acting.followers) continue;
    loads.follower_forces = {{1, 2, force()}, {0, 0, force()}, {n - 1, n, force()}};
    loads.follower_moments = {{2, moment()}};
    if (!closed) loads.follower_end_moment = moment();
  }
  for (auto& v : net.nodes) {
    v.force = force();
    if (acting.moments) v.moment = moment();
  }
}

}  // namespace

template <class Space>
Network<Space> random_network(Random& random, const Acting& acting) {
  constexpr int dim = Space::dim, spin = Space::spin;
  Structure<Space> f;
  for (const int n : {6, 5, 4}) f.add(random.rod<Space>(n, 0.25 * n));
  const auto across = exp(about_normal<Space>(-std::numbers::pi / 2));
  if (acting.closed) f.add(closed_rod<Space>(random, 7, 4), 1.5 * axis<Space>(), across);
  const auto at = [&](int rod, int vertex, int v, bool rigid) {
    f.net.attachments.push_back({rod, vertex, v, rigid, random.rotation<Space>(0.4)});
  };
  const auto node = [&](double along, const Directions<dim>& free, const Directions<spin>& turns) {
    Node<Space> v;
    v.position = along * axis<Space>() + 0.1 * random.vector<dim>();
    v.frame = random.rotation<Space>(0.4);
    v.free = free;
    v.turns = turns;
    f.net.nodes.push_back(v);
    return int(f.net.nodes.size()) - 1;
  };
  const int clamp = node(0, f.nowhere(), f.fixed()), joint = node(1.5, f.anywhere(), f.turning());
  const int roller = node(2.2, f.along(0), f.turning());
  const int pivot = node(2, f.nowhere(), Mat<spin>::Identity().leftCols(1));
  const int hinge = node(2.4, f.nowhere(), f.turning());
  const int spring = node(2.7, f.anywhere(), f.turning());
  f.net.nodes[spring].spring = 3;
  f.net.nodes[spring].torsion_spring = 2;
  at(0, 0, clamp, true), at(0, 6, joint, true);
  at(1, 0, joint, true), at(1, 3, roller, false), at(1, 5, spring, true);
  at(2, 0, joint, false), at(2, 2, pivot, true), at(2, 4, hinge, false);
  if (acting.closed) {
    at(3, 4, spring, false), at(3, 0, joint, true);
    auto& relative = f.net.attachments.back().relative;  // the spring is opposite to the joint
    relative = across * relative;
    if constexpr (spin == 3) f.net.attachments.back().hinge = random.turn<Space>(1);
  }
  load(random, f.net, acting);
  return std::move(f.net);
}

template <class Space>
Solution<Space> solved(const Network<Space>& net, const NetworkOptions& more,
                       const Options& options, const Trace& trace) {
  const Posed<Space> posed(net);
  return told(posed, find<Space>(posed, {}, options, more, trace));
}

template <class Space>
Solution<Space> solved_from(const Network<Space>& net,
                            std::vector<typename Space::Rotation> frames) {
  const Posed<Space> posed(net);
  if constexpr (std::is_same_v<Space, Spatial>) {
    const NetworkStart start{std::move(frames), {}, {}};
    return told(posed, find<Spatial>(posed, start, {}, {}, {}));
  } else {
    require_frames(frames, posed.layout().edges(), "start");
    auto start = Start<Space>(posed.layout()).state();
    start.frames = std::move(frames);
    const Trace untraced;
    return told(posed, NetworkSolver<Space>(posed, {}, {}, untraced).find(std::move(start)));
  }
}

template <class Space>
Solution<Spatial> run_in(const Network<Spatial>& net, const Placement<Spatial>& at,
                         const std::optional<NetworkStart>& start, const NetworkOptions& more) {
  const Posed<Space> posed(net, at);
  return posed.in_space(told(posed, find<Space>(posed, start, {}, more, {})));
}

#define INSTANTIATE(Space)                                                                      \
  template Network<Space> random_network(Random&, const Acting&);                               \
  template Solution<Space> solved(const Network<Space>&, const NetworkOptions&, const Options&, \
                                  const Trace&);                                                \
  template Solution<Space> solved_from(const Network<Space>&, std::vector<Space::Rotation>);    \
  template Solution<Spatial> run_in<Space>(const Network<Spatial>&, const Placement<Spatial>&,  \
                                           const std::optional<NetworkStart>&,                  \
                                           const NetworkOptions&);
INSTANTIATE(Planar)
INSTANTIATE(Spatial)
#undef INSTANTIATE

}  // namespace pyrod::test
