// SPDX-License-Identifier: BSD-3-Clause
/// \file What may change of a network in equilibrium, as numbered items: its state, and the numbers
/// that it is made of.
#pragma once

#include <pyrod/linear/block_map.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// Room of an item: a point or a turn.
template <class Space>
inline constexpr int item_width = std::max(Space::dim, Space::spin);
template <class Space>
using Items = ItemsOf<item_width<Space>>;
template <class Space>
using ItemMap = BlockMap<item_width<Space>>;

/// Attachments of all rods, one after another.
template <class Space>
class AttachmentNumbers {
 public:
  explicit AttachmentNumbers(const Layout<Space>& layout) {
    for (int rod = 0; rod < int(layout.network().rods.size()); ++rod)
      first_.push_back(first_.back() + int(layout.attached(rod).size()));
  }
  int of(int rod, int i) const { return first_[rod] + i; }
  int count() const { return first_.back(); }

 private:
  std::vector<int> first_{0};
};

/// Changes of the state, and of the residual where they act: turns and moments in the components of
/// the frame, forces and places in those of the computation.
template <class Space>
class StateItems {
 public:
  explicit StateItems(const Layout<Space>& layout)
      : edges_(layout.edges()),
        nodes_(int(layout.network().nodes.size())),
        hinges_(layout.hinges()),
        attached_(AttachmentNumbers<Space>(layout).count()),
        spans_(int(layout.spans().size())),
        tendons_(int(layout.network().tendons.size())) {}

  int turn(int e) const { return e; }
  int force(int e) const { return edges_ + e; }  ///< the section force
  int node_turn(int v) const { return 2 * edges_ + v; }
  int place(int v) const { return node_turn(nodes_) + v; }  ///< the residual: balance of forces
  int load(int v) const { return place(nodes_) + v; }       ///< all forces that act on a node
  int hinge(int i) const { return load(nodes_) + i; }
  int held(int a) const { return hinge(hinges_) + a; }  ///< the frame that holds a rod
  int gap(int p) const { return held(attached_) + p; }  ///< of a span; the state: its multiplier
  int tendon(int i) const { return gap(spans_) + i; }   ///< the gap of one of given length; tension
  int count() const { return tendon(tendons_); }

 private:
  int edges_, nodes_, hinges_, attached_, spans_, tendons_;
};

enum class Side { before, behind };

/// The numbers of a network.
template <class Space>
class NumberItems {
 public:
  explicit NumberItems(const Layout<Space>& layout)
      : edges_(layout.edges()),
        nodes_(int(layout.network().nodes.size())),
        attached_(AttachmentNumbers<Space>(layout).count()),
        rods_(int(layout.network().rods.size())),
        tendons_(int(layout.network().tendons.size())) {
    for (const auto& rod : layout.network().rods)
      vertices_.push_back(vertices_.back() + rod.edges() + 1);
  }

  int stiffness(int e) const { return e; }                ///< C/Δs of the cell at its start
  int rest(int e) const { return edges_ + e; }            ///< Δs K0
  int length(int e) const { return 2 * edges_ + e; }      ///< h
  int compliance(int e) const { return 3 * edges_ + e; }  ///< S
  int moment(int e) const { return 4 * edges_ + e; }      ///< dead
  int following(int e) const { return 5 * edges_ + e; }   ///< a moment in the frame
  int of_edges() const { return 6 * edges_; }             ///< all these
  int stiffness(int a, Side s) const { return 6 * edges_ + 2 * a + int(s); }
  int rest(int a, Side s) const { return 6 * edges_ + 2 * (attached_ + a) + int(s); }
  int relative(int a) const { return 6 * edges_ + 4 * attached_ + a; }
  int position(int v) const { return relative(attached_) + v; }
  int frame(int v) const { return position(nodes_) + v; }
  int node_moment(int v) const { return frame(nodes_) + v; }
  int node_following(int v) const { return node_moment(nodes_) + v; }
  int spring(int v) const { return node_following(nodes_) + v; }
  int torsion(int v) const { return spring(nodes_) + v; }
  /// Of the half cells at ends that turn freely.
  int end_stiffness(int rod, Side s) const { return torsion(nodes_) + 2 * rod + int(s); }
  int end_rest(int rod, Side s) const {
    return end_stiffness(rods_, Side::before) + 2 * rod + int(s);
  }
  int end_moment(int rod, Side s) const { return end_rest(rods_, Side::before) + 2 * rod + int(s); }
  int end_following(int rod) const { return end_moment(rods_, Side::before) + rod; }
  int force(int rod, int vertex) const { return end_following(rods_) + vertices_[rod] + vertex; }
  int tendon(int i) const { return force(rods_, 0) + i; }  ///< its tension, or its given length
  int count() const { return tendon(tendons_); }

 private:
  int edges_, nodes_, attached_, rods_, tendons_;
  std::vector<int> vertices_{0};  ///< first of each rod
};

}  // namespace pyrod
