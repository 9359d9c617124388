// SPDX-License-Identifier: BSD-3-Clause
/// \file Clamped rods for tests. Their solver is compiled once, in cantilever.cpp.
#pragma once

#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>

#include "support/models.hpp"

namespace pyrod::test {

template <class Space>
struct Scene {
  Rod<Space> rod;
  Loads<Space> loads{rod.edges()};
  Point<Space> r0 = Point<Space>::Zero();
  typename Space::Rotation q0 = Space::Rotation::Identity();
};

/// A uniform rod with nothing on it.
template <class Space>
Scene<Space> uniform_scene(int edges, const Spin<Space>& bending, const Point<Space>& stretching,
                           const Spin<Space>& K0 = Spin<Space>::Zero(), double length = 1) {
  return {Rod<Space>::uniform(Grid::uniform(length, edges), bending, stretching, K0)};
}

/// The network of a rod that a node holds at its start in position and frame, and nothing else.
template <class Space>
Network<Space> clamped(const Rod<Space>& rod, const Placement<Space>& clamp,
                       const Loads<Space>& loads) {
  constexpr int dim = Space::dim, spin = Space::spin;
  Network<Space> out{{rod}, {clamp}, {loads}, {}, {}};
  out.nodes.push_back(
      {clamp.position, Directions<dim>(dim, 0), clamp.frame, Directions<spin>(spin, 0)});
  out.attachments.push_back({0, 0, 0, true});
  return out;
}

/// A rod in equilibrium, and how it was found.
template <class Space>
struct Solved : RodSolution<Space> {
  Status status;
  int index;
  double residual;
  int load_steps;
  std::vector<Iteration> record;

  double energy() const { return this->bend_twist_energy + this->stretch_shear_energy; }
};

/// `stable`: saddles are left.
template <class Space>
Solved<Space> solved(const Scene<Space>& scene, const Options& options = {},
                     const Trace& trace = {}, bool stable = true);

/// From given frames.
template <class Space>
Solved<Space> solved(const Scene<Space>& scene, std::vector<typename Space::Rotation> frames);

/// With rigid what the model excludes.
template <class Space, class Model, class... More>
Solved<Space> solved(Scene<Space> scene, More&&... more) {
  scene.rod = in_model(std::move(scene.rod), Model::kind);
  return solved<Space>(scene, std::forward<More>(more)...);
}

/// In the plane of the clamp or in space, as told at run time.
Solved<Spatial> solved(const Rod<Spatial>& rod, Dimension dimension, ModelKind model,
                       const Placement<Spatial>& clamp, const Loads<Spatial>& loads,
                       const std::vector<Quaternion>& start = {}, bool stable = true);

/// Everything at once, in units of the length and of force EI/L²: stiffness and rest curvature vary
/// along the rod, so do the edges; a force at the tip and one in the middle, weight, and moments.
/// The same rod for every even number of edges.
template <class Space>
Scene<Space> rich_scene(int edges, double length = 1, double stiffness = 1);

}  // namespace pyrod::test
