// SPDX-License-Identifier: BSD-3-Clause
/// \file What holds rods. Positions and frames that are not told are those at rest.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/place.hpp>

#include <optional>
#include <tuple>
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

}  // namespace pyrod
