// SPDX-License-Identifier: BSD-3-Clause
/// \file A shape to start a network from that somebody knows, whatever its supports were.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/start/restricted.hpp>
#include <pyrod/statics/start/start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace pyrod {

/// In space. Frames alone are enough: nodes are then placed by the rods that hang on them.
struct NetworkStart {
  std::vector<Quaternion> frames;  ///< of all edges, rod by rod
  std::vector<Vec3> positions;     ///< of the network's nodes, in their order; or none
  std::vector<Quaternion> node_frames;
};

/// A start for `net` from the rods of a solution, whose supports and joints may have been others:
/// a node is matched by the vertex that hangs on it, the first that the network lists.
inline NetworkStart start_from(const std::vector<RodSolution<Spatial>>& rods,
                               const Network<Spatial>& net) {
  net.check_places();
  require_count(Eigen::Index(rods.size()), Eigen::Index(net.rods.size()), "start", "one per rod");
  NetworkStart out;
  for (std::size_t i = 0; i < rods.size(); ++i) {
    const auto& frames = rods[i].curve.frames;
    require(int(frames.size()) == net.rods[i].edges(), "start: rod ", i, " had ", frames.size(),
            " edges, and now has ", net.rods[i].edges());
    out.frames.insert(out.frames.end(), frames.begin(), frames.end());
  }
  std::vector<const Attachment<Spatial>*> first(net.nodes.size(), nullptr);
  const auto has_frame = [](const auto* a) { return a && a->rigid && !a->hinge; };
  for (const auto& a : net.attachments)
    if (!first[a.node] || (has_frame(&a) && !has_frame(first[a.node]))) first[a.node] = &a;
  for (std::size_t v = 0; v < net.nodes.size(); ++v) {
    const auto* a = first[v];
    out.positions.push_back(a ? rods[a->rod].curve.positions[a->vertex] : net.nodes[v].position);
    out.node_frames.push_back(a ? rods[a->rod].vertex_frames[a->vertex] * a->relative.conjugate()
                                : net.nodes[v].frame);
  }
  return out;
}

/// The state of a network near a given shape. Supports hold what they hold, wherever that was in
/// the shape.
template <class Space>
class StateNear {
 public:
  /// `here`: where the plane of the computation is. `nodes`: those that were given; the layout adds
  /// one at each free end.
  StateNear(const Layout<Space>& layout, const Placement<Spatial>& here, std::size_t nodes)
      : layout_(layout), here_(here), nodes_(nodes) {}

  NetworkState<Space> state(const NetworkStart& start) const {
    check(start);
    NetworkState<Space> near;
    near.frames = restricted<Space>(start.frames, here_.frame);
    for (const auto& r : start.positions)
      near.positions.push_back(
          restrict_point<Space>(unrotate(here_.frame, Vec3(r - here_.position))));
    for (const auto& q : start.node_frames)
      near.node_frames.push_back(restrict_rotation<Space>(here_.frame.conjugate() * q));
    return state(std::move(near));
  }

  /// The same of frames, and positions and frames of nodes if there are any, in the space of the
  /// computation.
  NetworkState<Space> state(NetworkState<Space> near) const {
    NetworkState<Space> x = near.positions.empty() ? Start<Space>(layout_).state() : held();
    x.frames = std::move(near.frames);
    std::vector<char> known(x.positions.size(), false);
    const auto by_rods = turned_by_rods(x);
    for (std::size_t v = 0; v < known.size(); ++v) {
      known[v] = node(v).free.cols() == 0;
      if (v < near.positions.size())
        set(v, near, by_rods[v], x), known[v] = true;
      else if (by_rods[v])
        turn(v, *by_rods[v], x);
    }
    place_by_rods(known, x);
    set_hinges(x);
    return x;
  }

 private:
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Rotation = typename Space::Rotation;

  const Node<Space>& node(std::size_t v) const { return layout_.network().nodes[v]; }

  void check(const NetworkStart& start) const {
    require_frames(start.frames, layout_.edges(), "start");
    const std::size_t given = start.positions.size(), all = layout_.network().nodes.size();
    require(start.node_frames.size() == given && (given == 0 || given == nodes_ || given == all),
            "start: expected a position and a frame for each of the network's ", nodes_,
            " nodes, or for none, got ", given, " and ", start.node_frames.size(),
            "; a solution of another network starts this one by start_from");
    for (std::size_t v = 0; v < given; ++v) {
      require(start.positions[v].allFinite(), "start.positions[", v,
              "]: expected finite numbers, got ", start.positions[v].transpose());
      require_rotation(start.node_frames[v], "start.node_frames[", v, "]");
    }
  }

  /// The angles of hinges, as the frames beside them tell.
  void set_hinges(NetworkState<Space>& x) const {
    for (int rod = 0; rod < int(layout_.network().rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod)) {
        if (!a.hinge) continue;
        const Rotation W = x.node_frames[a.node].conjugate() * vertex_frame_of(rod, a.vertex, x) *
                           a.relative.conjugate();
        x.hinge_angles[a.hinge_number] = a.hinge->dot(log(principal(W)));
      }
  }

  /// Nodes where they are held, or would be; without frames of edges.
  NetworkState<Space> held() const {
    NetworkState<Space> x;
    for (const auto& one : layout_.network().nodes) {
      x.positions.push_back(one.position);
      x.node_frames.push_back(one.frame);
    }
    x.forces.assign(layout_.spans().size(), Point<Space>::Zero());
    x.hinge_angles.assign(std::size_t(layout_.hinges()), 0.);
    return x;
  }

  /// Moves a node to r as far as it is free to go.
  void place(std::size_t v, const Point<Space>& r, NetworkState<Space>& x) const {
    const double unit = layout_.unit_length(int(v));  // the length of the free directions
    const auto& F = node(v).free;
    x.positions[v] =
        node(v).position + F * (F.transpose() * (r - node(v).position)) / (unit * unit);
  }

  /// A node as it is given. Its frame goes along with the rods', which may have gone round.
  void set(std::size_t v, const NetworkState<Space>& near, const std::optional<Rotation>& by_rods,
           NetworkState<Space>& x) const {
    place(v, near.positions[v], x);
    auto q = near.node_frames[v];
    if (by_rods) q = *by_rods * principal(by_rods->conjugate() * q);
    turn(v, q, x);
  }

  /// Turns a node to q about the axes that it is free to turn about.
  void turn(std::size_t v, const Rotation& q, NetworkState<Space>& x) const {
    const auto& T = node(v).turns;
    if (T.cols() == 0) return;
    if (T.cols() == spin) {
      x.node_frames[v] = q;
      return;
    }
    const Rotation W = node(v).frame.conjugate() * q;
    const Spin<Space> part = T * (T.transpose() * log(principal(W)));
    x.node_frames[v] = node(v).frame * exp(part);
    if constexpr (spin == 3)  // the sign goes along with those of the rods
      if (W.w() < 0) x.node_frames[v].coeffs() *= -1;
  }

  /// Frames of nodes from those of the edges that are fixed to them; none: no edge is.
  std::vector<std::optional<Rotation>> turned_by_rods(const NetworkState<Space>& x) const {
    std::vector<std::optional<Rotation>> out(x.node_frames.size());
    for (int rod = 0; rod < int(layout_.network().rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod))
        if (a.rigid && !a.hinge && !out[a.node])
          out[a.node] = vertex_frame_of(rod, a.vertex, x) * a.relative.conjugate();
    return out;
  }

  /// Between the edges; at an end, as if the last half edge were bent as at rest.
  Rotation vertex_frame_of(int rod, int j, const NetworkState<Space>& x) const {
    const auto& r = layout_.network().rods[rod];
    const int n = r.edges(), before = j > 0 ? j - 1 : r.grid.closed() ? n - 1 : -1;
    const auto at = [&](int edge) { return x.frames[layout_.edge(rod, edge)]; };
    if (before < 0) return moved(at(0), Spin<Space>(-r.grid.Δs(0) * r.K0[0]));
    if (j == n) return moved(at(n - 1), Spin<Space>(r.grid.Δs(n) * r.K0[n]));
    return between(at(before), at(j), r.grid.h(before) / (2 * r.grid.Δs(j)));
  }

  /// Positions of nodes from those of their neighbours, along the rods between. A part of the
  /// network none of whose nodes is known begins where it is at rest.
  void place_by_rods(std::vector<char>& known, NetworkState<Space>& x) const {
    for (int v = 0; v < int(known.size()); ++v)
      if (known[v]) place_neighbours(v, known, x);
    for (int v = 0; v < int(known.size()); ++v)
      if (!known[v]) known[v] = true, place_neighbours(v, known, x);
  }

  void place_neighbours(int first, std::vector<char>& known, NetworkState<Space>& x) const {
    std::vector<int> todo{first};
    while (!todo.empty()) {
      const int v = todo.back();
      todo.pop_back();
      for (const auto& [p, end] : layout_.spans_at(v)) {
        const auto& span = layout_.spans()[p];
        const int other = end ? span.start : span.end;
        if (known[other]) continue;
        known[other] = true, todo.push_back(other);
        const Point<Space> chord = reach(span, x);
        place(other, x.positions[v] + (end ? Point<Space>(-chord) : chord), x);
      }
    }
  }

  /// From the start of a span to its end, unstretched.
  Point<Space> reach(const Span<Space>& span, const NetworkState<Space>& x) const {
    Point<Space> sum = Point<Space>::Zero();
    for (int j = span.first; j < span.last; ++j)
      sum += layout_.network().rods[span.rod].grid.h(j) *
             rotate(x.frames[layout_.edge(span.rod, j)], axis<Space>());
    return sum;
  }

  const Layout<Space>& layout_;
  const Placement<Spatial>& here_;
  std::size_t nodes_;
};

}  // namespace pyrod
