// SPDX-License-Identifier: BSD-3-Clause
/// \file How the size of a turn is measured: by its angle, its chord or its tangent.
///
/// A discrete curvature is a turn per length, and for the angle θ of a turn there are three natural
/// sizes. All agree up to θ³ and give curvatures of second order; they differ at large angles:
///
///   log     θ               up to π between directions, 2π between quaternions
///   chord   2 sin(θ/2)      up to 2, at π, where its slope ends
///   cayley  2 tan(θ/2)      infinite at π: an energy made of it keeps neighbours from folding
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <numbers>
#include <string_view>

namespace pyrod {

enum class Measure { log, chord, cayley };

constexpr std::string_view name(Measure measure) {
  constexpr std::string_view names[] = {"log", "chord", "cayley"};
  return names[int(measure)];
}

/// The size of a turn by θ, |θ| ≤ π (for `log` any angle). At θ = π, `cayley` is infinite up to
/// rounding.
inline double measured(double θ, Measure measure) {
  switch (measure) {
    case Measure::chord:
      return 2 * std::sin(θ / 2);
    case Measure::cayley:
      return 2 * std::tan(θ / 2);
    default:
      return θ;
  }
}

/// The angle of a turn of the given size: the inverse. A chord longer than 2 does not exist: NaN.
inline double angle_of(double size, Measure measure) {
  switch (measure) {
    case Measure::chord:
      return 2 * std::asin(size / 2);
    case Measure::cayley:
      return 2 * std::atan(size / 2);
    default:
      return size;
  }
}

/// The turn W as a vector along its axis, of the measured size.
inline Vec3 measured(const Quaternion& W, Measure measure) {
  switch (measure) {
    case Measure::chord:
      return 2 * W.vec();
    case Measure::cayley:
      return 2 / W.w() * W.vec();
    default:
      return log(W);
  }
}

inline Vec1 measured(Angle a, Measure measure) { return Vec1(measured(a.radians, measure)); }

/// The turn whose measured vector is u: the inverse.
inline Quaternion turn_of(const Vec3& u, Measure measure) {
  switch (measure) {
    case Measure::chord: {
      const double x = u.squaredNorm() / 4;
      const bool half_turn = x > 1 && x < 1 + 1e-15;  // of a chord of 2, but for rounding
      return quaternion(half_turn ? 0 : std::sqrt(1 - x), u / 2);
    }
    case Measure::cayley:
      return quaternion(1, u / 2).normalized();
    default:
      return exp(u);
  }
}

inline Angle turn_of(const Vec1& u, Measure measure) { return {angle_of(u[0], measure)}; }

/// a followed by the turn whose measured vector is u; of unit length to rounding, always.
inline Quaternion turned(const Quaternion& a, const Vec3& u, Measure measure) {
  return (a * turn_of(u, measure)).normalized();
}
inline Angle turned(Angle a, const Vec1& u, Measure measure) { return a * turn_of(u, measure); }

}  // namespace pyrod
