// SPDX-License-Identifier: BSD-3-Clause
/// \file A rod with vertices where they are wanted.
#pragma once

#include <pyrod/core/definition.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/rod_spec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

namespace pyrod {

namespace detail {

/// Lengths of edges with more vertices; within 1e-9 of an edge's length of a vertex there is one.
inline Vector cut(const Vector& h, const std::vector<double>& at) {
  const Grid grid(h);
  std::vector<double> s(grid.arc_lengths().begin(), grid.arc_lengths().end());
  const std::size_t there = s.size();
  for (const double place : at) {
    const auto behind = std::upper_bound(s.begin(), s.begin() + std::ptrdiff_t(there), place);
    const int j = std::clamp(int(behind - s.begin()) - 1, 0, grid.edges() - 1);
    const double part = (place - grid.s(j)) / grid.h(j);
    const auto is_there = [&](double other) { return std::abs(other - place) <= 1e-9 * grid.h(j); };
    const bool told = std::any_of(s.begin() + std::ptrdiff_t(there), s.end(), is_there);
    if (part > 1e-9 && part < 1 - 1e-9 && !told) s.push_back(place);
  }
  if (s.size() == there) return h;
  std::ranges::sort(s);
  s.erase(std::ranges::unique(s).begin(), s.end());
  Vector out(Eigen::Index(s.size()) - 1);
  for (Eigen::Index j = 0; j < out.size(); ++j) out[j] = s[std::size_t(j) + 1] - s[std::size_t(j)];
  return out;
}

/// About as many edges, equal between the breaks and at least two there.
inline Vector graded(double length, const std::vector<double>& breaks, int edges) {
  std::vector<double> h;
  double from = 0;
  const auto piece = [&](double to) {
    const int count = std::max(2, int(std::lrint(edges * (to - from) / length)));
    h.insert(h.end(), std::size_t(count), (to - from) / count);
    from = to;
  };
  for (const double s : breaks) piece(s);
  piece(length);
  return Eigen::Map<const Vector>(h.data(), Eigen::Index(h.size()));
}

}  // namespace detail

PYROD_DEFINITION RodSpec with_vertices(RodSpec spec, const std::vector<double>& at) {
  const Grid grid(spec.edge_lengths);
  for (const double s : at) grid.on_rod(s);
  if (is_function(spec.section) || is_function(spec.curvature)) {
    spec.marks.insert(spec.marks.end(), at.begin(), at.end());
    std::ranges::sort(spec.marks);
    spec.marks.erase(std::ranges::unique(spec.marks).begin(), spec.marks.end());
  }
  if (!spec.chooses) {
    spec.edge_lengths = detail::cut(spec.edge_lengths, at);
    return spec;
  }
  const double length = spec.length(), near = 1e-9 * length;
  const std::size_t before = spec.kept.size();
  for (const double s : at) {
    const auto is = [&](double other) { return std::abs(other - s) <= near; };
    if (!is(0) && !is(length) && std::ranges::none_of(spec.kept, is)) spec.kept.push_back(s);
  }
  if (spec.kept.size() == before) return spec;
  std::ranges::sort(spec.kept);
  spec.edge_lengths = detail::graded(length, spec.kept, spec.edges());
  return spec;
}

}  // namespace pyrod
