// SPDX-License-Identifier: BSD-3-Clause
/// \file How an equilibrium answers to small changes of its numbers: forward, and backward from
/// what is told of it to all numbers at once.
///
/// Forward it is theory (28), backward theory (29). Every product takes one solve with the factor,
/// and sums along the rods.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/follower_turns.hpp>
#include <pyrod/linear/force_sums.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/position_sums.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/response_equations.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/linear/told_maps.hpp>
#include <pyrod/linear/unknown_rows.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace pyrod {

template <class Space>
class LinearResponse {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Points = typename PositionSums<Space>::Points;

  /// What changes: the state, see `StateItems`; what is told, see `ToldItems`; positions of the
  /// vertices, see `PositionSums`.
  struct Change {
    Items<Space> state, told;
    Points positions;
  };

  /// `x`: the equilibrium of the problem, to rounding. Both must stay where they are. Throws
  /// `SingularEquilibrium` where a mode has no stiffness.
  LinearResponse(const NetworkProblem<Space>& problem, const NetworkState<Space>& x);

  const Layout<Space>& layout() const { return layout_; }
  const StateItems<Space>& state_items() const { return state_; }
  const NumberItems<Space>& number_items() const { return numbers_; }
  const ToldItems<Space>& told_items() const { return told_items_; }
  const PositionSums<Space>& positions() const { return place_; }
  const NetworkState<Space>& state() const { return x_; }

  /// Zeros, to be filled.
  Items<Space> no_numbers() const {
    return Items<Space>::Zero(item_width<Space>, numbers_.count());
  }
  Change no_change() const {
    return {Items<Space>::Zero(item_width<Space>, state_.count()),
            Items<Space>::Zero(item_width<Space>, told_items_.count()),
            Points::Zero(dim, place_.columns())};
  }

  /// What a change of the numbers does. Items that are unknown here are NaN.
  void push(const Items<Space>& numbers, Change& out);

  /// K δ = rhs in the rows of the unknowns, without what is added to the factor.
  void solve(const Vector& rhs, Vector& δ) {
    equations_.solve(rhs, δ, false);
    if (equations_.doubtful()) equations_.require_sure(δ, 0);
  }
  /// Weights of these rows: the shares of length of frames, so that K v = λ diag(weights) v are the
  /// modes of stability. Zero for multipliers.
  Vector weights() const { return problem_.weights(); }
  /// What changes of the unknowns are to all that is told.
  void follow(const Vector& δ, Change& out);

  /// To the numbers, from what is told: the gradient of Σ from·told. Nothing may be asked of items
  /// that are unknown here.
  void pull(const Change& from, Items<Space>& numbers);

  /// See `ResponseEquations`.
  std::optional<double> softest() const { return equations_.softest(); }
  void multiply_skew(const Vector& v, Vector& out, bool transposed) {
    equations_.multiply_skew(v, out, transposed);
  }
  bool symmetric() const { return equations_.symmetric(); }

 private:
  void forget_forces(Change& out) const;
  void push_state(const Vector& δ, Items<Space>& state);
  double noise(const Change& out) const;

  const NetworkProblem<Space>& problem_;
  const Layout<Space>& layout_;
  const NetworkState<Space>& x_;
  NetworkLoads<Space> loads_;
  EdgeColumns<Space> columns_;
  StateItems<Space> state_;
  NumberItems<Space> numbers_;
  ToldItems<Space> told_items_;
  UnknownRows<Space> rows_;
  typename NetworkProblem<Space>::Acting changed_;
  std::vector<Point<Space>> sections_;
  ResidualMaps<Space> residual_;
  ToldMaps<Space> told_;
  ForceSums<Space> force_;
  PositionSums<Space> place_;
  ItemMap<Space> followed_;
  ResponseEquations<Space> equations_;
  Vector rhs_, δ_;
  Items<Space> moved_, work_, forces_, reach_;
  Change pulled_;
};

template <class Space>
LinearResponse<Space>::LinearResponse(const NetworkProblem<Space>& problem,
                                      const NetworkState<Space>& x)
    : problem_(problem),
      layout_(problem.layout()),
      x_(x),
      loads_(layout_),
      columns_(edge_columns(layout_)),
      state_(layout_),
      numbers_(layout_),
      told_items_(layout_),
      rows_(layout_),
      sections_(problem.sections(x, problem.acting(x, changed_))),
      residual_(layout_, loads_, columns_, x, sections_),
      told_(layout_, loads_, columns_, x, sections_),
      force_(layout_),
      place_(layout_),
      followed_(follower_turns(layout_, x)),
      equations_(problem, x, residual_, followed_, force_),
      moved_(Items<Space>::Zero(item_width<Space>, state_.count())),
      work_(moved_),
      forces_(no_numbers()),
      reach_(Items<Space>::Zero(item_width<Space>, layout_.edges())) {
  rhs_.resize(layout_.unknowns());
}

template <class Space>
void LinearResponse<Space>::forget_forces(Change& out) const {
  for (const int p : equations_.undetermined()) {
    for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
      out.state.col(state_.force(e)).setConstant(std::nan(""));
    for (const int v : {layout_.spans()[p].start, layout_.spans()[p].end})
      out.told.col(told_items_.reaction_force(v)).setConstant(std::nan(""));
  }
}

/// Of turns that are rounding: what the largest change of a moment bends, 1e-12 of it.
template <class Space>
double LinearResponse<Space>::noise(const Change& out) const {
  const double unit = layout_.unit_moment(),
               moment = out.told.middleCols(told_items_.moment(0), told_items_.vertices())
                            .template lpNorm<Eigen::Infinity>();
  return 1e-24 * moment * moment / unit;
}

/// Adds what follows from the unknowns' part of a change: held frames, and section forces.
template <class Space>
void LinearResponse<Space>::push_state(const Vector& δ, Items<Space>& state) {
  rows_.spread(δ, state);
  for (int p = 0; p < int(layout_.spans().size()); ++p)
    if (layout_.spans()[p].block >= 0)
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
        state.col(state_.force(e)) += state.col(state_.gap(p));
  if (problem_.dead_loads()) return;
  forces_.setZero();
  followed_.multiply(state, forces_);
  force_.multiply(forces_, state);
}

template <class Space>
void LinearResponse<Space>::follow(const Vector& δ, Change& out) {
  out.state.setZero(), out.told.setZero();
  push_state(δ, out.state);
  residual_.holds().multiply(out.state, out.state);
  told_.of_state().multiply(out.state, out.told);
  reach_ = out.told.leftCols(layout_.edges());
  place_.multiply(out.state, reach_, out.positions);
}

template <class Space>
void LinearResponse<Space>::push(const Items<Space>& numbers, Change& out) {
  moved_.setZero(), work_.setZero();
  residual_.moves().multiply(numbers, moved_);
  force_.multiply(numbers, moved_);
  out.state = moved_;  // without the held frames that follow from nodes, which come at the end
  residual_.holds().multiply(moved_, moved_);
  residual_.of_state().multiply(moved_, work_);
  residual_.of_numbers().multiply(numbers, work_);
  residual_.holds().pull(work_, work_);
  rows_.gather(work_, rhs_);
  rhs_ = -rhs_;
  equations_.solve(rhs_, δ_, false);
  push_state(δ_, out.state);
  residual_.holds().multiply(out.state, out.state);
  out.told.setZero();
  told_.of_state().multiply(out.state, out.told);
  told_.of_numbers().multiply(numbers, out.told);
  if (equations_.doubtful()) equations_.require_sure(δ_, noise(out));
  reach_ = out.told.leftCols(layout_.edges());
  place_.multiply(out.state, reach_, out.positions);
  for (int i = 0; i < told_items_.count(); ++i)
    if (told_.unknown()[i]) out.told.col(i).setConstant(std::nan(""));
  forget_forces(out);
}

template <class Space>
void LinearResponse<Space>::pull(const Change& from, Items<Space>& numbers) {
  for (int i = 0; i < told_items_.count(); ++i)
    require(
        !told_.unknown()[i] || from.told.col(i).isZero(0),
        "linear: derivatives beside a jump, or a moment inside of a rod, of curvatures, frames of "
        "vertices and moments are not known there");
  for (const int p : equations_.undetermined())
    for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
      require(from.state.col(state_.force(e)).isZero(0),
              "linear: the section force of a span is not determined, and has no derivative");
  auto &state = pulled_.state, &told = pulled_.told;
  state = from.state, told = from.told;
  reach_ = told.leftCols(layout_.edges());
  place_.pull(from.positions, state, reach_);
  told.leftCols(layout_.edges()) = reach_;
  numbers.setZero();
  told_.of_numbers().pull(told, numbers);
  told_.of_state().pull(told, state);
  residual_.holds().pull(state, state);
  work_ = state;  // to the unknowns
  if (!problem_.dead_loads()) {
    forces_.setZero();
    force_.pull(state, forces_);
    followed_.pull(forces_, work_);
  }
  for (int p = 0; p < int(layout_.spans().size()); ++p)
    if (layout_.spans()[p].block >= 0)
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
        work_.col(state_.gap(p)) += state.col(state_.force(e));
  rows_.gather(work_, rhs_);
  rhs_ = -rhs_;
  equations_.solve(rhs_, δ_, true);
  if (equations_.doubtful()) equations_.require_sure(δ_, 0);
  moved_.setZero();
  rows_.spread(δ_, moved_);
  residual_.holds().multiply(moved_, moved_);
  residual_.of_numbers().pull(moved_, numbers);
  work_.setZero();
  residual_.of_state().pull(moved_, work_);
  residual_.holds().pull(work_, work_);
  state += work_;
  residual_.moves().pull(state, numbers);
  force_.pull(state, numbers);
}

}  // namespace pyrod
