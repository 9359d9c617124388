// SPDX-License-Identifier: BSD-3-Clause
/// \file Parts of a scene that take the place of others.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/joint.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/rod_spec.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/supports.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

/// New parts by the numbers that those had whose place they take.
struct Changes {
  template <class T>
  using Of = std::vector<std::pair<std::size_t, T>>;

  Of<RodSpec> rods = {};
  Of<Support> supports = {};
  Of<Joint> joints = {};
  Of<Load> loads = {};
  Of<Actuator> actuators = {};

  /// These first, then others.
  void add(const Changes& more) {
    const auto append = [](auto& to, const auto& from) {
      to.insert(to.end(), from.begin(), from.end());
    };
    append(rods, more.rods), append(supports, more.supports);
    append(joints, more.joints), append(loads, more.loads);
    append(actuators, more.actuators);
  }

  /// Refuses numbers that the scene has not.
  void apply(Scene& scene) const {
    put(rods, scene.rods, "rods"), put(supports, scene.supports, "supports");
    put(joints, scene.joints, "joints"), put(loads, scene.loads, "loads");
    put(actuators, scene.actuators, "actuators");
  }

 private:
  template <class T>
  static void put(const Of<T>& parts, std::vector<T>& into, const char* name) {
    for (const auto& [i, part] : parts) {
      require(i < into.size(), name, ": there is no number ", i, ", the scene has ", into.size());
      into[i] = part;
    }
  }
};

}  // namespace pyrod
