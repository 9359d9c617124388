// SPDX-License-Identifier: BSD-3-Clause
/// \file A branch of equilibria of scenes in their space.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/paths/network_family.hpp>
#include <pyrod/paths/network_source.hpp>
#include <pyrod/paths/scene_family.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/path.hpp>
#include <pyrod/solve/singular_point.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/doubts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/scene_shape.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/strained.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
class BranchInSpace {
 public:
  using State = NetworkState<Space>;

  BranchInSpace(SceneFamily family, const PathSettings& settings)
      : scenes_(std::move(family)),
        first_(ready(settings.start)),
        at_(first_->network().plane),
        apart_(share_ * std::abs(settings.stop - settings.start)) {
    require(std::ranges::none_of(first_->network().network.tendons,
                                 [](const auto& tendon) { return tendon.length.has_value(); }),
            "follow: a tendon of given length may become slack on the way, which a path does not "
            "see; give it a tension");
    NetworkFamily<Space> networks(source(scenes_, settings.start, apart_));
    path_ = PathFollower<NetworkFamily<Space>>(networks, limits(settings)).follow(start(settings));
    require(!path_.points.empty(), "follow: the equilibrium at the start is singular");
  }

  const FoundPath<State>& path() const { return path_; }

  BranchInSpace switched(std::size_t number, int side, const PathSettings& settings) const {
    BranchInSpace out(*this);
    NetworkFamily<Space> networks(source(scenes_, path_.special[number].λ, apart_));
    PathFollower<NetworkFamily<Space>> follower(networks, limits(settings));
    out.path_ = follower.follow(path_.special[number], side * sign_of(path_.special[number]));
    require(!out.path_.points.empty(), "switch: the branch that crosses was not found");
    return out;
  }

  BranchSpecial told(const SingularPoint<State>& one) const {
    return {one.kind,         one.λ,      one.error,    one.index_before,
            one.index_behind, one.behind, mode_of(one), one.branches()};
  }

  /// −v·∂g/∂t / v·b, v the mode, which is the left null vector as well.
  double derivative(std::size_t number, const SceneFamily& change, double apart) const {
    const auto& at = path_.special[number];
    NetworkFamily<Space> along(source(scenes_, at.λ, apart_)), other(source(change, 0, apart));
    Vector b, more;
    along.set(at.λ), other.set(0);
    along.slope(at.x, b), other.slope(at.x, more);
    return -at.mode.dot(more) / at.mode.dot(b);
  }

  Equilibrium equilibrium(std::size_t point, bool eigenvalue) const {
    const auto& at = path_.points[point];
    return made(at.x, at.λ, at.index, eigenvalue, {});
  }
  Equilibrium special_equilibrium(std::size_t number) const {
    const auto& at = path_.special[number];
    return made(at.x, at.λ, std::min(at.index_before, at.index_behind), false, mode_of(at));
  }

 private:
  static constexpr double share_ = 5e-4;  ///< of the range: over which slopes are differenced

  std::shared_ptr<const ReadyScene> ready(double λ) const {
    return std::make_shared<const ReadyScene>(with_vertices_at_places(scenes_.scene(λ), false));
  }

  std::unique_ptr<NetworkSource<Space>> source(const SceneFamily& scenes, double λ,
                                               double apart) const {
    const auto network = [scenes](double value) {
      return network_of(SceneOnGrids(with_vertices_at_places(scenes.scene(value), false))).network;
    };
    if (scenes.line()) return std::make_unique<BlendedNetwork<Space>>(network(0), network(1), at_);
    return std::make_unique<RemadeNetwork<Space>>(network, λ, apart, at_);
  }

  static PathLimits limits(const PathSettings& settings) {
    return {settings.start, settings.stop, settings.max_points, settings.look};
  }

  State start(const PathSettings& settings) const {
    const auto posed = first_->template posed<Space>();
    std::optional<NetworkStart> near;
    if (settings.from) near = start_from(settings.from->rods(), first_->network().network);
    NetworkOptions any;
    any.stable = !settings.from;
    auto found = pyrod::find<Space>(*posed, near, settings.options, any, {});
    require(found.converged(), "follow: no equilibrium is found at the start, ",
            advice(found.status));
    return std::move(found.state);
  }

  /// Of the largest component of the mode on edges.
  double sign_of(const SingularPoint<State>& one) const { return largest(one.mode) < 0 ? -1 : 1; }

  double largest(const Vector& mode) const {
    const auto& layout = first_->template posed<Space>()->layout();
    double most = 0;
    for (int e = 0; e < layout.edges(); ++e)
      for (const double φ : mode.template segment<Space::spin>(layout.frame_row(e)))
        if (std::abs(φ) > 1.000001 * std::abs(most)) most = φ;
    return most;
  }

  std::vector<Vec3> mode_of(const SingularPoint<State>& one) const {
    const auto& layout = first_->template posed<Space>()->layout();
    const double unit = largest(one.mode);
    std::vector<Vec3> out;
    for (int e = 0; e < layout.edges() && unit != 0; ++e)
      out.push_back(embed_spin(
          Spin<Space>(one.mode.template segment<Space::spin>(layout.frame_row(e)) / unit)));
    return out;
  }

  /// What is told of a state that is known to be in equilibrium.
  Equilibrium made(const State& x, double λ, int index, bool eigenvalue,
                   std::vector<Vec3> mode) const {
    const auto on = ready(λ);
    const auto posed = std::make_shared<const Posed<Space>>(on->network().network, at_);
    auto found = std::make_shared<Found<Space>>();
    found->status = Status::converged;
    found->index = index;
    found->state = x;
    found->unknowns = posed->layout().unknowns();
    found->multipliers = posed->layout().multipliers();
    Newton<NetworkProblem<Space>> newton(posed->problem(), {}, {}, false);
    newton.look_at(x);
    found->fill = newton.fill();
    found->residual = residual(posed->problem(), x);
    if (eigenvalue && index >= 0) {
      const auto lowest = newton.lowest_mode();
      found->lowest_eigenvalue = lowest.eigenvalue;
      mode.clear();
      for (int e = 0; e < posed->layout().edges(); ++e)
        mode.push_back(embed_spin(
            Spin<Space>(lowest.shape.template segment<Space::spin>(posed->layout().frame_row(e)))));
    }
    const bool strained = Strained<Space>(posed->problem(), x).perhaps();
    Equilibrium out(*found, [on, posed, found = std::shared_ptr<const Found<Space>>(found)] {
      return shape_of(*on, posed->in_space(pyrod::told(*posed, *found)));
    });
    out.mode = std::move(mode);
    out.doubts = doubts_of(out, false, strained);
    return out;
  }

  static double residual(const NetworkProblem<Space>& problem, const State& x) {
    auto at = problem.linearisation();
    problem.linearise(x, Hessian::exact, at);
    return at.gradient.template lpNorm<Eigen::Infinity>();
  }

  SceneFamily scenes_;
  std::shared_ptr<const ReadyScene> first_;  ///< at the start
  Placement<Spatial> at_;                    ///< the plane of the computation
  double apart_;                             ///< over which slopes are differenced
  FoundPath<State> path_;
};

}  // namespace pyrod
