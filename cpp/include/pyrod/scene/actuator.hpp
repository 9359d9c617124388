// SPDX-License-Identifier: BSD-3-Clause
/// \file What drives rods from inside.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/scene/along.hpp>

#include <cmath>
#include <optional>
#include <tuple>
#include <variant>
#include <vector>

namespace pyrod {

/// A string that runs along a rod at an offset in its sections, without friction. Its end is
/// anchored; at its start it is pulled with a tension, or held so that it has a length.
struct Tendon {
  /// From the axis, along the directors a1 and a2 [m]: one for all, one per vertex of the rod,
  /// straight between them in the rod's own frames; or a function of arc length.
  Along<Vec2> offset;
  std::optional<double> tension = {};          ///< [N]
  std::optional<double> length = {};           ///< [m], in its place: that without tension
  std::optional<double> EA = {};               ///< [N], with a length; none: it does not stretch
  std::optional<double> start = {}, end = {};  ///< arc lengths; none: the rod's ends
  int rod = 0;
  std::vector<double> kinks = {};  ///< arc lengths at which a function has kinks; found if needed

  static constexpr const char* kind = "Tendon";
  static constexpr auto fields() {
    return std::tuple{Field{"offset", &Tendon::offset}, Field{"tension", &Tendon::tension},
                      Field{"length", &Tendon::length}, Field{"EA", &Tendon::EA},
                      Field{"start", &Tendon::start},   Field{"end", &Tendon::end},
                      Field{"rod", &Tendon::rod}};
  }

  double begins() const { return start.value_or(0); }
  double ends(double rod_length) const { return end.value_or(rod_length); }

  /// Refuses what is no tendon of a rod so long.
  void check(double rod_length) const {
    require(tension.has_value() != length.has_value(),
            "tension: give a tendon its tension or its length");
    check_positive(tension, "tension"), check_positive(length, "length"), check_positive(EA, "EA");
    require(!EA || length, "EA: goes with the length of a tendon, not with its tension");
    const double from = begins(), to = ends(rod_length);
    const bool inside = from >= -1e-12 * rod_length && to <= rod_length * (1 + 1e-12);
    require(inside && from < to, "start, end: must be arc lengths on the rod, in [0, ", rod_length,
            "], in their order, got ", from, " and ", to);
    if (const auto* one = std::get_if<Vec2>(&offset))
      require(one->allFinite(), "offset: expected finite numbers, got ", one->transpose());
  }

 private:
  static void check_positive(const std::optional<double>& value, const char* name) {
    if (value)
      require(std::isfinite(*value) && *value > 0, name, ": must be positive and finite, got ",
              *value);
  }
};

using Actuator = std::variant<Tendon>;

}  // namespace pyrod
