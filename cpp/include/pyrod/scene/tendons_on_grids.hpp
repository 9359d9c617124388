// SPDX-License-Identifier: BSD-3-Clause
/// \file Tendons of a scene brought to the grids of its rods.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

namespace detail {

/// Straight between the vertices of a grid.
inline FunctionAlong<Vec2> polygon(std::vector<Vec2> values, const Grid& grid) {
  return {[values = std::move(values), grid](double s) -> Vec2 {
    const int j = edge_at(grid, s);
    const double part = part_of(grid, j, s);
    return (1 - part) * values[std::size_t(j)] + part * values[std::size_t(j) + 1];
  }};
}

/// Inner vertices at which a polygon turns.
inline std::vector<double> corners(const std::vector<Vec2>& values, const Grid& grid) {
  std::vector<double> out;
  double size = 0;
  for (const auto& d : values) size = std::max(size, d.norm());
  for (int j = 1; j < grid.edges(); ++j) {
    const auto i = std::size_t(j);
    const Vec2 before = (values[i] - values[i - 1]) / grid.h(j - 1),
               behind = (values[i + 1] - values[i]) / grid.h(j);
    if ((behind - before).norm() * grid.h(j) > 1e-12 * size) out.push_back(grid.s(j));
  }
  return out;
}

}  // namespace detail

/// A list, one per vertex of a rod as it was given or as it is cut at its places, as a function
/// with kinks.
inline void make_polygon(Tendon& tendon, const Grid& given, const Grid& now) {
  const auto* list = std::get_if<std::vector<Vec2>>(&tendon.offset);
  if (!list) return;
  const auto size = Eigen::Index(list->size());
  const Grid& grid = size == given.vertices() ? given : now;
  require(size == grid.vertices(), "offset: expected 2 numbers, or ", now.vertices(),
          " times 2 (one per vertex), got shape (", size, ", 2)");
  for (const auto& d : *list)
    require(d.allFinite(), "offset: expected finite numbers, got ", d.transpose());
  tendon.kinks = detail::corners(*list, grid);
  tendon.offset = detail::polygon(*list, grid);
}

/// Arc lengths at which a tendon needs vertices, inside a rod so long.
inline std::vector<double> places_of(const Tendon& tendon, double length) {
  std::vector<double> out{tendon.begins(), tendon.ends(length)};
  for (const double s : tendon.kinks)
    if (s > out[0] && s < out[1]) out.push_back(s);
  std::erase_if(out, [&](double s) { return !(s > 1e-12 * length && s < length * (1 - 1e-12)); });
  return out;
}

/// `vertex(s)`: on the grid, that at the arc length.
template <class Vertex>
RoutedTendon routed(const Tendon& tendon, const Grid& grid, const Vertex& vertex) {
  const double length = grid.length(), from = tendon.begins(), to = tendon.ends(length);
  const int first = vertex(from), last = vertex(to);
  std::vector<int> kinks;
  for (const double s : tendon.kinks)
    if (const int j = vertex(s); j > first && j < last) kinks.push_back(j);
  std::ranges::sort(kinks);
  kinks.erase(std::ranges::unique(kinks).begin(), kinks.end());
  const auto routing = std::visit(
      [&]<class T>(const T& offset) -> Routing {
        if constexpr (std::is_same_v<T, Vec2>)
          return [offset](double) { return offset; };
        else if constexpr (std::is_same_v<T, FunctionAlong<Vec2>>)
          return [offset, from, to](double s) { return offset(std::clamp(s, from, to)); };
        else
          throw InvalidArgument("offset: a list has no meaning without the rod's vertices");
      },
      tendon.offset);
  RoutedTendon out(tendon.rod, first, last, tendon.tension.value_or(0), std::move(kinks),
                   std::make_shared<const Routing>(routing), grid);
  out.length = tendon.length;
  out.softness = tendon.EA ? 1 / *tendon.EA : 0;
  return out;
}

}  // namespace pyrod
