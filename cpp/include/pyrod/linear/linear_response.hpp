// SPDX-License-Identifier: BSD-3-Clause
/// \file How an equilibrium answers to small changes of its numbers: forward, and backward from
/// what is told of it to all numbers at once.
///
/// Forward it is theory (28), backward theory (29). Every product takes one solve with the factor,
/// and sums along the rods.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/force_sums.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/position_sums.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/linear/told_maps.hpp>
#include <pyrod/linear/unknown_rows.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/refined.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>
#include <pyrod/solve/tangent.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cmath>
#include <optional>
#include <utility>
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

  /// To the numbers, from what is told: the gradient of Σ from·told. Nothing may be asked of items
  /// that are unknown here.
  void pull(const Change& from, Items<Space>& numbers);

  /// The eigenvalue of the softest mode over the stiffness of the rods, if it is soft.
  std::optional<double> softest() const { return softest_; }

  /// out = Z v, the tangent beside its symmetric part, or Zᵀ v.
  void multiply_skew(const Vector& v, Vector& out, bool transposed);

  /// Whether the tangent is symmetric.
  bool symmetric() const { return !skew_; }

 private:
  void look_for_modes();
  void look_for_forces();
  void forget_forces(Change& out) const;
  void follow(const Items<Space>& turns, Items<Space>& forces, bool transposed) const;
  void solve(const Vector& b, Vector& x, bool transposed);
  void push_state(const Vector& δ, Items<Space>& state);

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
  Tangent<NetworkProblem<Space>> tangent_;
  Refined refined_;
  bool skew_;
  std::optional<double> softest_;
  std::vector<int> undetermined_;  ///< spans
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
      tangent_(problem),
      refined_(tangent_.factor()),
      skew_(!problem.conservative()),
      moved_(Items<Space>::Zero(item_width<Space>, state_.count())),
      work_(moved_),
      forces_(no_numbers()),
      reach_(Items<Space>::Zero(item_width<Space>, layout_.edges())) {
  tangent_.linearise(x, Hessian::exact);
  tangent_.factor().factorise(0);
  rhs_.resize(layout_.unknowns());
  look_for_modes();
  look_for_forces();
}

template <class Space>
void LinearResponse<Space>::look_for_modes() {
  if (skew_) return;  // the symmetric part alone says nothing
  if (const auto mode = tangent_.soft_mode()) softest_ = mode->eigenvalue;
  tangent_.factor().factorise(0);
  const bool singular = tangent_.factor().broken() || (softest_ && std::abs(*softest_) < 1e-8);
  if (singular)
    throw SingularEquilibrium(
        text(
            "linear: the equilibrium is critical, or may move freely: a mode has no stiffness, its "
            "eigenvalue is ",
            softest_.value_or(0), " of that of the rods; there are no derivatives"),
        softest_.value_or(0));
}

/// Where nothing gives way to a section force, as in straight inextensible spans between fixed
/// points, it is what is added to the factor that tells it. Random gaps bring that out.
template <class Space>
void LinearResponse<Space>::look_for_forces() {
  auto& factor = tangent_.factor();
  if (factor.multipliers().count() == 0) return;
  rhs_.setZero();
  for (const int k : factor.multipliers().rows())
    rhs_[k] = problem_.units()[k] * std::cos(1. + k * k % 101);
  factor.solve(rhs_, δ_);
  for (int p = 0; p < int(layout_.spans().size()); ++p)
    if (const auto& span = layout_.spans()[p]; span.block >= 0)
      for (int k = layout_.row(span.block), i = 0; i < int(span.open.cols()); ++i, ++k)
        if (std::abs(factor.left(δ_, k)) > 1e-4 * problem_.units()[k]) {
          undetermined_.push_back(p);
          break;
        }
}

template <class Space>
void LinearResponse<Space>::forget_forces(Change& out) const {
  for (const int p : undetermined_) {
    for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
      out.state.col(state_.force(e)).setConstant(std::nan(""));
    for (const int v : {layout_.spans()[p].start, layout_.spans()[p].end})
      out.told.col(told_items_.reaction_force(v)).setConstant(std::nan(""));
  }
}

/// What forces that follow frames change when these turn, added to forces; or back to turns.
template <class Space>
void LinearResponse<Space>::follow(const Items<Space>& from, Items<Space>& to,
                                   bool transposed) const {
  for (int rod = 0; rod < int(layout_.network().rods.size()); ++rod)
    for (const auto& f : layout_.network().loads[rod].follower_forces) {
      const int e = layout_.edge(rod, f.edge), turn = state_.turn(e),
                force = numbers_.force(rod, f.vertex);
      const Mat<dim, spin> F = -matrix(x_.frames[e]) * skew(f.force);
      if (transposed)
        to.col(turn).template head<spin>() += F.transpose() * from.col(force).template head<dim>();
      else
        to.col(force).template head<dim>() += F * from.col(turn).template head<spin>();
    }
}

/// The tangent beside its symmetric part: what `NetworkSkew` gives, or its transpose.
template <class Space>
void LinearResponse<Space>::multiply_skew(const Vector& v, Vector& out, bool transposed) {
  if (!transposed) {
    problem_.multiply_skew(x_, v, out);
    return;
  }
  Items<Space> residual = 0 * work_, state = residual;
  rows_.spread(v, residual);
  residual_.skew().pull(residual, state);
  if (problem_.dead_loads()) {
    rows_.gather(state, out);
    return;
  }
  Items<Space> acting = 0 * work_, forces = no_numbers();
  residual_.of_state().pull(residual, acting);
  force_.pull(acting, forces);
  follow(forces, state, true);
  rows_.gather(state, out);
}

template <class Space>
void LinearResponse<Space>::solve(const Vector& b, Vector& x, bool transposed) {
  const bool solved = refined_.solve(
      [&](const Vector& v, Vector& out) { multiply_skew(v, out, transposed); }, skew_, b, x);
  if (!solved)
    throw SingularEquilibrium(
        "linear: the equations for a change are singular: something moves freely, or a force is "
        "not "
        "determined",
        softest_.value_or(0));
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
  follow(state, forces_, false);
  force_.multiply(forces_, state);
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
  solve(rhs_, δ_, false);
  push_state(δ_, out.state);
  residual_.holds().multiply(out.state, out.state);
  out.told.setZero();
  told_.of_state().multiply(out.state, out.told);
  told_.of_numbers().multiply(numbers, out.told);
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
  for (const int p : undetermined_)
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
    follow(forces_, work_, true);
  }
  for (int p = 0; p < int(layout_.spans().size()); ++p)
    if (layout_.spans()[p].block >= 0)
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e)
        work_.col(state_.gap(p)) += state.col(state_.force(e));
  rows_.gather(work_, rhs_);
  rhs_ = -rhs_;
  solve(rhs_, δ_, true);
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
