// SPDX-License-Identifier: BSD-3-Clause
/// \file A position and a frame.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/unit.hpp>

namespace pyrod {

/// Where the start of a rod is at rest; where a planar computation lies in space: its origin, and
/// the frame whose a1 and a3 span the plane.
template <class Space>
struct Placement {
  Point<Space> position = Point<Space>::Zero();
  typename Space::Rotation frame = Space::Rotation::Identity();
};

}  // namespace pyrod
