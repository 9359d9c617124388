// SPDX-License-Identifier: BSD-3-Clause
/// \file A network cut into spans: parts of rods between neighbouring nodes.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/network.hpp>

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pyrod {

/// The part of a rod between two neighbouring nodes, its edges [first, last).
template <class Space>
struct Span {
  int rod, first, last;
  int start, end;               ///< nodes
  int attachment;               ///< at its start, among those of the rod
  Directions<Space::dim> open;  ///< directions in which the section force is not known
  int block = -1;               ///< of its unknowns
};

/// The network with a node at every end, without frames of nodes that nothing needs, and its spans.
template <class Space>
struct Spans {
  static constexpr int dim = Space::dim, spin = Space::spin;

  Network<Space> network;
  std::vector<std::vector<Attachment<Space>>> attached;  ///< to each rod, in order of its vertices
  std::vector<Span<Space>> spans;
  std::vector<std::vector<std::pair<int, bool>>>
      spans_at;                  ///< each node, with whether they end there
  std::vector<char> has_frame;   ///< nodes whose own frame is needed
  std::vector<int> edge_offset;  ///< edges of the rods before
  int hinges = 0;
  std::vector<std::vector<int>> hinged;  ///< hinges at each node

  explicit Spans(Network<Space> given) : network(std::move(given)) {
    network.check_places();
    add_free_ends();
    drop_idle_frames();
    put_moments_on_nodes();
    cut_into_spans();
    check_reach();
  }

  int edges() const { return edge_offset.back(); }
  /// Number of edge j of a rod among all edges.
  int edge(int rod, int j) const { return edge_offset[rod] + j; }
  bool closed(int rod) const { return network.rods[rod].grid.closed(); }

  /// The edges before and behind an attached vertex; −1: none.
  std::pair<int, int> edges_at(const Attachment<Space>& a) const {
    const int n = network.rods[a.rod].edges();
    const int before = a.vertex > 0 ? a.vertex - 1 : closed(a.rod) ? n - 1 : -1;
    return {before < 0 ? -1 : edge(a.rod, before), a.vertex < n ? edge(a.rod, a.vertex) : -1};
  }

  /// A rod that cannot stretch must reach from one held point to the next.
  void check_reach() const {
    for (const auto& span : spans) {
      const auto &a = network.nodes[span.start], &b = network.nodes[span.end];
      if (a.free.cols() > 0 || b.free.cols() > 0) continue;
      const auto& rod = network.rods[span.rod];
      double length = 0;
      bool gives = false;
      for (int j = span.first; j < span.last; ++j) {
        length += rod.grid.h(j);
        gives = gives || !rod.stretching[j].array().isInf().all();
      }
      const double apart = (b.position - a.position).norm();
      require(
          gives || apart <= length * (1 + 1e-9), "supports: two points of rod ", span.rod,
          " are held ", apart, " apart, with ", length,
          " of a rod between them that cannot stretch; bring them nearer or give it a finite EA");
    }
  }

 private:
  void add_free_ends() {
    attached.resize(network.rods.size());
    hinged.resize(network.nodes.size());
    for (auto& a : network.attachments) {
      if (a.hinge) a.hinge_number = hinges++, hinged[a.node].push_back(a.hinge_number);
      attached[a.rod].push_back(a);
    }
    for (int rod = 0; rod < int(network.rods.size()); ++rod) {
      auto& on = attached[rod];
      std::sort(on.begin(), on.end(),
                [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
      for (std::size_t i = 1; i < on.size(); ++i)
        require(on[i].vertex != on[i - 1].vertex, "supports: vertex ", on[i].vertex, " of rod ",
                rod, " is held twice; join the two, or use more edges between them");
      if (on.empty() || on.front().vertex != 0) on.insert(on.begin(), {rod, 0, new_node(), false});
      const int n = network.rods[rod].edges();
      if (!closed(rod) && on.back().vertex != n) on.push_back({rod, n, new_node(), false});
    }
  }

  int new_node() {
    network.nodes.emplace_back();
    return int(network.nodes.size()) - 1;
  }

  /// A node's own frame is needed where two rods share it, where something acts on it or holds it.
  void drop_idle_frames() {
    std::vector<int> rigid(network.nodes.size(), 0);
    for (const auto& on : attached)
      for (const auto& a : on) rigid[a.node] += a.rigid;
    for (auto& on : attached)
      for (auto& a : on) {
        auto& node = network.nodes[a.node];
        if (!a.rigid || rigid[a.node] > 1 || node.turns.cols() < spin || node.torsion_spring > 0)
          continue;
        const int n = network.rods[a.rod].edges();
        const bool end = !closed(a.rod) && (a.vertex == 0 || a.vertex == n);
        if (node.parts_cell && !end) continue;
        if ((!end && !node.moment.isZero(0)) || !node.follower_moment.isZero(0)) continue;
        if (end)
          (a.vertex == 0 ? network.loads[a.rod].start_moment : network.loads[a.rod].end_moment) +=
              node.moment;
        node.moment.setZero();
        a.rigid = false;
      }
    has_frame.assign(network.nodes.size(), false);
    for (const auto& on : attached)
      for (const auto& a : on) has_frame[a.node] = has_frame[a.node] || a.rigid;
  }

  /// A moment at a vertex that is fixed to the frame of a node acts on that: the halves of the cell
  /// beside it end there.
  void put_moments_on_nodes() {
    for (const auto& on : attached)
      for (const auto& a : on) {
        if (!a.rigid || a.hinge) continue;
        const auto [dead, following] = network.loads[a.rod].take_moments(a.vertex);
        network.nodes[a.node].moment += dead;
        network.nodes[a.node].follower_moment += rotate_spin(a.relative, following);
      }
  }

  void cut_into_spans() {
    edge_offset.assign(1, 0);
    for (int rod = 0; rod < int(network.rods.size()); ++rod) {
      const int n = network.rods[rod].edges();
      edge_offset.push_back(edge_offset.back() + n);
      const auto& on = attached[rod];
      for (std::size_t i = 0; i < on.size(); ++i) {
        const bool last = i + 1 == on.size();
        if (last && !closed(rod)) continue;
        const int end = last ? n : on[i + 1].vertex;
        const int node = on[last ? 0 : i + 1].node;
        spans.push_back({rod, on[i].vertex, end, on[i].node, node, int(i), Mat<dim>::Identity()});
      }
    }
    spans_at.resize(network.nodes.size());
    for (int p = 0; p < int(spans.size()); ++p) {
      spans_at[spans[p].start].emplace_back(p, false);
      spans_at[spans[p].end].emplace_back(p, true);
    }
  }
};

}  // namespace pyrod
