// SPDX-License-Identifier: BSD-3-Clause
/// \file The steps of the linear response: from changes of numbers to the right side of the linear
/// equations, from their solution to all that is told, and back.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/chains.hpp>
#include <pyrod/linear/follower_turns.hpp>
#include <pyrod/linear/force_sums.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/position_sums.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/response_change.hpp>
#include <pyrod/linear/told_maps.hpp>
#include <pyrod/linear/unknown_rows.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <vector>

namespace pyrod {

/// Forward: `start`, `find_right_side`, `add_unknowns`, `tell`. Backward: `weigh`, `pull`.
template <class Space>
class ResponseSteps {
 public:
  using Change = ResponseChange<Space>;

  /// Both must stay where they are.
  ResponseSteps(const NetworkProblem<Space>& problem, const NetworkState<Space>& x)
      : problem_(problem),
        at_(problem.layout(), x),
        rows_(at_.layout),
        chains_(at_, edge_columns(at_.layout), problem.sections(x, problem.acting(x, changed_))),
        residual_(at_),
        told_(at_),
        force_(at_.layout),
        place_(at_.layout),
        followed_(follower_turns(at_.layout, x)),
        moved_(Items<Space>::Zero(item_width<Space>, at_.state.count())),
        work_(moved_),
        others_(others(work_)),
        pulled_(at_) {
    if (!problem.dead_loads()) forces_.setZero(item_width<Space>, at_.numbers.count());
  }

  const AtState<Space>& at() const { return at_; }
  const PositionSums<Space>& place() const { return place_; }
  const ToldMaps<Space>& told() const { return told_; }
  const Chains<Space>& chains() const { return chains_; }
  const ResidualMaps<Space>& residual() const { return residual_; }
  const ItemMap<Space>& followed() const { return followed_; }
  ForceSums<Space>& force() { return force_; }

  /// What moves while all unknowns stay: section forces, and what supports move.
  void start(const Items<Space>& numbers, Items<Space>& state) {
    state.setZero();
    residual_.moves().multiply(numbers, state);
    force_.multiply(numbers, state);
  }

  /// `state`: as it was started, and stays.
  void find_right_side(const Items<Space>& numbers, Items<Space>& state, Vector& side) {
    others_ = others(state);
    residual_.holds().multiply(state, state);  // for here: it comes again with the unknowns
    others(work_).setZero();
    chains_.multiply(numbers, state, work_);
    residual_.of_state().multiply(state, work_);
    residual_.balance().multiply(state, work_);
    others(state) = others_;
    residual_.of_numbers().multiply(numbers, work_);
    residual_.holds().pull(work_, work_);
    rows_.gather(work_, side);
    side = -side;
  }

  /// Adds what follows from a change of the unknowns: held frames, and section forces.
  void add_unknowns(const Vector& δ, Items<Space>& state) {
    rows_.spread(δ, state);
    for_each_multiplier([&](int gap, int force) { state.col(force) += state.col(gap); });
    if (!problem_.dead_loads()) {
      forces_.setZero();
      followed_.multiply(state, forces_);
      force_.multiply(forces_, state);
    }
    residual_.holds().multiply(state, state);
  }

  /// All that follows from numbers and state.
  void tell(const Items<Space>& numbers, Change& out) {
    for (const int i : chains_.others()) out.told.col(i).setZero();
    chains_.tell(numbers, out.state, out.told);
    told_.of_state().multiply(out.state, out.told);
    told_.of_numbers().multiply(numbers, out.told);
    place_.multiply(out.state, out.told, out.positions);
  }

  /// The right side of the adjoint equations, from weights of what is told.
  void weigh(const Change& from, Vector& side) {
    auto &state = pulled_.state, &told = pulled_.told;
    state = from.state, told = from.told;
    place_.pull(from.positions, state, told);
    chains_.pull_told(told, state);
    told_.of_state().pull(told, state);
    residual_.holds().pull(state, state);
    if (!problem_.dead_loads()) {
      forces_.setZero();
      force_.pull(state, forces_);
      followed_.pull(forces_, state);
    }
    for_each_multiplier([&](int gap, int force) { state.col(gap) += state.col(force); });
    rows_.gather(state, side);
    side = -side;
  }

  /// Sets the gradient in the numbers, from the solution of these equations and the weights.
  void pull(const Vector& λ, Items<Space>& numbers) {
    auto &state = pulled_.state, &told = pulled_.told;
    others(moved_).setZero();
    rows_.spread(λ, moved_);
    residual_.holds().multiply(moved_, moved_);
    numbers.rightCols(numbers.cols() - at_.numbers.of_edges()).setZero();
    chains_.pull(moved_, told, numbers, state);
    told_.of_numbers().pull(told, numbers);
    residual_.of_numbers().pull(moved_, numbers);
    residual_.balance().pull(moved_, state);
    others(work_).setZero();
    residual_.of_state().pull(moved_, work_);
    residual_.holds().pull(work_, work_);
    others(state) += others(work_);
    residual_.moves().pull(state, numbers);
    force_.pull(state, numbers);
  }

  /// The same of a solution alone, without any weights.
  void pull_alone(const Vector& λ, Items<Space>& numbers) {
    pulled_.told.setZero(), pulled_.state.setZero();
    pull(λ, numbers);
  }

 private:
  /// Of the state, what is not of edges.
  auto others(Items<Space>& state) const {
    return state.rightCols(state.cols() - 2 * at_.layout.edges());
  }

  /// A multiplier is a part of all section forces of its span.
  template <class Visit>
  void for_each_multiplier(Visit&& visit) const {
    for (int p = 0; p < int(at_.layout.spans().size()); ++p)
      if (at_.layout.spans()[p].block >= 0)
        for (int e = at_.layout.first_edge(p); e <= at_.layout.last_edge(p); ++e)
          visit(at_.state.gap(p), at_.state.force(e));
  }

  const NetworkProblem<Space>& problem_;
  AtState<Space> at_;
  UnknownRows<Space> rows_;
  typename NetworkProblem<Space>::Acting changed_;
  Chains<Space> chains_;
  ResidualMaps<Space> residual_;
  ToldMaps<Space> told_;
  ForceSums<Space> force_;
  PositionSums<Space> place_;
  ItemMap<Space> followed_;
  Items<Space> moved_, work_, others_, forces_;
  Change pulled_;
};

}  // namespace pyrod
