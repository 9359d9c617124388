// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibria of scenes that depend on a number, followed through folds and bifurcations.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/statics/equilibrium.hpp>

#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
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

/// Equilibria on the edges of the scenes, one behind the other. It may be copied; not for several
/// threads at once. A template, so that only who follows compiles it. `S`: `PathSettings`.
template <std::same_as<PathSettings> S>
class SceneBranch {
 public:
  /// Throws `InvalidArgument` where there is no family, or no equilibrium at the start.
  SceneBranch(SceneFamily family, const S& settings);

  const std::vector<BranchPoint>& points() const { return points_; }
  const std::vector<BranchSpecial>& special() const { return special_; }
  PathEnd ended() const { return ended_; }
  /// What was refused where the path was lost, in words, if anything was.
  const std::string& reason() const { return reason_; }

  /// At a point. `eigenvalue`: with the lowest one and its mode.
  Equilibrium equilibrium(std::size_t point, bool eigenvalue = false) const;
  /// At a special point; its mode is the one without stiffness.
  Equilibrium special_equilibrium(std::size_t number) const;

  /// How the value of a fold changes with t as the scene does, which at t = 0 is the one there.
  /// `apart`: over which is differenced, if two scenes on a line do not tell. Needs a potential.
  double derivative(std::size_t number, const SceneFamily& change, double apart) const;

  /// The branch that crosses at a special point, to the side where its mode has the sign `side`.
  SceneBranch switched(std::size_t number, int side, const S& settings) const;

 private:
  struct Parts;
  explicit SceneBranch(std::shared_ptr<const Parts> parts);
  void tell();

  std::shared_ptr<const Parts> parts_;
  std::vector<BranchPoint> points_;
  std::vector<BranchSpecial> special_;
  PathEnd ended_ = PathEnd::lost;
  std::string reason_;
};

using Branch = SceneBranch<PathSettings>;

/// Follows the equilibria of a family.
template <std::same_as<PathSettings> S = PathSettings>
SceneBranch<S> follow(SceneFamily family, const S& settings) {
  return SceneBranch<S>(std::move(family), settings);
}

#ifdef PYROD_COMPILED
extern template class SceneBranch<PathSettings>;
#endif

}  // namespace pyrod

#ifndef PYROD_COMPILED
#include <pyrod/paths/branch_parts.hpp>
#endif
