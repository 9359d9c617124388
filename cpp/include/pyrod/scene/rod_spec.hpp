// SPDX-License-Identifier: BSD-3-Clause
/// \file What a rod is made of, from which it is made on any grid.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/framing.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/placement.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

/// For the number of edges: the solver chooses them, to the accuracy that is wanted.
inline constexpr std::nullopt_t automatic = std::nullopt;

/// What a rod of n edges is made of, as a discrete rod stores it: between its vertices compliance
/// and curvature are linear.
struct RodArrays {
  std::vector<Vec3> bending;     ///< (EI1, EI2, GJ) at the n + 1 vertices
  std::vector<Vec3> stretching;  ///< (GA1, GA2, EA) of the n edges
  std::vector<double> mass;      ///< per length, of the n edges
  std::vector<Jump<Spatial>> jumps = {};
};

/// Sections and curvature at rest along a rod. Make one with `straight`, `precurved`, `from_curve`
/// or `discrete`.
struct RodSpec {
  Along<Section> section;  ///< a list: one per edge of `base`; empty: there are `arrays`
  Along<Vec3> curvature;   ///< K⁰ [1/m]; a list: one per vertex of `base`, linear between
  Vector base;             ///< lengths of the edges that were given
  Vector edge_lengths;     ///< of the grid that it is solved on
  bool chooses = false;    ///< the solver chooses the grid, but for the `kept` vertices
  bool corners = false;    ///< a polygon: all of its turn is at its vertices, on any grid
  std::optional<ModelKind> model = {};  ///< none: the richest that its finite stiffnesses allow
  Placement<Spatial> placement = {};    ///< of its start, at rest
  std::vector<double> kept = {}, marks = {};     ///< arc lengths; `marks`: where functions may jump
  std::shared_ptr<const RodArrays> arrays = {};  ///< instead of sections

  double length() const { return Grid(edge_lengths).length(); }
  int edges() const { return int(edge_lengths.size()); }

  /// The same rod with its start elsewhere at rest.
  RodSpec placed(const Placement<Spatial>& at) const {
    require_rotation(at.frame, "frame");
    require_finite(at.position, "position");
    RodSpec out = *this;
    out.placement = at;
    return out;
  }

  RodSpec in(ModelKind kind) const {
    RodSpec out = *this;
    out.model = kind;
    return out;
  }
};

namespace detail {

/// Arc lengths at which the sections of a list change.
inline std::vector<double> steps(const RodSpec& spec) {
  std::vector<double> out;
  const auto* list = std::get_if<std::vector<Section>>(&spec.section);
  const Grid base(spec.base);
  for (std::size_t i = 1; list && i < std::min(list->size(), std::size_t(base.edges())); ++i)
    if ((*list)[i] != (*list)[i - 1]) out.push_back(base.s(int(i)));
  return out;
}

inline constexpr double most_edges = 1e8;  // their unknowns are counted in 32 bits

/// As many edges that the rod at rest turns little from edge to edge.
inline double natural_edges(double length, const Along<Vec3>& curvature) {
  require(std::isfinite(length) && length > 0, "length: must be positive, got ", length);
  require(curvature.index() != 1,
          "curvature: one per vertex needs edges; give their number, or a function");
  double K = 0;
  for (const auto& one : sampled(curvature, Vector::LinSpaced(257, 0, length), "curvature", "")) {
    require(one.allFinite(), "curvature: expected finite numbers, got ", one.transpose());
    K = std::max(K, one.norm());
  }
  constexpr double turn = 0.4;  // [rad], the most from edge to edge
  return std::max(16., 2 * std::ceil(length * K / turn / 2));
}

}  // namespace detail

/// A rod with curvature at rest, of edges with these lengths [m].
inline RodSpec precurved(const Vector& edge_lengths, const Along<Section>& section,
                         const Along<Vec3>& curvature, std::optional<ModelKind> model = {}) {
  RodSpec out{section, curvature, edge_lengths, edge_lengths};
  out.model = model;
  return out;
}

/// Of equal edges: their number, or `automatic`.
inline RodSpec precurved(double length, std::optional<int> edges, const Along<Section>& section,
                         const Along<Vec3>& curvature, std::optional<ModelKind> model = {}) {
  const double n = edges ? *edges : detail::natural_edges(length, curvature);
  require(edges || n <= detail::most_edges, "curvature: the rod at rest turns so much that ", n,
          " edges would be needed");
  require(n <= detail::most_edges, "edges: must be at most ", detail::most_edges, ", got ", n);
  auto out = precurved(Grid::uniform(length, int(n)).edge_lengths(), section, curvature, model);
  out.chooses = !edges;
  if (out.chooses) out.kept = detail::steps(out);  // sections keep their ends on any grid
  return out;
}

/// A rod that is given by the arrays of a discrete rod (Linn 2020, B.7), with the curvature at rest
/// at its vertices.
inline RodSpec discrete(const Vector& edge_lengths, RodArrays arrays, std::vector<Vec3> K0,
                        ModelKind model) {
  const int n = Grid(edge_lengths).edges();
  require_count(Eigen::Index(arrays.bending.size()), n + 1, "bending", "one per vertex");
  require_count(Eigen::Index(arrays.stretching.size()), n, "stretching", "one per edge");
  require_count(Eigen::Index(K0.size()), n + 1, "K0", "one per vertex");
  if (arrays.mass.empty()) arrays.mass.assign(std::size_t(n), 0);
  require_count(Eigen::Index(arrays.mass.size()), n, "mass", "one per edge");
  auto out = precurved(edge_lengths, std::vector<Section>{}, std::move(K0), model);
  out.arrays = std::make_shared<const RodArrays>(std::move(arrays));
  return out;
}

/// A rod that is straight at rest: along z, with a1 along x, unless it is placed otherwise.
inline RodSpec straight(double length, std::optional<int> edges, const Along<Section>& section,
                        std::optional<ModelKind> model = {}) {
  return precurved(length, edges, section, Vec3(0, 0, 0), model);
}

/// A rod that has the given shape at rest, and that place unless it is clamped elsewhere: n + 1
/// vertices and n frames, each of which is turned the shortest way that brings a3 into its edge;
/// more than 0.5 rad is refused. The rod *is* the polygon: on finer grids all of its turn stays at
/// these vertices.
inline RodSpec from_curve(const std::vector<Vec3>& positions, std::vector<Quaternion> frames,
                          const Along<Section>& section, std::optional<ModelKind> model = {}) {
  const int n = int(positions.size()) - 1;
  require(n > 0, "positions: expected two vertices or more, got ", n + 1);
  require_frames(frames, n, "frames");
  Vector h(n);
  for (int j = 0; j < n; ++j) {
    const Vec3 edge = positions[j + 1] - positions[j];
    require(edge.allFinite() && edge.norm() > 0, "positions[", j + 1,
            "]: neighbours must not coincide, got ", positions[j + 1].transpose(), " twice");
    h[j] = edge.norm();
    const Vec3 t = edge / h[j], a3 = rotate(frames[j], Vec3::UnitZ());
    const double off = std::atan2(a3.cross(t).norm(), a3.dot(t));
    require(off <= 0.5, "frames[", j, "]: its a3 is ", off,
            " rad off the edge, more than 0.5; give frames whose a3 is along the curve");
    frames[j] = adapted(frames[j], t);
  }
  check_continued(frames);
  frames = continued(std::move(frames));
  const Grid grid(h);
  std::vector<Vec3> K(std::size_t(n + 1), Vec3::Zero());
  for (int j = 1; j < n; ++j) K[j] = log(frames[j - 1].conjugate() * frames[j]) / grid.Δs(j);
  if (n > 1) K.front() = K[1], K.back() = K[std::size_t(n) - 1];
  auto out = precurved(h, section, K, model);
  out.corners = true;
  out.placement = {positions[0], frames[0] * exp(Vec3(-h[0] / 2 * K[0]))};
  return out;
}

}  // namespace pyrod
