// SPDX-License-Identifier: BSD-3-Clause
/// \file What a solver has of a scene, whatever it solves it for.
#pragma once

#include <pyrod/scene/changes.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/scene_breaks.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/statics/ready_scene.hpp>

#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

/// A scene as it was given, and as it is solved without a tolerance and with one.
class SceneParts {
 public:
  explicit SceneParts(Scene scene)
      : given_(std::move(scene)), plain_(with_vertices_at_places(given_, false)) {}

  const Scene& given() const { return given_; }
  /// With vertices where rods are held and joined.
  const ReadyScene& plain() const { return plain_; }
  /// Also where loads act, and where functions jump or have kinks: made when it is first asked for.
  const ReadyScene& climbing() const {
    std::call_once(*once_, [this] {
      auto scene = with_vertices_at_places(given_, true);
      auto smooth = add_vertices_at_breaks(scene, given_.loads);
      climbing_ = std::make_unique<ReadyScene>(std::move(scene), std::move(smooth));
    });
    return *climbing_;
  }

  /// Other numbers, in what nobody else uses. If they are refused, it must not be used any more.
  void change(Scene scene) {
    plain_.change(with_vertices_at_places(scene, false));
    given_ = std::move(scene);
    forget_climbing();
  }

  void change(const Changes& changes) {
    if (!keeps_vertices(changes)) {
      Scene scene = given_;
      changes.apply(scene);
      return change(std::move(scene));
    }
    changes.apply(given_);
    plain_.change(changes);
    forget_climbing();
  }

 private:
  void forget_climbing() {
    once_ = std::make_unique<std::once_flag>();
    climbing_.reset();
  }

  /// Whether nothing asks for other vertices, and loads need not be brought to them.
  bool keeps_vertices(const Changes& changes) const {
    return changes.rods.empty() && changes.joints.empty() && changes.actuators.empty() &&
           std::ranges::all_of(changes.supports,
                               [this](const auto& one) {
                                 const auto& [i, support] = one;
                                 return i < given_.supports.size() &&
                                        place_of(support) == place_of(given_.supports[i]);
                               }) &&
           std::ranges::all_of(changes.loads, [this](const auto& one) {
             return this->keeps_vertices(one.first, one.second);
           });
  }
  bool keeps_vertices(std::size_t i, const Load& load) const {
    if (i >= given_.loads.size()) return false;
    const auto lists = [](const Load& one) {
      bool any = false;
      visit_along(one, [&](const Along<Vec3>& values, int, const char*) {
        any = any || std::holds_alternative<std::vector<Vec3>>(values);
      });
      return any;
    };
    if (lists(load) || lists(given_.loads[i])) return false;
    const auto *now = point_of(load), *before = point_of(given_.loads[i]);
    return (!now && !before && rod_of(load) == rod_of(given_.loads[i])) ||
           (now && before && *now == *before);
  }

  Scene given_;
  ReadyScene plain_;
  mutable std::unique_ptr<std::once_flag> once_ = std::make_unique<std::once_flag>();
  mutable std::unique_ptr<ReadyScene> climbing_ = {};
};

}  // namespace pyrod
