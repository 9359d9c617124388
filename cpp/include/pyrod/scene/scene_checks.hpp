// SPDX-License-Identifier: BSD-3-Clause
/// \file What scenes are asked before they are solved.
#pragma once

#include <pyrod/core/definition.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/support_parts.hpp>

#include <algorithm>
#include <cstddef>
#include <variant>

namespace pyrod {

PYROD_DEFINITION void Scene::check_places() const {
  require(!rods.empty(), "rods: expected at least one");
  require(!supports.empty() || !joints.empty(),
          "supports: nothing holds the rod, so it has no equilibrium; give a Clamp or another "
          "support");
  const auto check = [&](int rod, const char* name) {
    require(rod >= 0 && rod < int(rods.size()), name, ": there is no rod ", rod, ", the scene has ",
            rods.size());
  };
  for (const auto& support : supports) check(place_of(support).rod, "at");
  for (const auto& joint : joints)
    for (const auto& place : joint.points) check(place.rod, "at");
  for (const auto& load : loads)
    if (const auto rod = rod_of(load)) check(*rod, point_of(load) ? "at" : "rod");
  for (const auto& actuator : actuators) {
    const auto& tendon = std::get<Tendon>(actuator);
    check(tendon.rod, "rod");
    tendon.check(rods[std::size_t(tendon.rod)].length());
  }
}

PYROD_DEFINITION bool Scene::chooses_edges() const {
  return std::ranges::any_of(rods, [](const auto& rod) { return rod.chooses; });
}

PYROD_DEFINITION bool Scene::has_followers() const { return std::ranges::any_of(loads, follows); }

}  // namespace pyrod
