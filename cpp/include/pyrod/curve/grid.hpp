// SPDX-License-Identifier: BSD-3-Clause
/// \file The staggered grid: vertices s_j, edges between them, and a cell around every vertex.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pyrod {

/// Open: n edges between n + 1 vertices, with half a cell at either end. Closed: n edges and n
/// vertices, the last edge leads back to vertex 0, and all cells are whole.
enum class Closure { open, closed };

/// Reference arc length, cut into n edges that need not be equal (Linn B.7).
class Grid {
 public:
  /// `edge_lengths`: h_{j-1/2} > 0, n ≥ 1 of them.
  explicit Grid(Vector edge_lengths, Closure closure = Closure::open)
      : closure_(closure), h_(std::move(edge_lengths)) {
    require(h_.size() > 0, "edge_lengths: a rod needs at least one edge");
    require_positive(h_, "edge_lengths");
    const Eigen::Index n = h_.size();
    Δs_.resize(vertices());
    Δs_.segment(1, n - 1) = (h_.head(n - 1) + h_.tail(n - 1)) / 2;
    Δs_[0] = closed() ? (h_[n - 1] + h_[0]) / 2 : h_[0] / 2;
    if (!closed()) Δs_[n] = h_[n - 1] / 2;
    s_.resize(n + 1);
    s_[0] = 0;
    double lost = 0;  // by rounding, given back to the next sum (Kahan)
    for (Eigen::Index j = 0; j < n; ++j) {
      const double h = h_[j] - lost;
      s_[j + 1] = s_[j] + h;
      lost = (s_[j + 1] - s_[j]) - h;
    }
  }

  static Grid uniform(double length, int edges) {
    require(edges > 0, "edges: must be at least 1, got ", edges);
    require(std::isfinite(length) && length > 0, "length: must be positive, got ", length);
    Grid grid(Vector::Constant(edges, length / edges));
    for (int j = 0; j <= edges; ++j) grid.s_[j] = length * (double(j) / edges);  // ends at `length`
    return grid;
  }

  int edges() const { return int(h_.size()); }
  int vertices() const { return edges() + !closed(); }
  bool closed() const { return closure_ == Closure::closed; }
  Closure closure() const { return closure_; }
  /// The vertex behind edge j.
  int next(int j) const { return closed() && j == edges() - 1 ? 0 : j + 1; }
  double length() const { return s_[edges()]; }

  /// h_{j+1/2}: reference length of edge j, between the vertices j and j + 1.
  double h(int j) const { return h_[j]; }
  /// Δs_j: length of the cell around vertex j; at the two ends the half edge.
  double Δs(int j) const { return Δs_[j]; }
  /// s_j: arc length of vertex j; on a closed grid s(n) is the length.
  double s(int j) const { return s_[j]; }
  /// Arc length of the centre of edge j.
  double centre(int j) const { return s_[j] + h_[j] / 2; }

  /// The arc length s, checked to lie on the rod; within rounding of its end it is the end.
  double on_rod(double s) const {
    const double L = length(), rounding = 1e-12 * L;
    require(s >= -rounding && s <= L + rounding, "at: must be an arc length on the rod, in [0, ", L,
            "], got ", s);
    return s > L - rounding ? L : std::max(s, 0.);
  }

  const Vector& edge_lengths() const { return h_; }
  const Vector& cell_lengths() const { return Δs_; }
  const Vector& arc_lengths() const { return s_; }

 private:
  Closure closure_;
  Vector h_, Δs_, s_;
};

}  // namespace pyrod
