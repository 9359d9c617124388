// SPDX-License-Identifier: BSD-3-Clause
/// \file What is given on the vertices and edges of one grid, brought to another of the same rod.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/rod_spec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace pyrod {

/// A discrete rod, and the masses per length of its edges.
struct RodOnGrid {
  Rod<Spatial> rod;
  std::vector<double> mass;
  ModelKind richest;  ///< that its finite stiffnesses allow
};

namespace detail {

/// The richest model that finite stiffnesses (GA1, GA2, EA) allow.
inline ModelKind richest(const Vec3& stretching) {
  if (!std::isinf(stretching[0])) return ModelKind::cosserat;
  return std::isinf(stretching[2]) ? ModelKind::inextensible : ModelKind::extensible;
}

/// The edge that the arc length is on.
inline int edge_at(const Grid& grid, double at) {
  const auto& ends = grid.arc_lengths();
  const auto behind = std::upper_bound(ends.begin(), ends.end(), at) - ends.begin();
  return std::clamp(int(behind) - 1, 0, grid.edges() - 1);
}

/// The part of edge j that lies before the arc length.
inline double part_of(const Grid& grid, int j, double at) {
  return std::clamp((at - grid.s(j)) / grid.h(j), 0., 1.);
}

/// Linear between the vertices of `base`, at the arc lengths `s`.
inline std::vector<Vec3> interpolated(const std::vector<Vec3>& given, const Grid& base,
                                      const Vector& s) {
  std::vector<Vec3> out;
  for (const double at : s) {
    const int j = edge_at(base, at);
    const double part = part_of(base, j, at);
    out.push_back((1 - part) * given[std::size_t(j)] + part * given[std::size_t(j) + 1]);
  }
  return out;
}

/// Curvature whose turns, those of the polygon `base`, are all at its vertices.
inline std::vector<Vec3> at_corners(const std::vector<Vec3>& given, const Grid& base,
                                    const Grid& grid) {
  std::vector<Vec3> out(std::size_t(grid.vertices()), Vec3::Zero());
  const Vector middle = centres(grid.arc_lengths());
  for (int j = 0; j < base.vertices(); ++j) {
    const auto at = std::lower_bound(middle.begin(), middle.end(), base.s(j)) - middle.begin();
    out[std::size_t(at)] = given[std::size_t(j)] * (base.Δs(j) / grid.Δs(int(at)));
  }
  return out;
}

/// A rod that is given by arrays, on another grid. Along each edge compliance and curvature are
/// linear, from what they are behind its start to what they are before its end.
class ArraysOnGrid {
 public:
  ArraysOnGrid(const RodSpec& spec, const Grid& grid, const Grid& base, bool same)
      : given_{base, spec.arrays->bending, spec.arrays->stretching,
               std::get<std::vector<Vec3>>(spec.curvature), spec.arrays->jumps},
        mass_(spec.arrays->mass),
        grid_(grid),
        same_(same),
        corners_(spec.corners) {}

  RodOnGrid make() const {
    RodOnGrid out{{grid_, given_.bending, given_.stretching, given_.K0, given_.jumps}, mass_, {}};
    if (!same_) bring(out);
    out.richest = ModelKind::inextensible;
    for (const auto& C : out.rod.stretching) out.richest = std::min(out.richest, richest(C));
    return out;
  }

 private:
  void bring(RodOnGrid& out) const {
    const Vector& s = grid_.arc_lengths();
    out.rod.bending.clear(), out.rod.K0.clear(), out.rod.stretching.clear(), out.mass.clear();
    for (const double at : s) add_vertex(at, out.rod);
    if (corners_) out.rod.K0 = at_corners(given_.K0, given_.grid, grid_);
    keep_what_is_constant(out.rod.bending);
    for (const double at : centres(s)) {
      const auto edge = std::size_t(edge_at(given_.grid, at));
      out.rod.stretching.push_back(given_.stretching[edge]);
      out.mass.push_back(mass_[edge]);
    }
    out.rod.jumps.clear();
    for (const auto& jump : given_.jumps) add_jump(jump, out.rod);
  }

  void add_vertex(double at, Rod<Spatial>& rod) const {
    const int j = edge_at(given_.grid, at);
    const double part = part_of(given_.grid, j, at);
    const auto start = given_.sides(j), end = given_.sides(j + 1);
    rod.bending.push_back(((1 - part) * start.bending_behind.cwiseInverse() +
                           part * end.bending_before.cwiseInverse())
                              .cwiseInverse());
    rod.K0.push_back((1 - part) * start.K0_behind + part * end.K0_before);
  }

  /// Where nothing changes along the rod it is kept to the last bit.
  void keep_what_is_constant(std::vector<Vec3>& bending) const {
    const Vec3& first = given_.bending[0];
    for (int i = 0; i < 3; ++i)
      if (std::ranges::all_of(given_.bending, [&](const Vec3& C) { return C[i] == first[i]; }) &&
          given_.jumps.empty())
        for (auto& C : bending) C[i] = first[i];
  }

  /// The cell of the vertex has halves of either side.
  void add_jump(Jump<Spatial> jump, Rod<Spatial>& rod) const {
    const double s = given_.grid.s(jump.vertex) - 1e-9 * grid_.length();
    const auto& ends = grid_.arc_lengths();
    const int j = int(std::lower_bound(ends.begin(), ends.end(), s) - ends.begin());
    if (j <= 0 || j >= grid_.edges()) return;
    const double before = grid_.h(j - 1), behind = grid_.h(j);
    const Vec3 compliance =
        before * jump.bending_before.cwiseInverse() + behind * jump.bending_behind.cwiseInverse();
    rod.bending[std::size_t(j)] = (before + behind) * compliance.cwiseInverse();
    if (!corners_)
      rod.K0[std::size_t(j)] =
          (before * jump.K0_before + behind * jump.K0_behind) / (before + behind);
    jump.vertex = j;
    rod.jumps.push_back(jump);
  }

  Rod<Spatial> given_;
  const std::vector<double>& mass_;
  const Grid& grid_;
  bool same_, corners_;
};

}  // namespace detail

}  // namespace pyrod
