// SPDX-License-Identifier: BSD-3-Clause
/// \file How a scene is solved: on its edges or to a tolerance.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/doubts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/ladder/climb.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/scene_shape.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/strained.hpp>
#include <pyrod/statics/solver.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/warm_start.hpp>

#include <algorithm>
#include <concepts>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

namespace detail {

/// One solve of a scene that is ready. `S`: `Settings`.
template <class S>
class SceneSolve {
 public:
  /// `ready`: who asks for the shape later still needs it. `tol`: none, for the edges as they are.
  SceneSolve(std::shared_ptr<const ReadyScene> ready, const S& settings, std::optional<double> tol)
      : ready_(std::move(ready)), settings_(settings), tol_(tol) {}

  /// `reached`: from where to start, if that fits, and where that led to; else from `start()`.
  template <class GetStart>
  Equilibrium solve(const GetStart& start, WarmStart* reached) const {
    return in_space(ready_->scene().space, [&]<class Space>(Space) {
      if (tol_) return climb<Space>(start());
      const auto posed = ready_->template posed<Space>();
      const auto found = std::make_shared<const Found<Space>>(this->find(*posed, start, reached));
      if (reached && found->converged()) *reached = WarmStart(found, posed->here());
      return equilibrium<Space>(posed, found);
    });
  }

 private:
  template <class Space, class GetStart>
  Found<Space> find(const Posed<Space>& posed, const GetStart& start, const WarmStart* warm) const {
    if (warm)
      if (auto near = warm->state(posed))
        return find_near<Space>(posed, std::move(*near), settings_.options, more(),
                                settings_.trace);
    return pyrod::find<Space>(posed, start(), settings_.options, more(), settings_.trace);
  }

  /// Its shape is told when it is asked for.
  template <class Space>
  Equilibrium equilibrium(const std::shared_ptr<const Posed<Space>>& posed,
                          const std::shared_ptr<const Found<Space>>& found) const {
    Equilibrium out(*found, [ready = ready_, posed, found] {
      return shape_of(*ready, posed->in_space(told(*posed, *found)));
    });
    for (const auto& φ : found->mode) out.mode.push_back(embed_spin(φ));
    return checked(std::move(out), Strained<Space>(posed->problem(), found->state).perhaps());
  }

  template <class Space>
  Equilibrium climb(const Start& start) const {
    const auto levels = [this](int level) { return ready_->template posed<Space>(level); };
    auto climbed = pyrod::climb<Space>(
        levels, ready_->network().network.rods, ready_->corners(), start,
        {*tol_, settings_.options, more(), settings_.trace, settings_.progress});
    auto mode = std::move(climbed.solution.mode);
    Course course = climbed.solution;
    const auto& [unresolved, reason] = ready_->smoothness();
    Equilibrium out(std::move(course),
                    [ready = ready_, solution = std::move(climbed.solution)]() mutable {
                      return shape_of(*ready, std::move(solution));
                    });
    out.mode = std::move(mode);
    out.accuracy = Accuracy{*tol_, climbed.reached, reason, unresolved};
    return checked(std::move(out), true);
  }

  NetworkOptions more() const {
    return {.stable = settings_.stable, .eigenvalue = settings_.eigenvalue};
  }

  /// With all doubts; refuses what drifts. `look`: strains may be beyond what they mean.
  Equilibrium checked(Equilibrium&& out, bool look) const {
    refuse_drift(*ready_, out);
    out.doubts = doubts_of(out, settings_.stable, look);
    return std::move(out);
  }

  std::shared_ptr<const ReadyScene> ready_;
  const S& settings_;
  std::optional<double> tol_;
};

}  // namespace detail

template <std::same_as<Settings> S>
struct SceneSolver<S>::Parts {
  Scene given;
  ReadyScene plain;
  std::unique_ptr<std::once_flag> once = std::make_unique<std::once_flag>();
  std::unique_ptr<ReadyScene> climbing = {};

  explicit Parts(Scene scene)
      : given(std::move(scene)), plain(with_vertices_at_places(given, false)) {}

  /// Other numbers, in what nobody else uses. If they are refused, it must not be used any more.
  void change(Scene scene) {
    plain.change(with_vertices_at_places(scene, false));
    given = std::move(scene);
    once = std::make_unique<std::once_flag>();
    climbing.reset();
  }

  void change(const Changes& changes) {
    if (!changes.of_loads_only() || !std::ranges::all_of(changes.loads, [this](const auto& one) {
          return keeps_vertices(one.first, one.second);
        })) {
      Scene scene = given;
      changes.apply(scene);
      return change(std::move(scene));
    }
    changes.apply(given);
    plain.change_loads(changes.loads);
    once = std::make_unique<std::once_flag>();
    climbing.reset();
  }

 private:
  /// Whether a load does not ask for other vertices, and need not be made one on them.
  bool keeps_vertices(std::size_t i, const Load& load) const {
    if (i >= given.loads.size()) return false;
    const auto lists = [](const Load& one) {
      bool any = false;
      visit_along(one, [&](const Along<Vec3>& values, int, const char*) {
        any = any || std::holds_alternative<std::vector<Vec3>>(values);
      });
      return any;
    };
    if (lists(load) || lists(given.loads[i])) return false;
    const auto *now = point_of(load), *before = point_of(given.loads[i]);
    return (!now && !before && rod_of(load) == rod_of(given.loads[i])) ||
           (now && before && *now == *before);
  }
};

/// What was found after a change, the full turns that were put in, and the edges of the rods.
template <std::same_as<Settings> S>
struct SceneSolver<S>::Last {
  Equilibrium found;
  WarmStart state;  ///< on the edges as they are
  std::vector<int> turns, edges;
};

template <std::same_as<Settings> S>
SceneSolver<S>::SceneSolver(Scene scene) : parts_(std::make_shared<Parts>(std::move(scene))) {}

template <std::same_as<Settings> S>
const Scene& SceneSolver<S>::scene() const {
  return parts_->given;
}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::plain() const {
  return parts_->plain;
}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::climbing() const {
  std::call_once(*parts_->once, [&parts = *parts_] {
    auto scene = with_vertices_at_places(parts.given, true);
    auto smooth = add_vertices_at_breaks(scene, parts.given.loads);
    parts.climbing = std::make_unique<ReadyScene>(std::move(scene), std::move(smooth));
  });
  return *parts_->climbing;
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
  if (next.use_count() == 1)
    next->change(std::move(changed));
  else  // there is none yet, or copies have it
    next = std::make_shared<Parts>(std::move(changed));
  return solve_next(std::move(next), settings);
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(const Changes& changes, const S& settings) {
  auto next = std::move(spare_);
  const auto behind = std::exchange(behind_, std::nullopt);
  if (behind && next.use_count() == 1) {
    Changes all = *behind;
    all.add(changes);
    next->change(all);
  } else {
    Scene scene = parts_->given;
    changes.apply(scene);
    next = std::make_shared<Parts>(std::move(scene));
  }
  auto found = solve_next(std::move(next), settings);
  behind_ = changes;
  return found;
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve_next(std::shared_ptr<Parts> next, const S& settings) {
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
