// SPDX-License-Identifier: BSD-3-Clause
/// \file The rod: grid, stiffness along it, and the curvature it has at rest.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rotation/measure.hpp>
#include <pyrod/rotation/space.hpp>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

namespace pyrod {

/// What a rod is made of. Stiffness and rest curvature may differ from place to place.
template <class Space>
struct Rod {
  Grid grid;
  std::vector<Spin<Space>> bending;  ///< C_bt = (EI1, EI2, GJ) at the n + 1 vertices; plane: EI2
  std::vector<Point<Space>> stretching;  ///< C_es = (GA1, GA2, EA) on the n edges; plane: (GA1, EA)
  std::vector<Spin<Space>> K0;           ///< rest curvature at the n + 1 vertices
  std::vector<Jump<Space>> jumps = {};   ///< inner vertices where these jump, in order

  /// The same everywhere, and straight at rest unless `K0` says otherwise.
  static Rod uniform(Grid grid, const Spin<Space>& bending, const Point<Space>& stretching,
                     const Spin<Space>& K0 = Spin<Space>::Zero()) {
    const int n = grid.edges();
    return {std::move(grid), std::vector<Spin<Space>>(n + 1, bending),
            std::vector<Point<Space>>(n, stretching), std::vector<Spin<Space>>(n + 1, K0)};
  }

  int edges() const { return grid.edges(); }

  /// Refuses what no rod can be made of, naming the place and the remedy.
  void check() const {
    const int n = edges(), vertices = grid.vertices();
    require_count(Eigen::Index(bending.size()), vertices, "bending", "one per vertex");
    require_count(Eigen::Index(stretching.size()), n, "stretching", "one per edge");
    require_count(Eigen::Index(K0.size()), vertices, "K0", "one per vertex");
    if (!sound()) refuse();
    for (std::size_t i = 0; i < jumps.size(); ++i)
      require(jumps[i].vertex > (i == 0 ? 0 : jumps[i - 1].vertex) && jumps[i].vertex < n,
              "jumps: expected inner vertices in their order, got ", jumps[i].vertex);
  }

  /// Stiffness and curvature at rest on both sides of vertex j.
  Jump<Space> sides(int j) const {
    const auto jump = std::lower_bound(jumps.begin(), jumps.end(), j,
                                       [](const auto& a, int at) { return a.vertex < at; });
    if (jump != jumps.end() && jump->vertex == j) return *jump;
    return {j, bending[j], K0[j], bending[j], K0[j]};
  }

  /// The frames of an open rod at rest that starts in the frame q0.
  std::vector<typename Space::Rotation> frames_at_rest(const typename Space::Rotation& q0) const {
    std::vector<typename Space::Rotation> frames;
    frames.reserve(edges());
    for (int j = 0; j < edges(); ++j)
      frames.push_back(turned(j == 0 ? q0 : frames[j - 1], grid.Δs(j) * K0[j], Measure::log));
    return frames;
  }

  /// The stress-free shape, placed with its start at r0 in the frame q0. A closed rod is cut open
  /// there: its shape at rest need not close.
  CosseratCurve<Space> at_rest(const Point<Space>& r0, const typename Space::Rotation& q0) const {
    Strains<Space> rest{K0, std::vector<Point<Space>>(edges(), axis<Space>())};
    if (!grid.closed()) return reconstruct<Space>(grid, rest, r0, q0);
    rest.K.push_back(K0[0]);
    return reconstruct<Space>(Grid(grid.edge_lengths()), rest, r0, q0);
  }

 private:
  /// Whether the numbers will do: the quick look that a good rod gets.
  bool sound() const {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < bending.size(); ++j) {
      const double turn = grid.Δs(int(j)) * grid.Δs(int(j)) * K0[j].squaredNorm();
      const auto C = bending[j].array();
      if (!((C > 0).all() && (C < infinite).all() && turn < std::numbers::pi * std::numbers::pi))
        return false;
    }
    for (const auto& C : stretching)
      if (!(C.array() > 0).all()) return false;
    return true;
  }

  /// Names the first number that will not do.
  void refuse() const {
    for (int j = 0; j < grid.vertices(); ++j) {
      require((bending[j].array() > 0).all() && bending[j].allFinite(), "bending[", j,
              "]: stiffnesses must be positive and finite, got ", bending[j].transpose());
      require(K0[j].allFinite(), "K0[", j, "]: expected finite numbers, got ", K0[j].transpose());
      const double turn = grid.Δs(j) * K0[j].norm();
      require(turn < std::numbers::pi, "K0[", j, "]: the rod at rest turns by ", turn,
              " rad at this vertex; use more edges, so that neighbours turn by less than pi");
    }
    for (int j = 0; j < edges(); ++j)
      require((stretching[j].array() > 0).all(), "stretching[", j,
              "]: stiffnesses must be positive (infinite: rigid), got ", stretching[j].transpose());
  }
};

}  // namespace pyrod
