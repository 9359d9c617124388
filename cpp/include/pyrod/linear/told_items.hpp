// SPDX-License-Identifier: BSD-3-Clause
/// \file What is told of a network in equilibrium, as numbered items.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <vector>

namespace pyrod {

/// Positions come apart, see `PositionSums`; turns of edges and section forces are the state's.
template <class Space>
class ToldItems {
 public:
  explicit ToldItems(const Layout<Space>& layout)
      : edges_(layout.edges()),
        nodes_(int(layout.network().nodes.size())),
        tendons_(int(layout.network().tendons.size())) {
    for (const auto& rod : layout.network().rods) first_.push_back(first_.back() + rod.edges() + 1);
  }

  int vertices() const { return first_.back(); }
  int vertex(int rod, int j) const { return first_[rod] + j; }

  int reach(int e) const { return e; }            ///< h R Γ
  int strain(int e) const { return edges_ + e; }  ///< Γ
  int vertex_turn(int vertex) const { return 2 * edges_ + vertex; }
  int curvature(int vertex) const { return vertex_turn(vertices()) + vertex; }
  int moment(int vertex) const { return curvature(vertices()) + vertex; }
  /// In space: what a moment there works on.
  int rotation(int vertex) const { return moment(vertices()) + vertex; }
  int reaction_force(int v) const { return rotation(vertices()) + v; }
  int reaction_moment(int v) const { return reaction_force(nodes_) + v; }
  int energy() const { return reaction_moment(nodes_); }
  int tendon_length(int tendon) const { return energy() + 1 + tendon; }
  int tension(int tendon) const { return tendon_length(tendons_) + tendon; }
  int count() const { return tension(tendons_); }

 private:
  int edges_, nodes_, tendons_;
  std::vector<int> first_{0};
};

}  // namespace pyrod
