// SPDX-License-Identifier: BSD-3-Clause
/// \file Polygons for tests: regular, sampled from smooth curves, random.
#pragma once

#include "support/random.hpp"

#include <numbers>
#include <vector>

namespace pyrod::test {

using Points = std::vector<Vec3>;

/// A curve at n equal steps of its parameter from 0 to `end`; closed: without the last sample.
template <class Curve>
Points points(const Curve& curve, double end, int n, Closure closure = Closure::open) {
  Points out;
  for (int j = 0; j < n + (closure == Closure::open); ++j) out.push_back(curve(end * j / n));
  return out;
}

template <class Curve>
Points loop(const Curve& curve, int n) {
  return points(curve, 2 * std::numbers::pi, n, Closure::closed);
}

inline Points regular_polygon(int n, double radius = 1) {
  return loop([&](double t) { return Vec3(radius * std::cos(t), radius * std::sin(t), 0); }, n);
}

/// On a torus about the z axis, `around` times about the axis and `through` times about the core,
/// from the angle `start` there. Left-handed.
inline auto torus_curve(int around, int through, double R, double start = 0) {
  return [=](double t) {
    const double ρ = R + std::cos(through * t + start);
    return Vec3(ρ * std::cos(around * t), ρ * std::sin(around * t), std::sin(through * t + start));
  };
}

/// Edges in any direction, of lengths up to √3.
inline Points random_points(Random& random, int n) {
  Points out{random.vector<3>()};
  while (int(out.size()) < n) out.push_back(out.back() + random.vector<3>());
  return out;
}

template <class Map>
Points mapped(Points r, const Map& map) {
  for (Vec3& x : r) x = map(x);
  return r;
}

inline Points mirrored(const Points& r) {
  return mapped(r, [](const Vec3& x) { return Vec3(x.x(), x.y(), -x.z()); });
}

}  // namespace pyrod::test
