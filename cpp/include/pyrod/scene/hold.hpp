// SPDX-License-Identifier: BSD-3-Clause
/// \file What supports make of the nodes that they hold.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/frame_along.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/supports.hpp>

#include <cmath>
#include <utility>
#include <variant>

namespace pyrod {

/// What a support makes of the node that it holds.
struct Hold {
  bool frame = true;                                  ///< it takes hold of the frame
  Directions<3> free = nowhere(), turns = nowhere();  ///< in space; material
  double spring = 0, torsion_spring = 0;

  static Directions<3> nowhere() { return Directions<3>(3, 0); }
  static Directions<3> everywhere() { return Mat3::Identity(); }
};

/// The frame that is held: `q`.
inline Hold hold(const Clamp&, const Quaternion&) { return {}; }
inline Hold hold(const Hinge&, const Quaternion&) {
  return {.frame = false, .turns = Hold::everywhere()};
}
inline Hold hold(const Slider& slider, const Quaternion&) {
  require(slider.along.has_value() != slider.normal.has_value(),
          "along: give either it or the normal of a plane");
  const bool held = slider.clamped || slider.frame;
  Hold out{.frame = held, .turns = held ? Hold::nowhere() : Hold::everywhere()};
  if (slider.along)
    out.free = direction(*slider.along, "along");
  else
    out.free = detail::without<3>(Hold::everywhere(), direction(*slider.normal, "normal"));
  return out;
}
inline Hold hold(const Sleeve&, const Quaternion& q) { return {.free = rotate(q, Vec3::UnitZ())}; }
inline Hold hold(const Pivot& pivot, const Quaternion& q) {
  Hold out{.turns = unrotate(q, direction(pivot.axis, "axis"))};
  if (pivot.along) out.free = direction(*pivot.along, "along");
  return out;
}
inline Hold hold(const Spring& spring, const Quaternion&) {
  for (const auto& [value, name] :
       {std::pair(spring.stiffness, "stiffness"), std::pair(spring.torsion, "torsion")})
    require(std::isfinite(value) && value >= 0, name, ": must be finite and not negative, got ",
            value);
  return {spring.torsion > 0, Hold::everywhere(), Hold::everywhere(), spring.stiffness,
          spring.torsion};
}

inline Hold hold(const Support& support, const Quaternion& q) {
  return std::visit([&](const auto& s) { return hold(s, q); }, support);
}

}  // namespace pyrod
