// SPDX-License-Identifier: BSD-3-Clause
/// \file The turn from one edge to the next: angle, binormal, and the rotation B that joins them.
#pragma once

#include <pyrod/core/products.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/series.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace pyrod {

/// Angle of the point (cosine, sine) in (−π, π], in any common scale; π itself is positive, also
/// where rounding has left a negative zero of a sine.
inline double signed_angle(double sine, double cosine) {
  const double size = std::abs(sine);
  if (cosine > 4 * size) return std::copysign(half_angle_ratio(size, cosine) * size, sine);
  if (cosine < 0 && size <= 8 * std::numeric_limits<double>::epsilon() * -cosine)
    return std::numbers::pi;
  return std::atan2(sine, cosine);
}

/// The least rotation that takes direction a to direction b; neither needs unit length.
///
/// The sine is computed without cancellation, so θ keeps all its digits near 0, and so does π − θ
/// near π.
class Turning {
 public:
  Turning(const Vec3& a, const Vec3& b)
      : product_(accurate_cross(a, b)), sine_(product_.norm()), cosine_(a.dot(b)) {}

  /// θ in [0, π], the turning angle of Linn (3).
  double angle() const { return signed_angle(sine_, cosine_); }

  /// No axis can be told: the directions agree within the angle `tolerance` [rad].
  bool straight(double tolerance) const { return cosine_ > 0 && sine_ <= tolerance * cosine_; }
  /// They are opposite within `tolerance`: every axis across them would do (Linn, note 9).
  bool antiparallel(double tolerance) const {
    return cosine_ <= 0 && sine_ <= tolerance * -cosine_;
  }

  /// The binormal, unit axis of the turn; only where it is not straight.
  Vec3 binormal() const { return product_ / sine_; }

  /// B, the rotation about the binormal by θ (Linn 6.2.1).
  Quaternion rotation() const {
    const double scale = std::sqrt(sine_ * sine_ + cosine_ * cosine_);
    const double s = sine_ / scale, c = cosine_ / scale;
    if (c >= 0) {
      const double w = std::sqrt((1 + c) / 2);
      return quaternion(w, product_ / (2 * w * scale));
    }
    const double v = std::sqrt((1 - c) / 2);  // sin(θ/2)
    return quaternion(s / (2 * v), (v / sine_) * product_);
  }

 private:
  Vec3 product_;
  double sine_, cosine_;
};

}  // namespace pyrod
