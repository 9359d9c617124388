// SPDX-License-Identifier: BSD-3-Clause
/// \file What joins rods to each other, and the ends of one rod to a ring.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/scene/place.hpp>

#include <optional>
#include <tuple>
#include <vector>

namespace pyrod {

/// rigid: cross-sections keep the angles to each other that they have at rest; hinge: all others
/// may turn about one axis against the first; ball: they share the point only.
enum class JointKind { rigid, hinge, ball };

struct Joint {
  std::vector<Place> points;  ///< two or more
  JointKind kind = JointKind::rigid;
  int turns = 0;  ///< full turns about a3 that the rod of the last point makes from its support
                  ///< before, besides what the frames tell: the twist that is put into a ring
  /// The frames of the points become one, whatever they are at rest; default: where the points of a
  /// rigid joint are not in one place at rest.
  std::optional<bool> aligned = {};
  std::optional<Vec3> axis = {};  ///< of a hinge, in space where the rods are at rest

  static constexpr auto fields() {
    return std::tuple{Field{"points", &Joint::points}, Field{"kind", &Joint::kind},
                      Field{"turns", &Joint::turns}, Field{"aligned", &Joint::aligned},
                      Field{"axis", &Joint::axis}};
  }
};

}  // namespace pyrod
