// SPDX-License-Identifier: BSD-3-Clause
/// \file Clamped rods for tests. Their solver is compiled once, in cantilever.cpp.
#pragma once

#include <pyrod/statics/solving/solve.hpp>

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

template <class Space>
Solution<Space> solved(const Scene<Space>& scene, const Options& options = {},
                       const Trace& trace = {});

/// From given frames.
template <class Space>
Solution<Space> solved(const Scene<Space>& scene, std::vector<typename Space::Rotation> frames);

/// With rigid what the model excludes.
template <class Space, class Model, class... More>
Solution<Space> solved(Scene<Space> scene, More&&... more) {
  scene.rod = in_model(std::move(scene.rod), Model::kind);
  return solved<Space>(scene, std::forward<More>(more)...);
}

/// pyrod::solve
Solution<Spatial> solved(const Rod<Spatial>& rod, Dimension dimension, ModelKind model,
                         const Placement<Spatial>& clamp, const Loads<Spatial>& loads,
                         const std::vector<Quaternion>& start = {}, bool stable = true);

/// Everything at once, in units of the length and of force EI/L²: stiffness and rest curvature vary
/// along the rod, so do the edges; a force at the tip and one in the middle, weight, and moments.
/// The same rod for every even number of edges.
template <class Space>
Scene<Space> rich_scene(int edges, double length = 1, double stiffness = 1);

}  // namespace pyrod::test
