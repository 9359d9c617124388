// SPDX-License-Identifier: BSD-3-Clause
/// \file Shapes between two held points of a rod.
///
/// The frames turn evenly from the one to the other, twist spread along the way, and a bow as high
/// as the shortening asks is laid over that: θ = A sin(2πs) and its likes have the chord of
/// theory (20).
#pragma once

#include <pyrod/curve/cosserat.hpp>
#include <pyrod/curve/framing.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <cmath>
#include <numbers>
#include <vector>

namespace pyrod {

template <class Space>
struct Bow {
  using Rotation = typename Space::Rotation;

  /// A held point of a rod; `frame` is one of the two if it is clamped, see `clamped`.
  struct Anchor {
    int vertex;
    Point<Space> position;
    bool clamped;
    Rotation frame;
    int turns;
  };

  /// q(x), 0 ≤ x ≤ 1, evenly from one frame to the other: a3 along a great circle, and the twist
  /// about it with the full turns.
  struct Way {
    Rotation from;
    Spin<Space> swing, twist;

    Rotation at(double x) const {
      return moved(moved(from, Spin<Space>(x * swing)), Spin<Space>(x * twist));
    }
  };

  static Way way(const Quaternion& from, const Quaternion& to, int turns) {
    Quaternion W = principal(from.conjugate() * to);
    const double ψ = twist_angle(W);
    const Quaternion swing = W * exp(Vec3(0, 0, -ψ));
    return {from, log(principal(swing)), Vec3(0, 0, ψ + 2 * std::numbers::pi * turns)};
  }

  static Way way(Angle from, Angle to, int turns) {
    const double swing = principal(from.conjugate() * to).radians;
    return {from, Vec1(swing + 2 * std::numbers::pi * turns), Vec1(0.)};
  }

  /// Frames of the edges that lead from one frame to the other: evenly where the rod is straight at
  /// rest; else the frames at rest, turned by a share of what is missing at the end.
  static std::vector<Rotation> between_anchors(const Rod<Space>& r, const Anchor& a,
                                               const Anchor& b, const Rotation& from,
                                               const Rotation& to) {
    const double start = r.grid.s(a.vertex), length = r.grid.s(b.vertex) - start;
    std::vector<Rotation> rest;
    Rotation q = from;
    double bent = 0;
    for (int j = a.vertex; j < b.vertex; ++j) {
      const double cell = j == a.vertex ? r.grid.h(j) / 2 : r.grid.Δs(j);
      bent += cell * r.K0[j].norm();
      rest.push_back(q = moved(q, Spin<Space>(cell * r.K0[j])));
    }
    const Rotation end =
        moved(q, Spin<Space>(r.grid.h(b.vertex - 1) / 2 * r.K0[b.vertex % r.grid.vertices()]));
    const bool straight = bent < 0.1;
    const Way path = straight ? way(from, to, b.turns) : Way{};
    const Spin<Space> missing = log(principal(to * end.conjugate()));
    for (int j = a.vertex; j < b.vertex; ++j) {
      const double x = (r.grid.centre(j) - start) / length;
      Rotation& base = rest[j - a.vertex];
      base = straight ? path.at(x)
                      : twisted(exp(Spin<Space>(x * missing)) * base,
                                2 * std::numbers::pi * x * b.turns);
    }
    return rest;
  }

  /// The shape at rest, moved as a whole to where it is clamped.
  static CosseratCurve<Space> carried(const Rod<Space>& rod, const CosseratCurve<Space>& rest,
                                      const Anchor& a) {
    const Rotation there = vertex_frame(rod.grid, rest, a.vertex);
    const Rotation move = a.frame * there.conjugate();
    const Rotation start = move * rest.start_frame;
    const Point<Space> r0 =
        a.position + rotate(move, Point<Space>(rest.positions[0] - rest.positions[a.vertex]));
    return rod.at_rest(r0, start);
  }

  static bool fits(const Rod<Space>& rod, const CosseratCurve<Space>& rest,
                   const std::vector<Anchor>& held) {
    for (const auto& a : held) {
      const int j = std::min(a.vertex, int(rest.positions.size()) - 1);
      if ((rest.positions[j] - a.position).norm() > 1e-9 * rod.grid.length() && held.size() > 1)
        return false;
      const Rotation W = vertex_frame(rod.grid, rest, a.vertex).conjugate() * a.frame;
      if (a.clamped && log(principal(W)).norm() > 1e-9) return false;
    }
    return true;
  }

  static Quaternion twisted(const Quaternion& q, double ψ) { return moved(q, Vec3(0, 0, ψ)); }

  static Angle twisted(Angle a, double ψ) { return {a.radians + ψ}; }

  /// The angle along a bow, of mean zero: it vanishes at clamped ends.
  static double profile(double x, bool start, bool end) {
    constexpr double π = std::numbers::pi;
    if (start && end) return std::sin(2 * π * x);
    if (!start && !end) return std::cos(π * x);
    const double y = start ? x : 1 - x;
    return (start ? 4 : -4) * y * (1 - 1.5 * y);
  }

  /// The turn that brings the mean direction into that of the chord, none where they agree.
  static Spin<Space> tilt_towards(const Point<Space>& t, const Point<Space>& chord, double length) {
    if (chord.norm() < 1e-6 * length) return Spin<Space>::Zero();
    const Spin<Space> axis = cross(t, chord);
    const double sine = axis.norm(), angle = std::atan2(sine, t.dot(chord));
    if (sine < 1e-12 * length) return Spin<Space>::Zero();
    return axis * (angle / sine);
  }

  static Vec3 lever(const Vec3& κ, const Vec3& t) { return κ.cross(t); }

  static Vec2 lever(const Vec1& κ, const Vec2& t) { return κ[0] * Vec2(t[1], -t[0]); }

  static Vec3 soft_direction(const Vec3& C) { return C[1] <= C[0] ? Vec3::UnitX() : Vec3::UnitY(); }

  static Vec2 soft_direction(const Vec1&) { return Vec2::UnitX(); }

  /// q with the sign that is nearer to the frame before.
  static Quaternion continued(const Quaternion& before, const Quaternion& q) {
    return before.dot(q) < 0 ? Quaternion(-q.coeffs()) : q;
  }

  static Angle continued(Angle before, Angle q) {
    return {before.radians + principal(before.conjugate() * q).radians};
  }

  static Vec3 any_across(const Vec3& t) { return t.unitOrthogonal(); }

  static Vec2 any_across(const Vec2& t) { return {t[1], -t[0]}; }

  static Quaternion turned_towards(const Quaternion& q, const Vec3& t) { return adapted(q, t); }

  static Angle turned_towards(Angle a, const Vec2& t) {
    const Vec2 local = unrotate(a, t);
    return {a.radians + std::atan2(local[0], local[1])};
  }
};

}  // namespace pyrod
