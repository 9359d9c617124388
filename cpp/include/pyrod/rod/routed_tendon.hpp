// SPDX-License-Identifier: BSD-3-Clause
/// \file A tendon of a rod on its grid.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/tendon_cell.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// Offset in the section, along a1 and a2, at an arc length.
using Routing = std::function<Vec2(double)>;

namespace detail {

/// Weights of the derivative at x of the polynomial through values at the places (Fornberg, Math.
/// Comp. 51, 1988).
inline std::vector<double> slope_weights(double x, const double* at, int count) {
  std::vector<double> value(std::size_t(count), 0.), slope = value;
  value[0] = 1;
  double product = 1, off = at[0] - x;
  for (int i = 1; i < count; ++i) {
    double apart = 1;
    const double off_before = std::exchange(off, at[i] - x);
    for (int j = 0; j < i; ++j) {
      const double gap = at[i] - at[j];
      apart *= gap;
      if (j == i - 1) {
        slope[i] = product * (value[j] - off_before * slope[j]) / apart;
        value[i] = -product * off_before * value[j] / apart;
      }
      slope[j] = (off * slope[j] - value[j]) / gap;
      value[j] = off * value[j] / gap;
    }
    product = apart;
  }
  return slope;
}

}  // namespace detail

/// From one vertex of a rod to another, both of them ends of the rod or held by nodes; so are the
/// `kinks` between them. It slides without friction in what leads it.
class RoutedTendon {
 public:
  int rod, first, last;
  double tension;                ///< of one of given length, whose tension is found: zero
  std::optional<double> length;  ///< without tension, if that is given
  double softness = 0;           ///< its strain, by its tension [1/N]
  std::vector<int> kinks;        ///< inner vertices, in order

  RoutedTendon(int on, int from, int to, double force, std::vector<int> kinked,
               std::shared_ptr<const Routing> routing, const Grid& grid)
      : rod(on),
        first(from),
        last(to),
        tension(force),
        kinks(std::move(kinked)),
        routing_(std::move(routing)) {
    sample(grid);
  }

  /// The same on another grid, its vertices `vertex(j)`.
  template <class Vertex>
  RoutedTendon on(const Grid& grid, const Vertex& vertex) const {
    std::vector<int> kinked;
    for (const int j : kinks) kinked.push_back(vertex(j));
    RoutedTendon out(rod, vertex(first), vertex(last), tension, std::move(kinked), routing_, grid);
    out.length = length, out.softness = softness;
    return out;
  }

  /// Of one of given length.
  double length_under(double force) const { return *length * (1 + softness * force); }

  bool covers(int vertex, CellKind kind) const {
    return (vertex > first || (vertex == first && kind == CellKind::behind)) &&
           (vertex < last || (vertex == last && kind == CellKind::before));
  }

  template <class Space>
  TendonCell<Space> cell(const Grid& grid, int j, CellKind kind) const {
    const double before = kind == CellKind::behind ? 0 : grid.h(j - 1) / 2,
                 behind = kind == CellKind::before ? 0 : grid.h(j) / 2;
    const Vec2 &from = sampled(j, before > 0 ? -2 : 0), &to = sampled(j, behind > 0 ? 2 : 0);
    const Vec2& middle = kind == CellKind::whole
                             ? middles_.empty() ? sampled(j, 0) : middles_[std::size_t(j - first)]
                             : sampled(j, kind == CellKind::before ? -1 : 1);
    Point<Space> along = in_section<Space>(to - from);
    along[Space::dim - 1] = before + behind;
    return {along, in_section<Space>(middle)};
  }

  /// Offset at a vertex.
  const Vec2& offset(int j) const { return sampled(j, 0); }

  /// Offset at a vertex and, along the rod, e3 + d' on one side of it: a cell of length one.
  template <class Space>
  TendonCell<Space> at_vertex(const Grid& grid, int j, CellKind side) const {
    Point<Space> along = in_section<Space>(slope(grid, j, side));
    along[Space::dim - 1] = 1;
    return {along, in_section<Space>(offset(j))};
  }

  /// The largest offset along a2, and along any direction.
  double off_plane() const {
    double out = 0;
    for (const auto& d : samples_) out = std::max(out, std::abs(d[1]));
    return out;
  }
  double largest_offset() const {
    double out = 0;
    for (const auto& d : samples_) out = std::max(out, d.norm());
    return out;
  }
  /// Of all that are sampled.
  const std::vector<Vec2>& samples() const { return samples_; }

  /// Whether the other is the same but for its tension or its length.
  bool runs_like(const RoutedTendon& other) const {
    return rod == other.rod && first == other.first && last == other.last &&
           samples_ == other.samples_ && softness == other.softness;
  }

 private:
  template <class Space>
  static Point<Space> in_section(const Vec2& d) {
    if constexpr (Space::dim == 3)
      return {d[0], d[1], 0};
    else
      return {d[0], 0};
  }

  /// At a vertex, and a number of quarters of edges behind it.
  const Vec2& sampled(int j, int quarters) const {
    return samples_[std::size_t(4 * (j - first) + quarters)];
  }

  static double place(const Grid& grid, int first, int number) {
    const int j = first + number / 4;
    return number % 4 == 0 ? grid.s(j) : grid.s(j) + grid.h(j) * (number % 4) / 4;
  }

  void sample(const Grid& grid) {
    const auto at = [&](double s) {
      const Vec2 d = (*routing_)(s);
      require(d.allFinite(), "offset: expected finite numbers, got ", d.transpose(),
              " at the arc length ", s);
      return d;
    };
    for (int i = 0; i <= 4 * (last - first); ++i) samples_.push_back(at(place(grid, first, i)));
    const auto uneven = [&](int j) {
      return std::abs(grid.h(j) - grid.h(j - 1)) > 1e-12 * grid.h(j);
    };
    bool any = false;
    for (int j = first + 1; j < last; ++j) any = any || uneven(j);
    for (int j = first; any && j < last; ++j)
      middles_.push_back(j > first && uneven(j) ? at((grid.centre(j - 1) + grid.centre(j)) / 2)
                                                : sampled(j, 0));
  }

  /// Of the samples on that side of the vertex, up to where the routing has a kink: by a polynomial
  /// through the nearest nine.
  Vec2 slope(const Grid& grid, int j, CellKind side) const {
    int low = first, high = last;
    for (const int kink : kinks) {
      if (kink < j || (kink == j && side == CellKind::behind)) low = std::max(low, kink);
      if (kink > j || (kink == j && side == CellKind::before)) high = std::min(high, kink);
    }
    const int from = 4 * (low - first), to = 4 * (high - first), here = 4 * (j - first);
    const int count = std::min(9, to - from + 1),
              start = std::clamp(here - count / 2, from, to + 1 - count);
    std::vector<double> at;
    for (int i = 0; i < count; ++i) at.push_back(place(grid, first, start + i));
    const auto weights = detail::slope_weights(grid.s(j), at.data(), count);
    Vec2 out = Vec2::Zero();
    const Vec2& base = samples_[std::size_t(here)];  // what is constant has no slope at all
    for (int i = 0; i < count; ++i)
      out += weights[std::size_t(i)] * (samples_[std::size_t(start + i)] - base);
    return out;
  }

  std::shared_ptr<const Routing> routing_;
  std::vector<Vec2> samples_;  ///< four per edge, from the first vertex to the last
  std::vector<Vec2> middles_;  ///< of cells, from the first vertex on; none: they are the vertices
};

}  // namespace pyrod
