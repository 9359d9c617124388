// SPDX-License-Identifier: BSD-3-Clause
/// \file Networks for tests, held in all ways. Their solver is compiled once.
#pragma once

#include "support/random.hpp"

#include <pyrod/statics/ladder/compiled.hpp>

namespace pyrod::test {

/// A network that grows. Supports hold a vertex where it is at rest.
template <class Space>
struct Structure {
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Rotation = typename Space::Rotation;

  Network<Space> net;

  int add(Rod<Space> rod, const Point<Space>& position = Point<Space>::Zero(),
          const Rotation& frame = Rotation::Identity()) {
    net.placements.push_back({position, frame});
    net.loads.emplace_back(rod.edges());
    net.rods.push_back(std::move(rod));
    return int(net.rods.size()) - 1;
  }
  /// Uniform, straight, of length 1.
  int add(int edges, const Point<Space>& position = Point<Space>::Zero(),
          const Rotation& frame = Rotation::Identity()) {
    return add(Rod<Space>::uniform(Grid::uniform(1, edges), Spin<Space>::Ones(),
                                   100 * Point<Space>::Ones()),
               position, frame);
  }

  CosseratCurve<Space> at_rest(int rod) const {
    const auto& place = net.placements[rod];
    return net.rods[rod].at_rest(place.position, place.frame);
  }
  /// A node where a vertex is at rest; it moves in `free`, turns about `turns`.
  int node(int rod, int vertex, const Directions<dim>& free, const Directions<spin>& turns) {
    const auto rest = at_rest(rod);
    Node<Space> v;
    v.position = rest.positions[vertex];
    v.frame = vertex_frame(net.rods[rod].grid, rest, vertex);
    v.free = free;
    v.turns = turns;
    net.nodes.push_back(v);
    return int(net.nodes.size()) - 1;
  }
  /// Rigidly: with the angle that there is at rest.
  void attach(int rod, int vertex, int v, bool rigid, int turns = 0) {
    const Rotation q = vertex_frame(net.rods[rod].grid, at_rest(rod), vertex);
    net.attachments.push_back({rod, vertex, v, rigid, net.nodes[v].frame.conjugate() * q, turns});
  }
  int hold(int rod, int vertex, const Directions<dim>& free, const Directions<spin>& turns,
           bool rigid) {
    const int v = node(rod, vertex, free, turns);
    attach(rod, vertex, v, rigid);
    return v;
  }

  static Directions<dim> nowhere() { return Directions<dim>(dim, 0); }
  static Directions<dim> anywhere() { return Mat<dim>::Identity(); }
  static Directions<dim> along(int i) { return Mat<dim>::Identity().col(i); }
  static Directions<spin> fixed() { return Directions<spin>(spin, 0); }
  static Directions<spin> turning() { return Mat<spin>::Identity(); }

  int clamp(int rod, int vertex) { return hold(rod, vertex, nowhere(), fixed(), true); }
  int hinge(int rod, int vertex) { return hold(rod, vertex, nowhere(), turning(), false); }
  int roller(int rod, int vertex, int i) { return hold(rod, vertex, along(i), turning(), false); }
  int slider(int rod, int vertex, int i) { return hold(rod, vertex, along(i), fixed(), true); }
  int pivot(int rod, int vertex) {  // about a2
    return hold(rod, vertex, nowhere(), Mat<spin>::Identity().col(spin / 2), true);
  }
  int spring(int rod, int vertex, double stiffness, double torsion) {
    const int v = hold(rod, vertex, anywhere(), turning(), torsion > 0);
    net.nodes[v].spring = stiffness;
    net.nodes[v].torsion_spring = torsion;
    return v;
  }
  int joint(int rod, int vertex, int other, int other_vertex, bool rigid) {
    const int v = hold(rod, vertex, anywhere(), turning(), rigid);
    attach(other, other_vertex, v, rigid);
    return v;
  }
};

/// What acts on a random network.
struct Acting {
  bool moments = false, followers = false, closed = false;
};

/// Rods of all kinds that hang on a clamp, a joint, a roller, a pivot, a hinge and a spring.
template <class Space>
Network<Space> random_network(Random& random, const Acting& acting);

template <class Space>
Solution<Space> solved(const Network<Space>& net, const NetworkOptions& more = {},
                       const Options& options = {}, const Trace& trace = {});

/// From frames of all edges, where nothing else is unknown.
template <class Space>
Solution<Space> solved_from(const Network<Space>& net,
                            std::vector<typename Space::Rotation> frames);

/// Planar or spatial, in space.
template <class Space>
Solution<Spatial> run_in(const Network<Spatial>& net, const Placement<Spatial>& at = {},
                         const std::optional<NetworkStart>& start = {},
                         const NetworkOptions& more = {});

}  // namespace pyrod::test
