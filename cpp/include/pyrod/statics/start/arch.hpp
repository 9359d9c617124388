// SPDX-License-Identifier: BSD-3-Clause
/// \file The bow of one span between given directions at its ends.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/start/bow.hpp>

#include <array>
#include <cmath>
#include <numbers>

namespace pyrod {

/// The frames of a straight line, turned by the rotation vector θ(x), 0 ≤ x ≤ 1, across it: the
/// slopes of a cubic between α and β, and over these a bubble B sin 2πx as large as the way asks.
template <class Space>
class Arch {
 public:
  using Rotation = typename Space::Rotation;

  /// `axis`: about which bows turn. `reach`: the chord for unit length. `side`: 1 or −1, to which
  /// the bubble goes.
  Arch(const Point<Space>& along, const Spin<Space>& axis, double reach, const Point<Space>& start,
       const Point<Space>& end, int side)
      : start_(turn(along, start, axis)),
        end_(turn(along, end, axis)),
        bubble_(Spin<Space>::Zero()) {
    double flattest = 0;  // the bubble that leaves the most reach
    for (const auto& at : stations()) flattest -= 2 * θ(at).dot(axis) * at.bubble / count;
    bubble_ = flattest * axis;
    double B = 2 * std::sqrt(std::max(0., this->reach() - reach)), most = B;
    for (int i = 0; i < 4 && most > 0; ++i) {
      bubble_ = (flattest + side * B) * axis;
      const double slope = side * falling(axis);
      if (slope > -1e-3) break;
      B = std::clamp(B - (this->reach() - reach) / slope, most / 2, 2 * most);
    }
    bubble_ = (flattest + side * B) * axis;
  }

  /// As steep as a bow of this reach is by itself where it may turn.
  static double slope(double reach, bool other_end_clamped) {
    const double σ = 1 - reach;
    return other_end_clamped ? 3.9 * std::sqrt(σ) / (1 + 0.9 * σ) : 2 * std::sqrt(σ);
  }

  /// The frame of the straight line that `at`, the frame at its start, is turned from.
  Rotation base(const Rotation& at) const { return exp(Spin<Space>(-start_)) * at; }
  /// The frame at the end if no twist is put in.
  Rotation carried(const Rotation& at) const { return end(base(at)); }
  Rotation start(const Rotation& base) const { return exp(start_) * base; }
  Rotation end(const Rotation& base) const { return exp(end_) * base; }

  /// Frames of the edges from vertex a to b; the base is twisted by ψ from `from` to `to`.
  template <class Iterator>
  void lay(const Grid& grid, int a, int b, const Rotation& base, double from, double to,
           Iterator out) const {
    const double s0 = grid.s(a), length = grid.s(b) - s0;
    for (int j = a; j < b; ++j) {
      const double x = (grid.centre(j) - s0) / length;
      *out++ = Bow<Space>::twisted(exp(θ(station(x))) * base, from + x * (to - from));
    }
  }

 private:
  static constexpr int count = 16;
  struct Station {
    double start, end, bubble;
  };

  static Station station(double x) {
    return {(1 - x) * (1 - 3 * x), x * (3 * x - 2), std::sin(2 * std::numbers::pi * x)};
  }

  static const std::array<Station, count>& stations() {
    static const auto all = [] {
      std::array<Station, count> out;
      for (int i = 0; i < count; ++i) out[i] = station((i + 0.5) / count);
      return out;
    }();
    return all;
  }

  Spin<Space> θ(const Station& at) const {
    return at.start * start_ + at.end * end_ + at.bubble * bubble_;
  }

  double reach() const {
    double sum = 0;
    for (const auto& at : stations()) sum += std::cos(θ(at).norm());
    return sum / count;
  }

  /// Derivative of the reach by the bubble about the axis.
  double falling(const Spin<Space>& axis) const {
    double sum = 0;
    for (const auto& at : stations()) {
      const Spin<Space> turn = θ(at);
      sum -= sinc(turn.norm()) * turn.dot(axis) * at.bubble;
    }
    return sum / count;
  }

  static Spin<Space> turn(const Point<Space>& from, const Point<Space>& to,
                          const Spin<Space>& axis) {
    const Spin<Space> turn = cross(from, to);
    const double sine = turn.norm(), cosine = from.dot(to);
    if (sine < 1e-9) return cosine > 0 ? Spin<Space>::Zero() : Spin<Space>(std::numbers::pi * axis);
    return turn * (std::atan2(sine, cosine) / sine);
  }

  Spin<Space> start_, end_, bubble_;
};

}  // namespace pyrod
