// SPDX-License-Identifier: BSD-3-Clause
/// \file Scenes: rods, what holds and joins them, and what acts on them.
#pragma once

#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/joint.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/rod_spec.hpp>
#include <pyrod/scene/supports.hpp>

#include <utility>
#include <vector>

namespace pyrod {

/// A value like any other: what it is made of may be changed until it is solved, and after. Places
/// get vertices when it is; ends without a support or joint are free.
struct Scene {
  std::vector<RodSpec> rods;
  std::vector<Support> supports = {};
  std::vector<Load> loads = {};
  /// planar: the rods stay in the plane of the directors a1 and a3 of the first clamp (else of the
  /// first rod at rest), which takes a third of the unknowns. What leaves the plane is refused.
  Dimension space = Dimension::spatial;
  std::vector<Joint> joints = {};
  std::vector<Actuator> actuators = {};

  Scene(std::vector<RodSpec> several, std::vector<Support> held = {}, std::vector<Load> acting = {},
        Dimension in = Dimension::spatial, std::vector<Joint> joined = {},
        std::vector<Actuator> driven = {})
      : rods(std::move(several)),
        supports(std::move(held)),
        loads(std::move(acting)),
        space(in),
        joints(std::move(joined)),
        actuators(std::move(driven)) {}
  /// Of one rod.
  Scene(RodSpec rod, std::vector<Support> held = {}, std::vector<Load> acting = {},
        Dimension in = Dimension::spatial, std::vector<Joint> joined = {},
        std::vector<Actuator> driven = {})
      : Scene(std::vector{std::move(rod)}, std::move(held), std::move(acting), in,
              std::move(joined), std::move(driven)) {}

  /// Refuses places and loads on rods that there are not.
  void check_places() const;
  /// Whether the solver chooses the edges of a rod.
  bool chooses_edges() const;
  bool has_followers() const;
};

}  // namespace pyrod

#ifndef PYROD_COMPILED
#include <pyrod/scene/scene_checks.hpp>
#endif
