// SPDX-License-Identifier: BSD-3-Clause
/// \file How a scene is solved: as a cantilever or as a network, on its edges or to a tolerance.
#pragma once

#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/doubts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/ladder/level.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/solver.hpp>

#include <concepts>
#include <utility>

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
    const bool plain = is_cantilever(scene()) && settings_.stable && !settings_.eigenvalue;
    auto out = found(plain, start);
    if (!plain || out.found.index <= 0) return out;
    NetworkStart from;  // a saddle can be left as a network only
    from.frames = out.rod().curve.frames;
    return found(false, from);
  }

 private:
  const Scene& scene() const { return ready_.scene(); }
  const SceneNetwork& network() const { return ready_.network(); }
  const Rod<Spatial>& rod() const { return network().network.rods[0]; }

  Equilibrium found(bool cantilever, const Start& start) const {
    if (start) require_frames(start->frames, ready_.edges(), "start");
    Equilibrium out;
    out.made = network().network.rods;
    if (tol_)
      climb(cantilever, start, out);
    else
      out.found = cantilever ? as_cantilever(start) : as_network(start);
    react(out, cantilever);
    refuse_drift(out);
    out.doubts = doubts_of(out, settings_.stable);
    return out;
  }

  void climb(bool cantilever, const Start& start, Equilibrium& out) const {
    auto& ladder = ready_.ladder(cantilever, [&] { return level(cantilever); });
    auto climbed =
        ladder.climb(start, settings_.options, more(), *tol_, settings_.trace, settings_.progress);
    out.found = std::move(climbed.solution);
    const auto& [unresolved, reason] = ready_.smoothness();
    out.accuracy = Accuracy{*tol_, climbed.reached, reason, unresolved};
    if (!cantilever) return;  // its reactions are told by the forces and moments at the clamp
    auto& errors = out.accuracy->reached.errors;
    for (const auto& [told, by] : {std::pair(Quantity::reactions, Quantity::forces),
                                   std::pair(Quantity::reaction_moments, Quantity::moments)})
      errors[std::size_t(told)] = errors[std::size_t(by)];
  }

  NetworkOptions more() const {
    return {.stable = settings_.stable, .eigenvalue = settings_.eigenvalue};
  }

  SceneSolution as_cantilever(const Start& start) const {
    const auto frames = start ? start->frames : std::vector<Quaternion>{};
    return in_space(scene().space, [&]<class Space>(Space) {
      return scene_solution(pyrod::solve<Space>(rod(), network().plane, ready_.grid().loads(0),
                                                frames, settings_.options, settings_.trace),
                            rod().edges() * Space::spin);
    });
  }

  SceneSolution as_network(const Start& start) const {
    return in_space(scene().space, [&]<class Space>(Space) {
      return scene_solution(run<Space>(network().network, network().plane, start, settings_.options,
                                       more(), settings_.trace));
    });
  }

  /// The levels know the scene that is ready, and nothing of this solve.
  Level level(bool cantilever) const {
    return in_space(scene().space, [&]<class Space>(Space) -> Level {
      if (!cantilever)
        return network_level<Space>([&ready = ready_](int level) -> PlacedNetwork {
          const auto on = ready.network_on(level);
          return {on->network, on->plane};
        });
      return cantilever_level<Space>(
          [&ready = ready_](int level) -> LoadedRod {
            const auto on = ready.network_on(level);
            return {on->network.rods[0], on->network.loads[0]};
          },
          network().plane);
    });
  }

  /// A cantilever's reaction is what is missing to the balance at its clamp.
  void react(Equilibrium& out, bool cantilever) const {
    for (std::size_t i = 0; i < scene().supports.size(); ++i) {
      const auto& at = place_of(scene().supports[i]);
      const auto& found = out.found.rods[std::size_t(at.rod)];
      out.held.push_back(found.curve.positions[std::size_t(ready_.grid().vertex(at))]);
      if (!cantilever) {
        const auto& node = out.found.nodes[std::size_t(network().support_nodes[i])];
        out.reactions.push_back({node.reaction_force, node.reaction_moment});
        continue;
      }
      Vec3 sum = Vec3::Zero();
      for (const auto& F : found.load) sum += F;
      out.reactions.push_back({-sum, -found.moment[0] - ready_.grid().loads(0).start_moment});
    }
  }

  /// Forces that follow the rods, in directions in which nothing holds these: no equilibrium. Of
  /// dead forces it is known before the solve.
  void refuse_drift(const Equilibrium& out) const {
    if (!out.converged() || !scene().has_followers()) return;
    Vec3 left = Vec3::Zero();
    double sizes = 0;
    const auto act = [&](const Vec3& F) { left += F, sizes += F.norm(); };
    for (const auto& rod : out.found.rods)
      for (const auto& F : rod.load) act(F);
    for (const auto& reaction : out.reactions) act(reaction.force);
    for (std::size_t i = 0; i < out.reactions.size(); ++i) {
      const auto& node = network().network.nodes[std::size_t(network().support_nodes[i])];
      if (node.spring == 0) left -= node.free * (node.free.transpose() * out.reactions[i].force);
    }
    require(left.norm() <= 1e-6 * sizes, "supports: nothing holds the rods against the force ",
            left.transpose(), " of the loads that follow them; hold a point of them");
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
  std::once_flag once = {};
  std::unique_ptr<ReadyScene> climbing = {};

  explicit Parts(Scene scene)
      : given(std::move(scene)), plain(with_vertices_at_places(given, false)) {}
};

template <std::same_as<Settings> S>
SceneSolver<S>::SceneSolver(Scene scene) : parts_(std::make_shared<Parts>(std::move(scene))) {}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::plain() const {
  return parts_->plain;
}

template <std::same_as<Settings> S>
const ReadyScene& SceneSolver<S>::climbing() const {
  std::call_once(parts_->once, [&parts = *parts_] {
    auto scene = with_vertices_at_places(parts.given, true);
    auto smooth = add_vertices_at_breaks(scene, parts.given.loads);
    parts.climbing = std::make_unique<ReadyScene>(std::move(scene), std::move(smooth));
  });
  return *parts_->climbing;
}

template <std::same_as<Settings> S>
Equilibrium SceneSolver<S>::solve(const S& settings) const {
  auto tol = settings.tol;
  if (!tol && plain().scene().chooses_edges()) tol = 1e-6;
  if (tol) require(*tol > 0 && *tol <= 0.1, "tol: must be a number in (0, 0.1], got ", *tol);
  settings.options.check();
  const ReadyScene& ready = tol ? climbing() : plain();
  return detail::SceneSolve<S>(ready, settings, tol)
      .solve(detail::known_start(settings, plain(), ready));
}

}  // namespace pyrod
