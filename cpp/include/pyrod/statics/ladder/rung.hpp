// SPDX-License-Identifier: BSD-3-Clause
/// \file A rung of the accuracy ladder: what an equilibrium on one grid says at the points of the
/// coarsest, as numbers that can be extrapolated, and back.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/solve/extrapolation.hpp>
#include <pyrod/statics/solution/quantity.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/solution.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pyrod {

/// Calls visit(quantity, numbers, width) for all that is extrapolated of vertices and sums, and
/// `visit_edges` of edges, always in the same order.
template <class Rods, class Nodes, class Visit>
void visit_vertices(Rods& rods, Nodes& nodes, Visit&& visit) {
  const auto each = [&](Quantity what, auto& list) {
    for (auto& v : list) visit(what, v.data(), 3);
  };
  for (auto& rod : rods) {
    each(Quantity::positions, rod.curve.positions);
    for (auto& q : rod.vertex_frames) visit(Quantity::frames, q.coeffs().data(), 4);
    each(Quantity::curvatures, rod.strains.K);
    each(Quantity::forces, rod.vertex_force);
    each(Quantity::moments, rod.moment);
    for (auto& b : rod.before) {
      visit(Quantity::forces, b.force.data(), 3);
      visit(Quantity::curvatures, b.K.data(), 3);
      visit(Quantity::moments, b.moment.data(), 3);
    }
    each(Quantity::forces, rod.load);
    visit(Quantity::unjudged, rod.load_moment.data(), 3);  // its size tells where the origin is
    visit(Quantity::energy, &rod.bend_twist_energy, 1);
    visit(Quantity::energy, &rod.stretch_shear_energy, 1);
  }
  for (auto& node : nodes) {
    visit(Quantity::positions, node.position.data(), 3);
    visit(Quantity::frames, node.frame.coeffs().data(), 4);
    visit(Quantity::reactions, node.reaction_force.data(), 3);
    visit(Quantity::reaction_moments, node.reaction_moment.data(), 3);
  }
}

template <class Rods, class Visit>
void visit_edges(Rods& rods, Visit&& visit) {
  for (auto& rod : rods) {
    for (auto& q : rod.curve.frames) visit(Quantity::edge_frames, q.coeffs().data(), 4);
    for (auto& n : rod.force) visit(Quantity::edge_forces, n.data(), 3);
    for (auto& Γ : rod.strains.Γ) visit(Quantity::strains, Γ.data(), 3);
  }
}

namespace detail {

/// All numbers that are visited, one after another, and places for more.
template <class VisitAll>
Vector gathered(const VisitAll& visit_all, Eigen::Index more) {
  Eigen::Index size = more;
  visit_all([&](Quantity, const double*, int width) { size += width; });
  Vector out(size);
  double* to = out.data();
  visit_all(
      [&](Quantity, const double* numbers, int width) { to = std::copy_n(numbers, width, to); });
  return out;
}

/// `place`: of the first number, and in the end behind the last.
inline auto listing(std::vector<Row>& out, int& place, int first_quantity) {
  return [&out, &place, first_quantity](Quantity what, const double*, int width) {
    if (what != Quantity::unjudged) out.push_back({place, width, int(what) - first_quantity});
    place += width;
  };
}

inline auto reading(const Vector& from) {
  return [&from, place = 0](Quantity, double* numbers, int width) mutable {
    std::copy_n(from.data() + place, width, numbers);
    place += width;
  };
}

}  // namespace detail

/// K from the moments, theory (21): the turn of the half cell at an end is that at its middle.
inline void take_curvatures(RodSolution<Spatial>& rod, const Rod<Spatial>& made) {
  for (std::size_t j = 0; j < rod.strains.K.size(); ++j) {
    rod.material_moment[j] = unrotate(rod.vertex_frames[j], rod.moment[j]);
    rod.strains.K[j] = made.K0[j] + rod.material_moment[j].cwiseQuotient(made.bending[j]);
  }
  for (auto& b : rod.before) {
    const auto j = std::size_t(b.vertex);
    const auto sides = made.sides(b.vertex);
    b.K = sides.K_before(unrotate(rod.vertex_frames[j], b.moment));
    rod.strains.K[j] = sides.K_behind(rod.material_moment[j]);
  }
}

/// What one grid says. Frames have the signs of the rung before, if there is one.
struct Rung {
  std::vector<RodSolution<Spatial>> rods;
  std::vector<NodeSolution<Spatial>> nodes;
  int stride;
  bool one_axis = true;  ///< every cell bends about the axis of its moment: errors have even powers

  /// Takes the rods and the nodes of `solution`, as told at the vertices of the coarsest grid, of
  /// whose edges its own are `parts`-ths.
  Rung(Solution<Spatial>&& solution, int parts, const Rung* before)
      : rods(std::move(solution.rods)), nodes(std::move(solution.nodes)), stride(parts) {
    for (const auto& rod : rods) one_axis = one_axis && bends_about_its_moment(rod);
    if (before) take_signs(*before);
  }

  double energy() const {
    double sum = 0;
    for (const auto& rod : rods) sum += rod.bend_twist_energy + rod.stretch_shear_energy;
    return sum;
  }

  /// Whether these rods have both sides told at the same vertices.
  bool same_places(const std::vector<RodSolution<Spatial>>& others) const {
    return std::ranges::equal(rods, others, [](const auto& a, const auto& b) {
      return std::ranges::equal(a.before, b.before, {}, &Before<Spatial>::vertex,
                                &Before<Spatial>::vertex);
    });
  }

  /// The energy of all rods comes last: errors of theirs may add up.
  Vector vertices() const {
    const auto visit_all = [this](const auto& visit) { visit_vertices(rods, nodes, visit); };
    Vector out = detail::gathered(visit_all, 1);
    out[out.size() - 1] = energy();
    return out;
  }
  Vector edges() const {
    return detail::gathered([this](const auto& visit) { visit_edges(rods, visit); }, 0);
  }

  std::vector<Row> vertex_rows() const {
    std::vector<Row> out;
    int end = 0;
    visit_vertices(rods, nodes, detail::listing(out, end, 0));
    out.push_back({end, 1, int(Quantity::energy)});
    return out;
  }
  std::vector<Row> edge_rows() const {
    std::vector<Row> out;
    int end = 0;
    visit_edges(rods, detail::listing(out, end, vertex_quantities));
    return out;
  }

  /// Takes extrapolated numbers, those of edges as well if there are any.
  void set(const Vector& vertices, const Vector& edges) {
    visit_vertices(rods, nodes, detail::reading(vertices));
    if (edges.size() > 0) visit_edges(rods, detail::reading(edges));
    for (auto& rod : rods) {
      for (auto& q : rod.vertex_frames) q.normalize();
      for (auto& q : rod.curve.frames) q.normalize();
    }
    for (auto& node : nodes) node.frame.normalize();
  }

 private:
  /// A half cell, at an end that is held, is then half of a whole one; otherwise it is off by a
  /// term in u × m, and brings odd powers. So does a frame between halves that bend differently.
  static bool bends_about_its_moment(const RodSolution<Spatial>& rod) {
    double K = 0, M = 0, across = 0;
    if (std::ranges::any_of(rod.before, &Before<Spatial>::halves)) return false;
    for (std::size_t j = 0; j < rod.strains.K.size(); ++j) {
      const Vec3 &Kj = rod.strains.K[j], &Mj = rod.material_moment[j];
      K = std::max(K, Kj.norm()), M = std::max(M, Mj.norm());
      across = std::max(across, Kj.cross(Mj).norm());
    }
    return across <= 1e-9 * K * M;
  }

  void take_signs(const Rung& before) {
    const auto align = [](Quaternion& q, const Quaternion& like) {
      if (q.dot(like) < 0) q.coeffs() *= -1;
    };
    for (std::size_t i = 0; i < rods.size(); ++i) {
      auto& rod = rods[i];
      for (std::size_t j = 0; j < rod.vertex_frames.size(); ++j)
        align(rod.vertex_frames[j], before.rods[i].vertex_frames[j]);
      for (std::size_t j = 0; j < rod.curve.frames.size(); ++j)
        align(rod.curve.frames[j], before.rods[i].curve.frames[j]);
    }
    for (std::size_t v = 0; v < nodes.size(); ++v) align(nodes[v].frame, before.nodes[v].frame);
  }
};

/// Puts what the largest values along rods tend to into `told`, and returns by how much they may be
/// wrong. `scales` of all quantities; `noise`: relative rounding errors of the finest grid.
inline double tell_extremes(std::span<const Rung> rungs,
                            const std::array<double, quantities>& scales, double noise,
                            Rung& told) {
  double error = 0;
  const auto tell = [&](std::size_t rod, double Largest::* kind, Quantity like) {
    std::vector<double> levels;
    for (const auto& rung : rungs) levels.push_back(rung.rods[rod].largest.*kind);
    const auto limit = limit_of(levels, scales[std::size_t(like)], rungs.back().one_axis, noise);
    told.rods[rod].largest.*kind = limit.value;
    error = std::max(error, limit.error);
  };
  for (std::size_t rod = 0; rod < told.rods.size(); ++rod) {
    tell(rod, &Largest::K, Quantity::curvatures);
    tell(rod, &Largest::force, Quantity::forces);
    tell(rod, &Largest::moment, Quantity::moments);
  }
  return error;
}

}  // namespace pyrod
