// SPDX-License-Identifier: BSD-3-Clause
/// \file Scenes that depend on a number, how they are followed, and what is told of a branch.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/statics/equilibrium.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace pyrod {

/// A scene for every value of a number: with the same rods, edges, supports and joints.
class SceneFamily {
 public:
  using Function = std::function<Scene(double)>;

  /// Any.
  explicit SceneFamily(Function scene) : scene_(std::move(scene)) {}
  /// The first at 0, the second at 1, and on that line: they differ in vectors of loads and in
  /// positions of supports. The quickest.
  SceneFamily(Scene first, Scene second);

  Scene scene(double λ) const { return scene_(λ); }
  /// The two of a line, or null.
  const std::pair<Scene, Scene>* line() const { return line_.get(); }

 private:
  std::shared_ptr<const std::pair<Scene, Scene>> line_;
  Function scene_;
};

struct PathSettings {
  double start = 0, stop = 1;  ///< a path also ends as far on the other side of `start`
  int max_points = 500;
  /// Sees how many points there are and the value at the last; returns false to stop.
  std::function<bool(int, double)> look = {};
  /// At `start`, any, stable or not; none: that which `solve` finds.
  const Equilibrium* from = nullptr;
  Options options = {};  ///< of the first solve
};

/// A point of a branch. The equilibrium is made when it is asked for.
struct BranchPoint {
  double value;
  int index;  ///< number of unstable modes; −1: the loads have no potential
};

/// Where a branch turns back, or another crosses it.
struct BranchSpecial {
  Singularity kind;
  double value, error;             ///< on these edges; of the search and of rounding
  int index_before, index_behind;  ///< along the branch
  std::size_t behind;              ///< so many points
  std::vector<Vec3> mode;          ///< of all edges, material; the largest component is 1
  bool switches;                   ///< whether the branch that crosses can be followed
};

}  // namespace pyrod
