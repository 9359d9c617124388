// SPDX-License-Identifier: BSD-3-Clause
/// \file Rods that meet in nodes: who hangs on whom, who is held, what acts where.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/placement.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace pyrod {

/// A point where rods meet or are held. Free unless told otherwise.
template <class Space>
struct Node {
  Point<Space> position = Point<Space>::Zero();  ///< where it is held, or where it starts
  Directions<Space::dim> free = Mat<Space::dim>::Identity();  ///< orthonormal; none: held
  typename Space::Rotation frame = Space::Rotation::Identity();
  Directions<Space::spin> turns = Mat<Space::spin>::Identity();  ///< material axes; none: held
  Point<Space> force = Point<Space>::Zero();                     ///< dead
  Spin<Space> moment = Spin<Space>::Zero();                      ///< dead
  Spin<Space> follower_moment = Spin<Space>::Zero();             ///< in the components of the frame
  double spring = 0;          ///< stiffness [N/m] that draws it towards `position`
  double torsion_spring = 0;  ///< stiffness [N m] that turns it towards `frame`
  bool parts_cell = false;    ///< something ends there: the halves of a cell on it are not alike
};

/// A vertex of a rod that hangs on a node: by its position alone, or rigidly with its frame, which
/// then is the node's followed by `relative`. A hinge lets it turn about one axis in between.
template <class Space>
struct Attachment {
  int rod, vertex, node;
  bool rigid;
  typename Space::Rotation relative = Space::Rotation::Identity();
  int turns = 0;  ///< full turns about a3 that the rod makes from the attachment before to this one
  std::optional<Spin<Space>>
      hinge{};            ///< axis, a unit vector in the components of the node's frame
  int hinge_number = -1;  ///< given by the layout
};

/// Everything that a scene consists of. Ends of rods without an attachment are free.
template <class Space>
struct Network {
  std::vector<Rod<Space>> rods;
  std::vector<Placement<Space>> placements;  ///< one per rod
  std::vector<Loads<Space>> loads;           ///< one per rod
  std::vector<Node<Space>> nodes;
  std::vector<Attachment<Space>> attachments;
  std::vector<RoutedTendon> tendons = {};

  /// Refuses what is no network, naming what is wrong and where. Attachments may be in any order.
  void check() const {
    check_places();
    for (std::size_t i = 0; i < rods.size(); ++i) check_rod(i);
    check_nodes();
    for (const auto& a : attachments) check_attachment(a);
    for (std::size_t i = 0; i < tendons.size(); ++i) check_tendon(tendons[i], i);
  }

  void check_nodes() const {
    for (std::size_t v = 0; v < nodes.size(); ++v) check_node(nodes[v], v);
  }

  /// Whether nodes and attachments differ in nothing but positions and frames of nodes. In space.
  bool differs_in_places_only(const Network& other) const {
    return std::ranges::equal(nodes, other.nodes, same_but_for_place) &&
           std::ranges::equal(attachments, other.attachments, same_attachment);
  }

  /// What must hold before anything is looked up: counts, and who hangs where.
  void check_places() const {
    require(!rods.empty(), "rods: expected at least one");
    require_count(Eigen::Index(placements.size()), Eigen::Index(rods.size()), "placements",
                  "one per rod");
    require_count(Eigen::Index(loads.size()), Eigen::Index(rods.size()), "loads", "one per rod");
    for (const auto& a : attachments) {
      require(a.rod >= 0 && a.rod < int(rods.size()), "attachment: no rod ", a.rod);
      require(a.node >= 0 && a.node < int(nodes.size()), "attachment: no node ", a.node);
      require(a.vertex >= 0 && a.vertex < rods[a.rod].grid.vertices(), "attachment: rod ", a.rod,
              " has no vertex ", a.vertex);
    }
  }

 private:
  static bool same_but_for_place(const Node<Space>& a, const Node<Space>& b) {
    return same(a.free, b.free) && same(a.turns, b.turns) && a.force == b.force &&
           a.moment == b.moment && a.follower_moment == b.follower_moment && a.spring == b.spring &&
           a.torsion_spring == b.torsion_spring && a.parts_cell == b.parts_cell;
  }
  template <class D>
  static bool same(const D& a, const D& b) {
    return a.cols() == b.cols() && a == b;
  }
  static bool same_attachment(const Attachment<Space>& a, const Attachment<Space>& b) {
    return a.rod == b.rod && a.vertex == b.vertex && a.node == b.node && a.rigid == b.rigid &&
           a.relative.coeffs() == b.relative.coeffs() && a.turns == b.turns && a.hinge == b.hinge;
  }

  void check_rod(std::size_t i) const {
    try {
      rods[i].check();
      loads[i].check(rods[i].edges());
    } catch (const InvalidArgument& refused) {
      if (rods.size() == 1) throw;
      throw InvalidArgument(text("rod ", i, ": ", refused.what()));
    }
    require(placements[i].position.allFinite(), "placements[", i,
            "].position: expected finite numbers, got ", placements[i].position.transpose());
    require_rotation(placements[i].frame, "placements[", i, "].frame");
  }

  static void check_node(const Node<Space>& node, std::size_t v) {
    const auto finite = [v](const auto& numbers, const char* name) {
      require(numbers.allFinite(), "nodes[", v, "].", name, ": expected finite numbers, got ",
              numbers.transpose());
    };
    finite(node.position, "position"), finite(node.force, "force"), finite(node.moment, "moment");
    finite(node.follower_moment, "follower_moment");
    require_rotation(node.frame, "nodes[", v, "].frame");
    require_orthonormal(node.free, "nodes[", v, "].free");
    require_orthonormal(node.turns, "nodes[", v, "].turns");
    const auto stiffness = [v](double value, const char* name) {
      require(std::isfinite(value) && value >= 0, "nodes[", v, "].", name,
              ": a stiffness must be finite and not negative, got ", value);
    };
    stiffness(node.spring, "spring"), stiffness(node.torsion_spring, "torsion_spring");
  }

  void check_tendon(const RoutedTendon& tendon, std::size_t i) const {
    require(tendon.rod >= 0 && tendon.rod < int(rods.size()), "tendons[", i, "]: no rod ",
            tendon.rod);
    const auto& rod = rods[std::size_t(tendon.rod)];
    require(!rod.grid.closed() && tendon.first >= 0 && tendon.first < tendon.last &&
                tendon.last <= rod.edges(),
            "tendons[", i, "]: expected two vertices of an open rod, in their order, got ",
            tendon.first, " and ", tendon.last);
    check_length(tendon, i);
    require(std::isfinite(tendon.tension) && tendon.tension >= 0, "tendons[", i,
            "].tension: must be finite and not negative, got ", tendon.tension);
    for (const auto& C : rod.stretching)
      require(C.array().isInf().all(), "tendons[", i, "]: rod ", tendon.rod,
              " stretches or shears, and tendons need one that keeps its length; choose the "
              "inextensible model");
  }

  /// The end of one of given length must be held, or feel no moment: its half cell would change
  /// with the tension as well as with the moment.
  void check_length(const RoutedTendon& tendon, std::size_t i) const {
    if (!tendon.length) return;
    require(std::isfinite(*tendon.length) && *tendon.length > 0, "tendons[", i,
            "].length: must be positive and finite, got ", *tendon.length);
    require(std::isfinite(tendon.softness) && tendon.softness >= 0, "tendons[", i,
            "]: its stiffness must be positive");
    require(tendon.largest_offset() > 0, "tendons[", i,
            "]: one on the axis of a rod that keeps its length has that length; give its tension");
    const auto& on = loads[std::size_t(tendon.rod)];
    require(
        on.start_moment.isZero(0) && on.end_moment.isZero(0) && on.follower_end_moment.isZero(0),
        "tendons[", i,
        "]: beside one of given length no moment may act on an end of its rod; give its "
        "tension");
  }

  static void check_attachment(const Attachment<Space>& a) {
    require_rotation(a.relative, "attachment of vertex ", a.vertex, " of rod ", a.rod,
                     ": relative");
    if (a.hinge)
      require(std::abs(a.hinge->squaredNorm() - 1) < 2 * unit_rounding, "attachment of vertex ",
              a.vertex, " of rod ", a.rod, ": hinge: expected an axis of length 1, got ",
              a.hinge->transpose());
  }
};

}  // namespace pyrod
