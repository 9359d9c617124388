// SPDX-License-Identifier: BSD-3-Clause
/// \file What linearises scenes, planar or spatial.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/linearised.hpp>
#include <pyrod/linear/response_in_space.hpp>
#include <pyrod/linear/scene_change.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/scene_solver.hpp>

#include <concepts>
#include <memory>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

template <std::same_as<Settings> S>
struct LinearisedScene<S>::Parts {
  template <class Space>
  using Owned = std::unique_ptr<ResponseInSpace<Space>>;

  std::variant<Owned<Planar>, Owned<Spatial>> either;

  Parts(const ReadyScene& ready, const Equilibrium& near) {
    require(near.converged(), "linearised: this is no equilibrium, ", near.advice());
    if (ready.scene().space == Dimension::planar)
      either = std::make_unique<ResponseInSpace<Planar>>(ready, near);
    else
      either = std::make_unique<ResponseInSpace<Spatial>>(ready, near);
  }

  template <class Use>
  auto visit(Use&& use) const {
    return std::visit([&](const auto& owned) { return use(*owned); }, either);
  }
};

template <std::same_as<Settings> S>
LinearisedScene<S>::LinearisedScene(const SceneSolver<S>& scene, const Equilibrium& near)
    : parts_(std::make_shared<Parts>(scene.plain(), near)) {}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::numbers(const SceneSolver<S>& like) const {
  return parts_->visit([&](auto& r) { return r.numbers(like.plain()); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::of_forces(const std::vector<std::vector<Vec3>>& forces) const {
  return parts_->visit([&](auto& r) { return r.of_forces(forces); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::of_moments(const std::vector<std::vector<Vec3>>& moments) const {
  return parts_->visit([&](auto& r) { return r.of_moments(moments); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::of_moment(int rod, int vertex, const Vec3& moment) const {
  return parts_->visit([&](auto& r) { return r.of_moment(rod, vertex, moment); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::of_motion(int support, const Vec3& shift, const Vec3& turn) const {
  return parts_->visit([&](auto& r) { return r.of_motion(support, shift, turn); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::of_rod(int rod, const RodFields& fields) const {
  return parts_->visit([&](auto& r) { return r.of_rod(rod, fields); });
}

template <std::same_as<Settings> S>
RodFields LinearisedScene<S>::to_rod(int rod, const Vector& numbers) const {
  return parts_->visit([&](auto& r) { return r.to_rod(rod, numbers); });
}

template <std::same_as<Settings> S>
SceneChange LinearisedScene<S>::push(const Vector& numbers) const {
  return parts_->visit([&](auto& r) { return r.push(numbers); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::pull(const SceneChange& weights, Vector* rounding) const {
  return parts_->visit([&](auto& r) { return r.pull(weights, rounding); });
}

template <std::same_as<Settings> S>
std::vector<SceneChange> LinearisedScene<S>::free() const {
  return parts_->visit([](auto& r) { return r.free(); });
}

template <std::same_as<Settings> S>
std::vector<Vector> LinearisedScene<S>::pushes_freely() const {
  return parts_->visit([](auto& r) { return r.pushes_freely(); });
}

template <std::same_as<Settings> S>
Mat<6> LinearisedScene<S>::compliance(int rod, int vertex) const {
  return parts_->visit([&](auto& r) { return r.compliance(rod, vertex); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::weights() const {
  return parts_->visit([](auto& r) { return r.weights(); });
}

template <std::same_as<Settings> S>
Vector LinearisedScene<S>::solved(const Vector& rows) const {
  return parts_->visit([&](auto& r) { return r.solved(rows); });
}

template <std::same_as<Settings> S>
SceneChange LinearisedScene<S>::follow(const Vector& rows) const {
  return parts_->visit([&](auto& r) { return r.follow(rows); });
}

template <std::same_as<Settings> S>
SceneChange LinearisedScene<S>::empty() const {
  return parts_->visit([](auto& r) { return r.empty(); });
}

template <std::same_as<Settings> S>
bool LinearisedScene<S>::symmetric() const {
  return parts_->visit([](auto& r) { return r.symmetric(); });
}

}  // namespace pyrod
