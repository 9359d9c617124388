// SPDX-License-Identifier: BSD-3-Clause
/// \file How branches of scenes, planar or spatial, are followed.
#pragma once

#include <pyrod/core/definition.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/paths/branch.hpp>
#include <pyrod/paths/branch_in_space.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/scene_between.hpp>

#include <cmath>
#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>
#include <variant>

namespace pyrod {

PYROD_DEFINITION SceneFamily::SceneFamily(Scene first, Scene second)
    : line_(std::make_shared<const std::pair<Scene, Scene>>(std::move(first), std::move(second))),
      scene_([line = line_](double λ) { return scene_between(line->first, line->second, λ); }) {}

template <std::same_as<PathSettings> S>
struct SceneBranch<S>::Parts {
  std::variant<BranchInSpace<Planar>, BranchInSpace<Spatial>> either;

  template <class Use>
  auto visit(Use&& use) const {
    return std::visit(use, either);
  }
};

template <std::same_as<PathSettings> S>
SceneBranch<S>::SceneBranch(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {
  tell();
}

template <std::same_as<PathSettings> S>
SceneBranch<S>::SceneBranch(SceneFamily family, const S& settings) {
  require(std::isfinite(settings.start) && std::isfinite(settings.stop) &&
              settings.start != settings.stop,
          "stop: must differ from start, and both be finite, got ", settings.start, " and ",
          settings.stop);
  require(settings.max_points > 0, "max_points: must be at least 1, got ", settings.max_points);
  const bool planar = family.scene(settings.start).space == Dimension::planar;
  const auto make = [&]<class Space>(Space) {
    return std::make_shared<const Parts>(Parts{BranchInSpace<Space>(std::move(family), settings)});
  };
  parts_ = planar ? make(Planar{}) : make(Spatial{});
  tell();
}

template <std::same_as<PathSettings> S>
void SceneBranch<S>::tell() {
  parts_->visit([this](const auto& branch) {
    for (const auto& point : branch.path().points) points_.push_back({point.λ, point.index});
    for (const auto& one : branch.path().special) special_.push_back(branch.told(one));
    ended_ = branch.path().ended;
    reason_ = branch.path().reason;
  });
}

template <std::same_as<PathSettings> S>
Equilibrium SceneBranch<S>::equilibrium(std::size_t point, bool eigenvalue) const {
  require(point < points_.size(), "point: there is no number ", point, ", the branch has ",
          points_.size());
  return parts_->visit([&](const auto& branch) { return branch.equilibrium(point, eigenvalue); });
}

template <std::same_as<PathSettings> S>
Equilibrium SceneBranch<S>::special_equilibrium(std::size_t number) const {
  require(number < special_.size(), "special: there is no number ", number, ", the branch has ",
          special_.size());
  return parts_->visit([&](const auto& branch) { return branch.special_equilibrium(number); });
}

template <std::same_as<PathSettings> S>
double SceneBranch<S>::derivative(std::size_t number, const SceneFamily& change,
                                  double apart) const {
  require(number < special_.size(), "special: there is no number ", number, ", the branch has ",
          special_.size());
  require(special_[number].kind == Singularity::fold && special_[number].index_before >= 0,
          "derivative: of folds under loads that have a potential only, this is a ",
          name(special_[number].kind), " point");
  require(apart > 0, "apart: must be positive, got ", apart);
  return parts_->visit(
      [&](const auto& branch) { return branch.derivative(number, change, apart); });
}

template <std::same_as<PathSettings> S>
SceneBranch<S> SceneBranch<S>::switched(std::size_t number, int side, const S& settings) const {
  require(number < special_.size(), "special: there is no number ", number, ", the branch has ",
          special_.size());
  require(special_[number].switches, "switch: no single branch crosses at a ",
          name(special_[number].kind), " point");
  return parts_->visit([&](const auto& branch) {
    return SceneBranch(
        std::make_shared<const Parts>(Parts{branch.switched(number, side, settings)}));
  });
}

}  // namespace pyrod
