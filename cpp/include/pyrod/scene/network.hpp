// SPDX-License-Identifier: BSD-3-Clause
/// \file Rods that meet in nodes: who hangs on whom, who is held, what acts where.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/statics/loads.hpp>

#include <optional>

namespace pyrod {

/// Up to N independent directions, as columns.
template <int N>
using Directions =
    Eigen::Matrix<double, N, Eigen::Dynamic, N == 1 ? Eigen::RowMajor : Eigen::ColMajor, N, N>;

/// A point where rods meet or are held. Free unless told otherwise.
template <class Space>
struct Node {
  Point<Space> position = Point<Space>::Zero();  ///< where it is held, or where it starts
  Directions<Space::dim> free = Mat<Space::dim>::Identity();  ///< orthonormal; none: held
  typename Space::Rotation frame = Space::Rotation::Identity();
  Directions<Space::spin> turns = Mat<Space::spin>::Identity();  ///< material axes; none: held
  Point<Space> force = Point<Space>::Zero();                     ///< dead
  Spin<Space> moment = Spin<Space>::Zero();                      ///< dead
  double spring = 0;          ///< stiffness [N/m] that draws it towards `position`
  double torsion_spring = 0;  ///< stiffness [N m] that turns it towards `frame`
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

/// Where the start of a rod is at rest.
template <class Space>
struct Placement {
  Point<Space> position = Point<Space>::Zero();
  typename Space::Rotation frame = Space::Rotation::Identity();
};

/// Everything that a scene consists of. Ends of rods without an attachment are free.
template <class Space>
struct Network {
  std::vector<Rod<Space>> rods;
  std::vector<Placement<Space>> placements;  ///< one per rod
  std::vector<Loads<Space>> loads;           ///< one per rod
  std::vector<Node<Space>> nodes;
  std::vector<Attachment<Space>> attachments;
};

}  // namespace pyrod
