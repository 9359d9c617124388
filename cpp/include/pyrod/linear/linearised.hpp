// SPDX-License-Identifier: BSD-3-Clause
/// \file How the equilibrium of a scene answers to small changes of the scene.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/scene_change.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/solver.hpp>

#include <concepts>
#include <memory>
#include <vector>

namespace pyrod {

/// Made from an equilibrium when it is asked for, on the edges of the scene: on those the state is
/// taken to rounding, evaluated and factorised once. Then every product is one solve and sums.
///
/// A change of the scene is a vector of *numbers*: the difference of those of two scenes that are
/// like this one, or what the makers below give. Not for several threads at once. A template, so
/// that only who asks compiles it. `S`: `Settings`.
template <std::same_as<Settings> S>
class LinearisedScene {
 public:
  /// `near`: an equilibrium of that scene, with a tolerance or without. Throws `InvalidArgument` if
  /// there is none, and `SingularEquilibrium` at a critical one.
  LinearisedScene(const SceneSolver<S>& scene, const Equilibrium& near);

  /// Numbers of a scene that differs from this one in numbers only. Frames of supports and joints
  /// are told as turns from this one's.
  Vector numbers(const SceneSolver<S>& like) const;
  /// Of dead forces on the vertices of every rod.
  Vector of_forces(const std::vector<std::vector<Vec3>>& forces) const;
  /// Of moments on the edges of every rod, in the components of their frames.
  Vector of_moments(const std::vector<std::vector<Vec3>>& moments) const;
  /// Of a dead moment on a vertex, in space.
  Vector of_moment(int rod, int vertex, const Vec3& moment) const;
  /// Of a motion of a support: of its point, and of its frame by a rotation vector, both in space.
  Vector of_motion(int support, const Vec3& shift, const Vec3& turn) const;
  /// Of what a rod has along it, places of supports and joints staying where they are.
  Vector of_rod(int rod, const RodFields& fields) const;
  /// The transpose.
  RodFields to_rod(int rod, const Vector& numbers) const;

  /// What a change of the numbers does: the derivative along it. NaN where there is none; throws
  /// `SingularEquilibrium` if it pushes along a free motion.
  SceneChange push(const Vector& numbers) const;
  /// The gradient of Σ weights·told in all numbers: the adjoint. `rounding`, if it is asked for:
  /// how far rounding moves the gradient, where inextensible rods are all but straight; if not,
  /// what moves it is refused. Where there are free motions, none of which may change that sum, it
  /// holds for changes that push along none.
  Vector pull(const SceneChange& weights, Vector* rounding = nullptr) const;

  /// What each free motion of the equilibrium changes.
  std::vector<SceneChange> free() const;
  /// How numbers push along these: those that do have no derivatives.
  std::vector<Vector> pushes_freely() const;

  /// Displacement and rotation vector of a vertex, in space, under unit force and moment there, in
  /// its columns. Those of loads that leave the plane of a planar scene are NaN.
  Mat<6> compliance(int rod, int vertex) const;

  /// Of the rows of all unknowns, those in K v = λ diag(weights) v whose solutions are the modes of
  /// stability: λ of the lowest is `Equilibrium::lowest_eigenvalue`.
  Vector weights() const;
  /// K⁻¹ rows, without what is added to the factor.
  Vector solved(const Vector& rows) const;
  /// What a change of the unknowns is to all that is told.
  SceneChange follow(const Vector& rows) const;

  /// Zeros.
  SceneChange empty() const;
  /// Whether all loads have a potential: then compliances are symmetric.
  bool symmetric() const;

 private:
  struct Parts;
  std::shared_ptr<Parts> parts_;
};

using Linearised = LinearisedScene<Settings>;

#ifdef PYROD_COMPILED
extern template class LinearisedScene<Settings>;
#endif

}  // namespace pyrod

#ifndef PYROD_COMPILED
#include <pyrod/linear/linearised_parts.hpp>
#endif
