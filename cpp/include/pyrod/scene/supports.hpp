// SPDX-License-Identifier: BSD-3-Clause
/// \file What holds rods. Positions and frames that are not told are those at rest.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/frame_along.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/place.hpp>

#include <cmath>
#include <optional>
#include <tuple>
#include <utility>
#include <variant>

namespace pyrod {

/// Holds a cross-section in position and frame.
struct Clamp {
  std::optional<Vec3> position = {};
  std::optional<Quaternion> frame = {};
  Place at = End::start;
  int turns = 0;  ///< full turns about a3 put into the rod since the support before

  static constexpr const char* kind = "Clamp";
  static constexpr auto fields() {
    return std::tuple{Field{"position", &Clamp::position}, Field{"frame", &Clamp::frame},
                      Field{"at", &Clamp::at}, Field{"turns", &Clamp::turns}};
  }
};

/// Holds the position of a point of the rod, which may turn in every way.
struct Hinge {
  std::optional<Vec3> position = {};
  Place at = End::start;

  static constexpr const char* kind = "Hinge";
  static constexpr auto fields() {
    return std::tuple{Field{"position", &Hinge::position}, Field{"at", &Hinge::at}};
  }
};

/// Lets a point slide along a line, or in the plane across `normal`; one of them is given. The rod
/// may turn, unless it is clamped or its frame given.
struct Slider {
  std::optional<Vec3> along = {}, normal = {};
  std::optional<Vec3> position = {};
  std::optional<Quaternion> frame = {};
  bool clamped = false;
  Place at = End::end;

  static constexpr const char* kind = "Slider";
  static constexpr auto fields() {
    return std::tuple{Field{"along", &Slider::along},       Field{"normal", &Slider::normal},
                      Field{"position", &Slider::position}, Field{"frame", &Slider::frame},
                      Field{"clamped", &Slider::clamped},   Field{"at", &Slider::at}};
  }
};

/// Holds the frame of a cross-section, which may slide along its a3.
struct Sleeve {
  std::optional<Vec3> position = {};
  std::optional<Quaternion> frame = {};
  Place at = End::start;

  static constexpr const char* kind = "Sleeve";
  static constexpr auto fields() {
    return std::tuple{Field{"position", &Sleeve::position}, Field{"frame", &Sleeve::frame},
                      Field{"at", &Sleeve::at}};
  }
};

/// Holds a position, and lets the cross-section turn about one axis only; `along`: the pin may
/// slide.
struct Pivot {
  Vec3 axis;  ///< in space
  std::optional<Vec3> position = {};
  std::optional<Quaternion> frame = {};  ///< before it turns
  Place at = End::start;
  std::optional<Vec3> along = {};

  static constexpr const char* kind = "Pivot";
  static constexpr auto fields() {
    return std::tuple{Field{"axis", &Pivot::axis}, Field{"position", &Pivot::position},
                      Field{"frame", &Pivot::frame}, Field{"at", &Pivot::at},
                      Field{"along", &Pivot::along}};
  }
};

/// Draws a point towards a position, and its cross-section towards a frame.
struct Spring {
  double stiffness = 0, torsion = 0;  ///< [N/m] in every direction, [N m] about every axis
  std::optional<Vec3> position = {};
  std::optional<Quaternion> frame = {};
  Place at = End::end;

  static constexpr const char* kind = "Spring";
  static constexpr auto fields() {
    return std::tuple{Field{"stiffness", &Spring::stiffness}, Field{"torsion", &Spring::torsion},
                      Field{"position", &Spring::position}, Field{"frame", &Spring::frame},
                      Field{"at", &Spring::at}};
  }
};

using Support = std::variant<Clamp, Hinge, Slider, Sleeve, Pivot, Spring>;

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

// What supports have in common.
inline const Place& place_of(const Support& support) {
  return std::visit([](const auto& s) -> const Place& { return s.at; }, support);
}
inline const std::optional<Vec3>& position_of(const Support& support) {
  return std::visit([](const auto& s) -> const auto& { return s.position; }, support);
}
inline std::optional<Quaternion> frame_of(const Support& support) {
  return std::visit(
      [](const auto& s) -> std::optional<Quaternion> {
        if constexpr (requires { s.frame; }) return s.frame;
        return std::nullopt;
      },
      support);
}
inline const char* kind_of(const Support& support) {
  return std::visit([](const auto& s) { return s.kind; }, support);
}
inline Hold hold(const Support& support, const Quaternion& q) {
  return std::visit([&](const auto& s) { return hold(s, q); }, support);
}

}  // namespace pyrod
