// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a whole scene, and how it was found.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/rounding.hpp>
#include <pyrod/statics/solution/softness.hpp>

#include <utility>
#include <vector>

namespace pyrod {

/// How a solve went.
struct Course {
  Status status = Status::out_of_iterations;
  int index = -1;  ///< number of unstable modes; −1: unknown, or the loads have no potential
  double residual = 0, fill = 1;
  int unknowns = 0, multipliers = 0;
  int load_steps = 0;            ///< 0: all loads at once
  int descents = 0;              ///< saddles that the search left along their unstable modes
  bool neutral = false;          ///< it can move along its mode without a change of energy
  double lowest_eigenvalue = 0;  ///< if it was asked for, [N m]: of ∫ |φ|² ds/L
  Rounding rounding;             ///< if it was asked for
  Softness softness;             ///< if the loads have a potential
  std::vector<Iteration> record;

  bool converged() const { return status == Status::converged; }
};

/// A tendon in equilibrium.
template <class Space>
struct TendonSolution {
  double tension = 0, length = 0;
  bool slack = false;                                 ///< longer than its way, of given length
  Point<Space> force_on_base = Point<Space>::Zero();  ///< what it exerts where it begins
};

template <class Space>
struct Solution : Course {
  std::vector<RodSolution<Space>> rods;
  std::vector<NodeSolution<Space>> nodes;
  std::vector<TendonSolution<Space>> tendons = {};
  std::vector<Spin<Space>> mode;  ///< of the edges, material [rad]; if asked for, or neutral
};

/// A solution in the frame of `at`, put where that is.
template <class Space>
Solution<Spatial> placed(Solution<Space>&& local, const Placement<Spatial>& at) {
  Solution<Spatial> out;
  static_cast<Course&>(out) = std::move(static_cast<Course&>(local));
  out.rods.reserve(local.rods.size()), out.nodes.reserve(local.nodes.size());
  for (const auto& rod : local.rods) out.rods.push_back(placed(rod, at));
  for (const auto& v : local.nodes)
    out.nodes.push_back({at.position + rotate(at.frame, embed(v.position)),
                         rotate(at.frame, embed(v.reaction_force)), at.frame * embed(v.frame),
                         rotate(at.frame, embed_spin(v.reaction_moment))});
  for (const auto& tendon : local.tendons)
    out.tendons.push_back({tendon.tension, tendon.length, tendon.slack,
                           Vec3(rotate(at.frame, embed(tendon.force_on_base)))});
  out.mode.reserve(local.mode.size());
  for (const auto& φ : local.mode) out.mode.push_back(embed_spin(φ));
  return out;
}

}  // namespace pyrod
