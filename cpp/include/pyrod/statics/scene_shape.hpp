// SPDX-License-Identifier: BSD-3-Clause
/// \file What a solution of the network of a scene says of the scene.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/solution/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace pyrod {

/// With what the supports exert.
inline Shape shape_of(const ReadyScene& ready, Solution<Spatial> solution) {
  const auto& network = ready.network();
  const auto& supports = ready.scene().supports;
  Shape out{std::move(solution.rods)};
  for (std::size_t i = 0; i < supports.size(); ++i) {
    const auto& at = place_of(supports[i]);
    const auto& rod = out.rods[std::size_t(at.rod)];
    out.held.push_back(rod.curve.positions[std::size_t(ready.grid().vertex(at))]);
    const auto& node = solution.nodes[std::size_t(network.support_nodes[i])];
    out.reactions.push_back({node.reaction_force, node.reaction_moment});
  }
  out.made = network.network.rods;
  out.tendons = std::move(solution.tendons);
  return out;
}

namespace detail {

/// Each rod by a point of its own, in all directions.
inline bool holds_all_rods(const Network<Spatial>& network) {
  std::vector<char> held(network.rods.size(), false);
  for (const auto& a : network.attachments)
    if (network.nodes[std::size_t(a.node)].free.cols() == 0) held[std::size_t(a.rod)] = true;
  return std::ranges::all_of(held, [](char one) { return one; });
}

/// What acts on rods and is not held, and the sum of its sizes.
inline std::pair<Vec3, double> not_held(const SceneNetwork& on, const Shape& shape) {
  Vec3 left = Vec3::Zero();
  double sizes = 0;
  const auto act = [&](const Vec3& F) { left += F, sizes += F.norm(); };
  for (const auto& rod : shape.rods)
    for (const auto& F : rod.load) act(F);
  for (const auto& reaction : shape.reactions) act(reaction.force);
  for (std::size_t i = 0; i < shape.reactions.size(); ++i) {
    const auto& node = on.network.nodes[std::size_t(on.support_nodes[i])];
    if (node.spring == 0) left -= node.free * (node.free.transpose() * shape.reactions[i].force);
  }
  return {left, sizes};
}

}  // namespace detail

/// Forces that follow the rods, in directions in which nothing holds these: no equilibrium. Of
/// dead forces it is known before the solve.
inline void refuse_drift(const ReadyScene& ready, const Equilibrium& found) {
  const auto& network = ready.network();
  if (!found.converged() || !ready.scene().has_followers() ||
      detail::holds_all_rods(network.network))
    return;
  double rounding = 0;
  for (const auto& rod : network.network.rods) {
    const double L = rod.grid.length();
    for (const auto& C : rod.bending) rounding = std::max(rounding, 1e-13 * C.maxCoeff() / (L * L));
  }
  const auto [left, sizes] = detail::not_held(network, found.shape());
  require(left.norm() <= 1e-6 * sizes + rounding,
          "supports: nothing holds the rods against the force ", left.transpose(),
          " of the loads that follow them; hold a point of them");
}

}  // namespace pyrod
