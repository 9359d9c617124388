// SPDX-License-Identifier: BSD-3-Clause
/// \file A solve that is ready to be run, alone or among many on several threads.
#pragma once

#include "bind.hpp"

#include <pyrod/statics/ladder.hpp>
#include <pyrod/statics/loads.hpp>
#include <pyrod/statics/network_start.hpp>

#include <optional>

namespace pyrod::bind {

/// Loads together with the grid they are brought to, and with how that is done on finer ones.
/// Places are found once, on the grid of level 0, whose edges this one has cut in `parts`.
struct GridLoads {
  using Recipe = std::function<void(Loads<Spatial>&, const Grid&, int parts)>;

  Grid places, grid;
  EndCurvature<Spatial> K0;
  Loads<Spatial> loads;
  std::vector<Vec3> bending;  ///< of the rod, at the vertices
  int parts = 1;
  std::vector<Recipe> recipes = {};

  explicit GridLoads(const Rod<Spatial>& rod) : GridLoads(rod, rod.grid) {}

  GridLoads(const Rod<Spatial>& rod, const Grid& level0)
      : places(level0),
        grid(rod.grid),
        K0{rod.K0.front(), rod.K0.back()},
        loads(rod.edges()),
        bending(rod.bending),
        parts(rod.edges() / level0.edges()) {
    require(parts * level0.edges() == rod.edges(),
            "rod: its edges must be those of level 0, cut: ", rod.edges(), " are no multiple of ",
            level0.edges());
  }

  void add(Recipe recipe) {
    recipe(loads, grid, parts);
    recipes.push_back(std::move(recipe));
  }

  /// 1/C at the vertex nearest to a place on level 0.
  Vec3 compliance(const Site& at) const {
    const Site here = at.refined(parts);
    return bending[std::size_t(here.edge + (here.part >= 0.5))].cwiseInverse();
  }

  /// On a finer grid; `this` is on that of level 0.
  Loads<Spatial> on(const Grid& finer) const {
    Loads<Spatial> out(finer.edges());
    for (const auto& recipe : recipes) recipe(out, finer, finer.edges() / grid.edges());
    return out;
  }
};

/// What a job finds; of one to a tolerance also what was reached.
struct Outcome {
  SceneSolution solution;
  std::optional<Reached> reached;
};

/// `keep`: what Python must not let go of before the work is done.
struct Job {
  std::function<Outcome(const Trace&)> work;
  std::vector<py::object> keep;
  std::function<py::object()> so_far = [] { return py::none(); };  ///< of a climb, see `SoFar`
};

/// Frames (and nodes) to start from; of a rod of so many edges.
std::optional<NetworkStart> start_of(const std::optional<py::tuple>& given);
std::vector<Quaternion> start_frames(const std::optional<py::tuple>& given, int edges);

}  // namespace pyrod::bind
