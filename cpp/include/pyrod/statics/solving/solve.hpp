// SPDX-License-Identifier: BSD-3-Clause
/// \file One call for every clamped rod: plane or space chosen at run time, results always in
/// space.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/scene_solution.hpp>
#include <pyrod/statics/solving/cantilever.hpp>
#include <pyrod/statics/solving/network_run.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <concepts>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
Solution<Spatial> placed(const Solution<Space>& local, const Placement<Spatial>& clamp) {
  Solution<Spatial> out;
  static_cast<RodSolution<Spatial>&>(out) =
      placed(static_cast<const RodSolution<Space>&>(local), clamp);
  out.curve.start_frame = clamp.frame;
  out.status = local.status;
  out.index = local.index;
  out.residual = local.residual;
  out.load_steps = local.load_steps;
  out.record = local.record;
  return out;
}

inline SceneSolution scene_solution(Solution<Spatial>&& from, int unknowns) {
  SceneSolution out;
  out.status = from.status;
  out.index = from.index;
  out.residual = from.residual;
  out.load_steps = from.load_steps;
  out.unknowns = unknowns;
  out.record = std::move(from.record);
  out.rods.push_back(std::move(static_cast<RodSolution<Spatial>&>(from)));
  return out;
}

/// Equilibrium of a rod held by `clamp` under dead loads; a saddle is told by its index. `start`:
/// frames of the edges to start from, trusted to be near; none: the shape at rest.
template <class Space>
Solution<Spatial> solve(const Rod<Spatial>& rod, const Placement<Spatial>& clamp,
                        const Loads<Spatial>& loads, const std::vector<Quaternion>& start = {},
                        const Options& options = {}, const Trace& trace = {}) {
  require_rotation(clamp.frame, "clamp.frame");
  require_finite(clamp.position, "clamp.position");
  if (!start.empty()) require_frames(start, rod.edges(), "start");
  const Cantilever<Space> scene(restricted<Space>(rod), Point<Space>::Zero(),
                                Space::Rotation::Identity(), restricted<Space>(loads, clamp.frame));
  if (start.empty()) return placed(scene.solve(options, trace), clamp);
  return placed(scene.solve(restricted<Space>(start, clamp.frame), options, trace), clamp);
}

/// The network of a rod that `clamp` holds at its start: for loads that follow, and to leave
/// saddles.
inline Network<Spatial> held(const Rod<Spatial>& rod, const Placement<Spatial>& clamp,
                             const Loads<Spatial>& loads) {
  Network<Spatial> out{{rod}, {{clamp.position, clamp.frame}}, {loads}, {}, {}};
  out.nodes.push_back({clamp.position, Directions<3>(3, 0), clamp.frame, Directions<3>(3, 0)});
  out.attachments.push_back({0, 0, 0, true});
  return out;
}

/// What a run found of the rod of a network that has one.
template <class Space>
Solution<Spatial> the_rod(NetworkRun<Space>&& run) {
  Solution<Spatial> out;
  static_cast<RodSolution<Spatial>&>(out) = std::move(run.rods[0]);
  out.status = run.result.status;
  out.index = run.result.index;
  out.residual = run.result.residual;
  out.load_steps = run.result.load_steps;
  out.record = std::move(run.result.record);
  return out;
}

/// Equilibrium of a rod held by `clamp`, with the space chosen at run time, by whatever it
/// takes: loads that follow are solved as a network. So is a saddle, to leave it along its unstable
/// mode, if a `stable` equilibrium is wanted. A template, so that only who calls it compiles all
/// the solvers.
template <std::same_as<Spatial> S>
Solution<S> solve(const Rod<S>& rod, Dimension dimension, ModelKind model,
                  const Placement<Spatial>& clamp, const Loads<S>& loads,
                  const std::vector<Quaternion>& start = {}, const Options& options = {},
                  const Trace& trace = {}, bool stable = true) {
  const auto of_model = in_model(rod, model);
  return in_space(dimension, [&]<class Space>(Space) {
    const auto as_network = [&](const std::vector<Quaternion>& frames) {
      const auto from = frames.empty() ? std::nullopt : std::optional(NetworkStart{frames, {}, {}});
      return the_rod(run<Space>(held(of_model, clamp, loads), clamp, from, options,
                                {.stable = stable}, trace));
    };
    if (loads.follow()) return as_network(start);
    auto found = solve<Space>(of_model, clamp, loads, start, options, trace);
    return stable && found.index > 0 ? as_network(found.curve.frames) : found;
  });
}

}  // namespace pyrod
