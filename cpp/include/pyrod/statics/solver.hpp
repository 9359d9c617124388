// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene to be solved, once or again and again.
#pragma once

#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>

#include <concepts>
#include <memory>

namespace pyrod {

class ReadyScene;

/// Keeps what does not depend on how a scene is solved: its grids, network, and finer grids. It may
/// be copied, and used by several threads at once; those that ask for a tolerance take turns.
/// A template, so that only who solves a scene compiles all the solvers. `S`: `Settings`.
template <std::same_as<Settings> S>
class SceneSolver {
 public:
  /// Throws `InvalidArgument` for what cannot be held, joined or loaded so.
  explicit SceneSolver(Scene scene);

  /// The equilibrium. A solve that finds none does not throw, see `Equilibrium::status`.
  Equilibrium solve(const S& settings = {}) const;

  /// The scene as it is solved without a tolerance: with vertices where rods are held and joined.
  const ReadyScene& plain() const;
  /// As it is solved with one: also where loads act, and where functions jump or have kinks.
  const ReadyScene& climbing() const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

using Solver = SceneSolver<Settings>;

/// The equilibrium of a scene. Throws `InvalidArgument` before any work starts; a solve that finds
/// none does not throw, see `Equilibrium::status` and `advice`.
template <std::same_as<Settings> S = Settings>
Equilibrium solve(const Scene& scene, const S& settings = {}) {
  return SceneSolver<S>(scene).solve(settings);
}

#ifdef PYROD_COMPILED
extern template class SceneSolver<Settings>;
#endif

}  // namespace pyrod
