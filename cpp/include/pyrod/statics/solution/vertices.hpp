// SPDX-License-Identifier: BSD-3-Clause
/// \file What is told at the vertices of a rod: frames, section forces, and both sides of those at
/// which something acts, holds or jumps.
#pragma once

#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/unknowns/kinks.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace pyrod {

/// An inner vertex that a node holds.
template <class Space>
struct HeldVertex {
  int vertex;
  std::optional<typename Space::Rotation> frame = {};  ///< if the node holds that as well
  Spin<Space> moment_before = Spin<Space>::Zero();     ///< then: what the half cell before exerts
};

/// Completes a solution at every `stride`-th vertex, inside the rod at its ends. Its moments are
/// those that the cells transmit; of a vertex whose frame is held, what the half behind does.
template <class Space>
class Vertices {
 public:
  using Rotation = typename Space::Rotation;
  using Held = std::vector<HeldVertex<Space>>;

  Vertices(const Rod<Space>& rod, const Loads<Space>& loads, Held held = {}, int stride = 1)
      : rod_(rod), loads_(loads), held_(std::move(held)), stride_(stride) {}

  void see(RodSolution<Space>& s, std::span<const Point<Space>> force) const {
    const int n = rod_.edges();
    s.vertex_frames.reserve(std::size_t(n / stride_ + 1));
    s.vertex_force.reserve(std::size_t(n / stride_ + 1));
    for (int j = 0; j <= n; j += stride_) {
      s.vertex_frames.push_back(vertex_frame(rod_.grid, s.curve, j));
      s.vertex_force.push_back(j == 0 ? behind(s, force, j)
                               : j == n
                                   ? before(s, force, j)
                                   : Point<Space>((before(s, force, j) + behind(s, force, j)) / 2));
    }
    for (const int j : marked())
      if (j > 0 && j < n && j % stride_ == 0) see_sides(s, force, j);
  }

 private:
  Point<Space> before(const RodSolution<Space>& s, std::span<const Point<Space>> force,
                      int j) const {
    return force[j - 1] - loads_.share(j - 1, s.curve.frames[j - 1]);
  }
  Point<Space> behind(const RodSolution<Space>& s, std::span<const Point<Space>> force,
                      int j) const {
    return force[j] + loads_.share(j, s.curve.frames[j]);
  }

  std::vector<int> marked() const {
    std::vector<int> out = kinks(rod_, loads_);
    for (const auto& held : held_) out.push_back(held.vertex);
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
  }

  const HeldVertex<Space>* holding(int j) const {
    for (const auto& held : held_)
      if (held.vertex == j && held.frame) return &held;
    return nullptr;
  }

  /// Beside an applied moment, theory (22): those of the cell, less what of it the edge there
  /// feels.
  void see_sides(RodSolution<Space>& s, std::span<const Point<Space>> force, int j) const {
    const std::size_t J = std::size_t(j / stride_);
    const HeldVertex<Space>* held = holding(j);
    const auto sides = rod_.sides(j);
    Before<Space> out{int(J), before(s, force, j), s.strains.K[J],
                      held ? held->moment_before : s.moment[J], false};
    s.vertex_force[J] = behind(s, force, j);
    const bool jumps = std::ranges::binary_search(rod_.jumps, j, {}, &Jump<Space>::vertex);
    bool moments = false;
    for (const auto& c : loads_.vertex_moments) {
      if (c.vertex != j || c.on_node) continue;
      out.moment += c.follows ? rotate_spin(s.curve.frames[j - 1], c.before) : c.before;
      s.moment[J] -= c.follows ? rotate_spin(s.curve.frames[j], c.behind) : c.behind;
      moments = true;
    }
    if (held || jumps || moments) {
      auto& q = s.vertex_frames[J];
      q = held ? q * principal(q.conjugate() * *held->frame)
               : frame_between(s.curve, sides, out.moment, s.moment[J]);
      const Spin<Space> M = rotate_spin(q.conjugate(), s.moment[J]);
      out.K = sides.K_before(rotate_spin(q.conjugate(), out.moment));
      out.halves = !held;
      if (moments && !held)
        s.bend_twist_energy += energy(sides, rotate_spin(q.conjugate(), out.moment), M) -
                               energy(sides, s.material_moment[J], s.material_moment[J]);
      s.material_moment[J] = M;
      s.strains.K[J] = sides.K_behind(M);
    }
    s.before.push_back(out);
  }

  /// Of the halves of a cell under their moments: beside an applied one they are not their mean.
  double energy(const Jump<Space>& sides, const Spin<Space>& before,
                const Spin<Space>& behind) const {
    const int j = sides.vertex;
    return (rod_.grid.h(j - 1) * before.dot(before.cwiseQuotient(sides.bending_before)) +
            rod_.grid.h(j) * behind.dot(behind.cwiseQuotient(sides.bending_behind))) /
           4;
  }

  /// The half of a cell before its vertex turns by what the moment there makes of it, and half of
  /// what is left.
  Rotation frame_between(const CosseratCurve<Space>& curve, const Jump<Space>& sides,
                         const Spin<Space>& m_before, const Spin<Space>& m_behind) const {
    const int j = sides.vertex;
    const Spin<Space> u = turn(curve, j);
    const Rotation back = moved(curve.frames[j - 1], Spin<Space>(u / 2)).conjugate();
    return moved(curve.frames[j - 1],
                 sides.turn_before(u, rotate_spin(back, m_before), rotate_spin(back, m_behind),
                                   rod_.grid.h(j - 1), rod_.grid.h(j)));
  }

  const Rod<Space>& rod_;
  const Loads<Space>& loads_;
  Held held_;
  int stride_;
};

/// The frames at the vertices in the middle between every `stride`-th.
template <class Space>
std::vector<typename Space::Rotation> centre_frames(const Grid& grid,
                                                    const CosseratCurve<Space>& curve, int stride) {
  std::vector<typename Space::Rotation> out;
  out.reserve(std::size_t(grid.edges() / stride));
  for (int j = stride / 2; j < grid.edges(); j += stride)
    out.push_back(vertex_frame(grid, curve, j));
  return out;
}

}  // namespace pyrod
