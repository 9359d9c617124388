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

/// A string that runs along a rod at an offset in its sections, without friction, and is pulled at
/// its start; its end is anchored there.
struct Tendon {
  /// From the axis, along the directors a1 and a2 [m]: one for all, one per vertex of the rod,
  /// straight between them in the rod's own frames; or a function of arc length.
  Along<Vec2> offset;
  double tension;                              ///< [N]
  std::optional<double> start = {}, end = {};  ///< arc lengths; none: the rod's ends
  int rod = 0;
  std::vector<double> kinks = {};  ///< arc lengths at which a function has kinks; found if needed

  static constexpr const char* kind = "Tendon";
  static constexpr auto fields() {
    return std::tuple{Field{"offset", &Tendon::offset}, Field{"tension", &Tendon::tension},
                      Field{"start", &Tendon::start}, Field{"end", &Tendon::end},
                      Field{"rod", &Tendon::rod}};
  }

  double begins() const { return start.value_or(0); }
  double ends(double length) const { return end.value_or(length); }

  /// Refuses what is no tendon of a rod so long.
  void check(double length) const {
    require(std::isfinite(tension) && tension > 0, "tension: must be positive and finite, got ",
            tension);
    const double from = begins(), to = ends(length);
    const bool inside = from >= -1e-12 * length && to <= length * (1 + 1e-12);
    require(inside && from < to, "start, end: must be arc lengths on the rod, in [0, ", length,
            "], in their order, got ", from, " and ", to);
    if (const auto* one = std::get_if<Vec2>(&offset))
      require(one->allFinite(), "offset: expected finite numbers, got ", one->transpose());
  }
};

using Actuator = std::variant<Tendon>;

}  // namespace pyrod
