// SPDX-License-Identifier: BSD-3-Clause
/// \file How a scene is solved: on its edges or to a tolerance.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/statics/doubts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/ladder/climb.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/solver.hpp>

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
  /// `tol`: none, for the edges as they are.
  SceneSolve(const ReadyScene& ready, const S& settings, std::optional<double> tol)
      : ready_(ready), settings_(settings), tol_(tol) {}

  Equilibrium solve(const Start& start) const {
    if (start) require_frames(start->frames, ready_.edges(), "start");
    Equilibrium out;
    out.made = network().network.rods;
    in_space(scene().space, [&]<class Space>(Space) {
      if (tol_)
        climb<Space>(start, out);
      else
        out.found = run<Space>(*ready_.template posed<Space>(), start, settings_.options, more(),
                               settings_.trace);
    });
    react(out);
    refuse_drift(out);
    out.doubts = doubts_of(out, settings_.stable);
    return out;
  }

 private:
  const Scene& scene() const { return ready_.scene(); }
  const SceneNetwork& network() const { return ready_.network(); }

  template <class Space>
  void climb(const Start& start, Equilibrium& out) const {
    const auto levels = [this](int level) { return ready_.template posed<Space>(level); };
    auto climbed = pyrod::climb<Space>(
        levels, out.made, ready_.corners(), start,
        {*tol_, settings_.options, more(), settings_.trace, settings_.progress});
    out.found = std::move(climbed.solution);
    const auto& [unresolved, reason] = ready_.smoothness();
    out.accuracy = Accuracy{*tol_, climbed.reached, reason, unresolved};
  }

  NetworkOptions more() const {
    return {.stable = settings_.stable, .eigenvalue = settings_.eigenvalue};
  }

  void react(Equilibrium& out) const {
    for (std::size_t i = 0; i < scene().supports.size(); ++i) {
      const auto& at = place_of(scene().supports[i]);
      const auto& rod = out.found.rods[std::size_t(at.rod)];
      out.held.push_back(rod.curve.positions[std::size_t(ready_.grid().vertex(at))]);
      const auto& node = out.found.nodes[std::size_t(network().support_nodes[i])];
      out.reactions.push_back({node.reaction_force, node.reaction_moment});
    }
  }

  /// Forces that follow the rods, in directions in which nothing holds these: no equilibrium. Of
  /// dead forces it is known before the solve.
  void refuse_drift(const Equilibrium& out) const {
    if (!out.converged() || !scene().has_followers()) return;
    Vec3 left = Vec3::Zero();
    double sizes = 0, rounding = 0;
    for (const auto& rod : out.made) {
      const double L = rod.grid.length();
      for (const auto& C : rod.bending)
        rounding = std::max(rounding, 1e-13 * C.maxCoeff() / (L * L));
    }
    const auto act = [&](const Vec3& F) { left += F, sizes += F.norm(); };
    for (const auto& rod : out.found.rods)
      for (const auto& F : rod.load) act(F);
    for (const auto& reaction : out.reactions) act(reaction.force);
    for (std::size_t i = 0; i < out.reactions.size(); ++i) {
      const auto& node = network().network.nodes[std::size_t(network().support_nodes[i])];
      if (node.spring == 0) left -= node.free * (node.free.transpose() * out.reactions[i].force);
    }
    require(left.norm() <= 1e-6 * sizes + rounding,
            "supports: nothing holds the rods against the force ", left.transpose(),
            " of the loads that follow them; hold a point of them");
  }

  const ReadyScene& ready_;
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

  /// Other numbers, in what nobody else uses.
  void change(Scene scene) {
    plain.change(with_vertices_at_places(scene, false));
    given = std::move(scene);
    once = std::make_unique<std::once_flag>();
    climbing.reset();
  }
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
  const auto tol = tolerance(settings);
  if (tol) require(*tol > 0 && *tol <= 0.1, "tol: must be a number in (0, 0.1], got ", *tol);
  settings.options.check();
  const ReadyScene& ready = tol ? climbing() : plain();
  return detail::SceneSolve<S>(ready, settings, tol)
      .solve(detail::known_start(settings, plain(), ready));
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(Scene changed, const S& settings) {
  auto next = std::move(spare_);
  if (next.use_count() == 1)
    next->change(std::move(changed));
  else  // there is none yet, or copies have it
    next = std::make_shared<Parts>(std::move(changed));
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
  if (!settings.start && settings.frames.empty() && last_ && fits(*last_, settings))
    from.start = &last_->found;
  Equilibrium found = std::as_const(*this).solve(from);
  if (from.start != settings.start && !found.converged() && found.status() != Status::interrupted)
    found = std::as_const(*this).solve(settings);
  if (found.converged()) last_ = Last{found, turns()};
  return found;
}

template <std::same_as<Settings> S>
bool SceneSolver<S>::fits(const Last& last, const S& settings) const {
  const auto on = [&](const ReadyScene& ready) {
    return std::ranges::equal(ready.network().network.rods, last.found.found.rods,
                              [](const auto& rod, const auto& solved) {
                                return rod.edges() == int(solved.curve.frames.size());
                              });
  };
  // full turns are in the shape alone: no equation tells how many there are
  return last.turns == turns() && (on(plain()) || (tolerance(settings) && on(climbing())));
}

template <std::same_as<Settings> S>
std::vector<int> SceneSolver<S>::turns() const {
  std::vector<int> out;
  for (const auto& a : plain().network().network.attachments) out.push_back(a.turns);
  return out;
}

}  // namespace pyrod
