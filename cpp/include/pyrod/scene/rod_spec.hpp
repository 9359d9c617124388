// SPDX-License-Identifier: BSD-3-Clause
/// \file What a rod is made of, from which it is made on any grid.
#pragma once

#include <pyrod/core/definition.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/placement.hpp>

#include <memory>
#include <optional>
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

  double length() const;
  int edges() const { return int(edge_lengths.size()); }

  /// The same rod with its start elsewhere at rest.
  RodSpec placed(const Placement<Spatial>& at) const;

  RodSpec in(ModelKind kind) const {
    RodSpec out = *this;
    out.model = kind;
    return out;
  }
};

namespace detail {

/// Arc lengths at which the sections of a list change.
PYROD_DEFINITION std::vector<double> steps(const RodSpec& spec);

/// As many edges that the rod at rest turns little from edge to edge.
PYROD_DEFINITION double natural_edges(double length, const Along<Vec3>& curvature);

}  // namespace detail

/// A rod with curvature at rest, of edges with these lengths [m].
PYROD_DEFINITION RodSpec precurved(const Vector& edge_lengths, const Along<Section>& section,
                                   const Along<Vec3>& curvature,
                                   std::optional<ModelKind> model = {});

/// Of equal edges: their number, or `automatic`.
PYROD_DEFINITION RodSpec precurved(double length, std::optional<int> edges,
                                   const Along<Section>& section, const Along<Vec3>& curvature,
                                   std::optional<ModelKind> model = {});

/// A rod that is given by the arrays of a discrete rod (Linn 2020, B.7), with the curvature at rest
/// at its vertices.
PYROD_DEFINITION RodSpec discrete(const Vector& edge_lengths, RodArrays arrays,
                                  std::vector<Vec3> K0, ModelKind model);

/// A rod that is straight at rest: along z, with a1 along x, unless it is placed otherwise.
PYROD_DEFINITION RodSpec straight(double length, std::optional<int> edges,
                                  const Along<Section>& section,
                                  std::optional<ModelKind> model = {});

/// A rod that has the given shape at rest, and that place unless it is clamped elsewhere: n + 1
/// vertices and n frames, each of which is turned the shortest way that brings a3 into its edge;
/// more than 0.5 rad is refused. The rod *is* the polygon: on finer grids all of its turn stays at
/// these vertices.
PYROD_DEFINITION RodSpec from_curve(const std::vector<Vec3>& positions,
                                    std::vector<Quaternion> frames, const Along<Section>& section,
                                    std::optional<ModelKind> model = {});

/// The same rod with vertices at the arc lengths [m]. Where the solver chooses the grid, they are
/// kept.
PYROD_DEFINITION RodSpec with_vertices(RodSpec spec, const std::vector<double>& at);

}  // namespace pyrod

#ifndef PYROD_COMPILED
#include <pyrod/scene/make_rod.hpp>
#include <pyrod/scene/with_vertices.hpp>
#endif
