// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene to be solved, once or again and again.
#pragma once

#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>

#include <concepts>
#include <memory>
#include <optional>
#include <vector>

namespace pyrod {

class ReadyScene;
class SceneParts;
class WarmStart;

/// Keeps what does not depend on how a scene is solved: its grids, network, and finer grids. It may
/// be copied, and used by several threads at once.
/// A template, so that only who solves a scene compiles all the solvers. `S`: `Settings`.
template <std::same_as<Settings> S>
class SceneSolver {
 public:
  /// Throws `InvalidArgument` for what cannot be held, joined or loaded so.
  explicit SceneSolver(Scene scene);

  /// The equilibrium. A solve that finds none does not throw, see `Equilibrium::status`.
  Equilibrium solve(const S& settings = {}) const;

  /// Of the scene with other numbers: places, frames, loads, stiffnesses, curvatures; and from now
  /// on. Starts from what this function found last; if nothing is found from there, or the grid is
  /// another, or the full turns are, as if that were not known. A scene that is refused changes
  /// nothing. Not for several threads at once: each takes a copy.
  Equilibrium solve(Scene changed, const S& settings = {});

  /// The same with some parts in the place of others. Other loads at the same places cost least.
  Equilibrium solve(const Changes& changes, const S& settings = {});

  /// What was found last is no start for the next solve.
  void forget() { last_.reset(); }

  /// The scene as it was given last.
  const Scene& scene() const;
  /// The scene as it is solved without a tolerance: with vertices where rods are held and joined.
  const ReadyScene& plain() const;
  /// As it is solved with one: also where loads act, and where functions jump or have kinks.
  const ReadyScene& climbing() const;

 private:
  struct Last;
  bool fits(const Last& last, const S& settings) const;
  std::vector<int> turns() const;
  static std::vector<int> edges_of(const ReadyScene& ready);
  std::optional<double> tolerance(const S& settings) const;
  Equilibrium solve(const S& settings, WarmStart* reached) const;
  Equilibrium solve_next(std::shared_ptr<SceneParts> next, const S& settings);
  Equilibrium solve_from_last(const S& settings);

  std::shared_ptr<SceneParts> parts_;
  std::shared_ptr<SceneParts>
      spare_;  ///< those of the scene before, whose numbering the next one takes
  std::optional<Changes> behind_;  ///< by which those are behind, if that is known
  std::shared_ptr<const Last> last_;
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
