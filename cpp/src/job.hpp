// SPDX-License-Identifier: BSD-3-Clause
/// \file A solve that is ready to be run, alone or among many on several threads.
#pragma once

#include "bind.hpp"

#include <pyrod/statics/ladder.hpp>

#include <optional>

namespace pyrod::bind {

/// Loads together with the grid they are brought to, and with how that is done on a grid whose
/// edges are `parts`-ths.
struct GridLoads {
  using Recipe = std::function<void(Loads<Spatial>&, const Grid&, int parts)>;

  Grid grid;
  EndCurvature<Spatial> K0;
  Loads<Spatial> loads;
  std::vector<Vec3> bending;  ///< of the rod, at the vertices
  std::vector<Recipe> recipes = {};

  void add(Recipe recipe) {
    recipe(loads, grid, 1);
    recipes.push_back(std::move(recipe));
  }

  /// 1/C at the vertex nearest to s.
  Vec3 compliance(double s) const {
    const int n = grid.edges();
    int j = 0;
    while (j < n && grid.centre(j) <= s) ++j;
    return bending[std::size_t(j)].cwiseInverse();
  }

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
};

/// Frames (and nodes) to start from; of a rod of so many edges.
std::optional<NetworkStart> start_of(const std::optional<py::tuple>& given);
std::vector<Quaternion> start_frames(const std::optional<py::tuple>& given, int edges);

}  // namespace pyrod::bind
