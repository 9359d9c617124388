// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibria of scenes that depend on a number, followed through folds and bifurcations.
#pragma once

#include <pyrod/paths/scene_family.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/statics/equilibrium.hpp>

#include <concepts>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace pyrod {

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
