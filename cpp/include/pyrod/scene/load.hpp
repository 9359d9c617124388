// SPDX-License-Identifier: BSD-3-Clause
/// \file What acts on rods: forces and moments, fixed in space or following the rod.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/place.hpp>

#include <variant>

namespace pyrod {

/// A force [N] on one point of a rod. A follower turns with the rod, and its components are those
/// of the frame there; else it is dead, fixed in space. A follower has no potential.
struct Force {
  Vec3 force;
  Place at = End::end;
  bool follower = false;
};

/// A moment [N m] on one cross-section. In space neither a dead one nor a follower has a potential.
struct Moment {
  Vec3 moment;
  Place at = End::end;
  bool follower = false;
};

/// A force per length at rest [N/m]: one for all, one per edge, or a function of arc length, which
/// is taken at the centres of the edges.
struct DistributedForce {
  Along<Vec3> force_per_length;
  int rod = 0;
  bool follower = false;
};

/// A moment per length at rest [N].
struct DistributedMoment {
  Along<Vec3> moment_per_length;
  int rod = 0;
  bool follower = false;
};

/// The weight of all rods whose sections have a mass per length.
struct Gravity {
  Vec3 acceleration = {0, 0, -9.81};  ///< [m/s²]
};

using Load = std::variant<Force, Moment, DistributedForce, DistributedMoment, Gravity>;

}  // namespace pyrod
