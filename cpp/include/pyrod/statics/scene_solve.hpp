// SPDX-License-Identifier: BSD-3-Clause
/// \file One solve of a scene: on its edges or to a tolerance.
#pragma once

#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/statics/doubts.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ladder/climb.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/scene_shape.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/strained.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/warm_start.hpp>

#include <memory>
#include <optional>
#include <utility>

namespace pyrod {

namespace detail {

/// One solve of a scene that is ready. `S`: `Settings`.
template <class S>
class SceneSolve {
 public:
  /// `ready`: who asks for the shape later still needs it. `tol`: none, for the edges as they are.
  SceneSolve(std::shared_ptr<const ReadyScene> ready, const S& settings, std::optional<double> tol)
      : ready_(std::move(ready)), settings_(settings), tol_(tol) {}

  /// `reached`: from where to start, if that fits, and where that led to; else from `start()`.
  template <class GetStart>
  Equilibrium solve(const GetStart& start, WarmStart* reached) const {
    return in_space(ready_->scene().space, [&]<class Space>(Space) {
      if (tol_) return climb<Space>(start());
      const auto posed = ready_->template posed<Space>();
      const auto found = std::make_shared<const Found<Space>>(this->find(*posed, start, reached));
      if (reached && found->converged()) *reached = WarmStart(found, posed->here());
      return equilibrium<Space>(posed, found);
    });
  }

 private:
  template <class Space, class GetStart>
  Found<Space> find(const Posed<Space>& posed, const GetStart& start, const WarmStart* warm) const {
    if (warm)
      if (auto near = warm->state(posed))
        return find_near<Space>(posed, std::move(*near), settings_.options, more(),
                                settings_.trace);
    return pyrod::find<Space>(posed, start(), settings_.options, more(), settings_.trace);
  }

  /// Its shape is told when it is asked for.
  template <class Space>
  Equilibrium equilibrium(const std::shared_ptr<const Posed<Space>>& posed,
                          const std::shared_ptr<const Found<Space>>& found) const {
    Equilibrium out(*found, [ready = ready_, posed, found] {
      return shape_of(*ready, posed->in_space(told(*posed, *found)));
    });
    for (const auto& φ : found->mode) out.mode.push_back(embed_spin(φ));
    return checked(std::move(out), Strained<Space>(posed->problem(), found->state).perhaps());
  }

  template <class Space>
  Equilibrium climb(const std::optional<NetworkStart>& start) const {
    const auto levels = [this](int level) { return ready_->template posed<Space>(level); };
    auto climbed = pyrod::climb<Space>(
        levels, ready_->network().network.rods, ready_->corners(), start,
        {*tol_, settings_.options, more(), settings_.trace, settings_.progress});
    auto mode = std::move(climbed.solution.mode);
    Course course = climbed.solution;
    const auto& [unresolved, reason] = ready_->smoothness();
    Equilibrium out(std::move(course),
                    [ready = ready_, solution = std::move(climbed.solution)]() mutable {
                      return shape_of(*ready, std::move(solution));
                    });
    out.mode = std::move(mode);
    out.accuracy = Accuracy{*tol_, climbed.reached, reason, unresolved};
    return checked(std::move(out), true);
  }

  NetworkOptions more() const {
    return {.stable = settings_.stable, .eigenvalue = settings_.eigenvalue};
  }

  /// With all doubts; refuses what drifts. `look`: strains may be beyond what they mean.
  Equilibrium checked(Equilibrium&& out, bool look) const {
    refuse_drift(*ready_, out);
    out.doubts = doubts_of(out, settings_.stable, look);
    return std::move(out);
  }

  std::shared_ptr<const ReadyScene> ready_;
  const S& settings_;
  std::optional<double> tol_;
};

}  // namespace detail

}  // namespace pyrod
