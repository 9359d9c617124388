// SPDX-License-Identifier: BSD-3-Clause
/// \file How a solver goes from solve to solve.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/sole_owner.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/scene_parts.hpp>
#include <pyrod/statics/scene_solve.hpp>
#include <pyrod/statics/solver.hpp>
#include <pyrod/statics/warm_start.hpp>

#include <concepts>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// What was found after a change, the full turns that were put in, and the edges of the rods.
template <std::same_as<Settings> S>
struct SceneSolver<S>::Last {
  Equilibrium found;
  WarmStart state;  ///< on the edges as they are
  std::vector<int> turns, edges;
};

template <std::same_as<Settings> S>
SceneSolver<S>::SceneSolver(Scene scene) : parts_(std::make_shared<SceneParts>(std::move(scene))) {}

template <std::same_as<Settings> S>
const Scene& SceneSolver<S>::scene() const {
  return parts_->given();
}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::plain() const {
  return parts_->plain();
}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::climbing() const {
  return parts_->climbing();
}

template <std::same_as<Settings> S>
std::optional<double> SceneSolver<S>::tolerance(const S& settings) const {
  if (!settings.tol && plain().scene().chooses_edges()) return 1e-6;
  return settings.tol;
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(const S& settings) const {
  return solve(settings, nullptr);
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(const S& settings, WarmStart* reached) const {
  const auto tol = tolerance(settings);
  if (tol) require(*tol > 0 && *tol <= 0.1, "tol: must be a number in (0, 0.1], got ", *tol);
  settings.options.check();
  const std::shared_ptr<const ReadyScene> ready(parts_, tol ? &climbing() : &plain());
  const auto start = [&] {
    auto known = detail::known_start(settings, plain(), *ready);
    if (known) require_frames(known->frames, ready->edges(), "start");
    return known;
  };
  return detail::SceneSolve<S>(ready, settings, tol).solve(start, reached);
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(Scene changed, const S& settings) {
  auto next = std::move(spare_);
  behind_.reset();
  if (is_sole_owner(next))
    next->change(std::move(changed));
  else  // there is none yet, or copies have it
    next = std::make_shared<SceneParts>(std::move(changed));
  return solve_next(std::move(next), settings);
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(const Changes& changes, const S& settings) {
  auto next = std::move(spare_);
  const auto behind = std::exchange(behind_, std::nullopt);
  if (behind && is_sole_owner(next)) {
    Changes all = *behind;
    all.add(changes);
    next->change(all);
  } else {
    Scene scene = parts_->given();
    changes.apply(scene);
    next = std::make_shared<SceneParts>(std::move(scene));
  }
  auto found = solve_next(std::move(next), settings);
  behind_ = changes;
  return found;
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve_next(std::shared_ptr<SceneParts> next, const S& settings) {
  std::swap(parts_, next);
  try {
    auto found = solve_from_last(settings);
    spare_ = std::move(next);
    return found;
  } catch (...) {  // also what functions of arc length, or whoever looks on, may throw
    std::swap(parts_, next);
    spare_ = std::move(next);
    throw;
  }
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve_from_last(const S& settings) {
  S from = settings;
  WarmStart reached;
  const bool warm = !settings.start && settings.frames.empty() && last_ && fits(*last_, settings);
  const bool climbs = tolerance(settings).has_value();
  if (warm) {
    from.start = &last_->found;
    if (!climbs) reached = last_->state;
  }
  Equilibrium found = std::as_const(*this).solve(from, &reached);
  if (warm && !found.converged() && found.status() != Status::interrupted) {
    reached = {};
    found = std::as_const(*this).solve(settings, &reached);
  }
  if (found.converged())
    last_ = std::make_shared<const Last>(
        Last{found, reached, turns(), edges_of(climbs ? climbing() : plain())});
  return found;
}

template <std::same_as<Settings> S>
bool SceneSolver<S>::fits(const Last& last, const S& settings) const {
  // full turns are in the shape alone: no equation tells how many there are
  return last.turns == turns() && (last.edges == edges_of(plain()) ||
                                   (tolerance(settings) && last.edges == edges_of(climbing())));
}

template <std::same_as<Settings> S>
std::vector<int> SceneSolver<S>::edges_of(const ReadyScene& ready) {
  std::vector<int> out;
  for (const auto& rod : ready.network().network.rods) out.push_back(rod.edges());
  return out;
}

template <std::same_as<Settings> S>
std::vector<int> SceneSolver<S>::turns() const {
  std::vector<int> out;
  for (const auto& a : plain().network().network.attachments) out.push_back(a.turns);
  return out;
}

}  // namespace pyrod
