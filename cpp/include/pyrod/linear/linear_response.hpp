// SPDX-License-Identifier: BSD-3-Clause
/// \file How an equilibrium answers to small changes of its numbers: forward, and backward from
/// what is told of it to all numbers at once.
///
/// Forward it is theory (28), backward theory (29). Every product takes one solve with the factor,
/// and sums along the rods.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/free_changes.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/position_sums.hpp>
#include <pyrod/linear/response_change.hpp>
#include <pyrod/linear/response_equations.hpp>
#include <pyrod/linear/response_steps.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>
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
  using Change = ResponseChange<Space>;

  /// `x`: the equilibrium of the problem, to rounding. Both must stay where they are. Throws
  /// `SingularEquilibrium` where a mode has no stiffness, but for free motions.
  LinearResponse(const NetworkProblem<Space>& problem, const NetworkState<Space>& x);

  const Layout<Space>& layout() const { return at_.layout; }
  const StateItems<Space>& state_items() const { return at_.state; }
  const NumberItems<Space>& number_items() const { return at_.numbers; }
  const ToldItems<Space>& told_items() const { return at_.told; }
  const PositionSums<Space>& positions() const { return steps_.place(); }
  const NetworkState<Space>& state() const { return at_.x; }

  /// Zeros, to be filled.
  Items<Space> no_numbers() const {
    return Items<Space>::Zero(item_width<Space>, at_.numbers.count());
  }
  Change no_change() const { return Change(at_); }

  /// What a change of the numbers does. Items that are unknown here, or move freely, are NaN.
  /// Throws `SingularEquilibrium` if it pushes along a free motion.
  void push(const Items<Space>& numbers, Change& out);
  /// The same of so many changes, whose equations are solved at once: numbers(k) is asked for
  /// twice, and visit(k, out) called for each. Of those that push along a free motion all is NaN.
  template <class Numbers, class Visit>
  void push_all(int count, Numbers&& numbers, Change& out, Visit&& visit);

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
  /// that are unknown here, nor of a sum that changes with a free motion. It holds for changes that
  /// push along none.
  void pull(const Change& from, Items<Space>& numbers);
  /// How far rounding moves the last gradient, if it may matter; `numbers`: zeros if not.
  void pull_rounding(Items<Space>& numbers);
  /// What pushes along a free motion, of 1 rad or a length.
  void pull_free(int k, Items<Space>& numbers) { steps_.pull_alone(free_motion(k), numbers); }
  /// What each free motion changes.
  const std::vector<Change>& free() const { return free_.all(); }

  /// See `ResponseEquations`.
  std::optional<double> softest() const { return equations_.softest(); }
  void multiply_skew(const Vector& v, Vector& out, bool transposed) {
    equations_.multiply_skew(v, out, transposed);
  }
  bool symmetric() const { return equations_.symmetric(); }

 private:
  Vector free_motion(int k) const;
  void find_free_changes();
  bool pushes_freely(const Vector& side, const Change& out) const;
  void finish(const Items<Space>& numbers, Change& out);
  void forget(Change& out) const;
  void require_known(const Change& from) const;
  double noise(const Change& out) const;

  const NetworkProblem<Space>& problem_;
  ResponseSteps<Space> steps_;
  const AtState<Space>& at_;
  ResponseEquations<Space> equations_;
  FreeChanges<Space> free_;
  Vector side_, δ_;
  Eigen::MatrixXd all_, sides_;
};

template <class Space>
LinearResponse<Space>::LinearResponse(const NetworkProblem<Space>& problem,
                                      const NetworkState<Space>& x)
    : problem_(problem),
      steps_(problem, x),
      at_(steps_.at()),
      equations_(problem, x,
                 {steps_.chains(), steps_.residual(), steps_.followed(), steps_.force()}),
      free_(at_) {
  find_free_changes();
}

/// Its largest turn, or displacement, is 1.
template <class Space>
Vector LinearResponse<Space>::free_motion(int k) const {
  const Vector mode = equations_.free().col(k);
  return mode /
         (problem_.stiffness().array() > 0).select(mode, 0.).template lpNorm<Eigen::Infinity>();
}

template <class Space>
void LinearResponse<Space>::find_free_changes() {
  for (int k = 0; k < int(equations_.free().cols()); ++k) {
    Change moved = no_change();
    follow(free_motion(k), moved);
    free_.add(std::move(moved));
  }
}

/// Whether a right side pushes along a free motion, more than by rounding.
template <class Space>
bool LinearResponse<Space>::pushes_freely(const Vector& side, const Change& out) const {
  for (int k = 0; k < int(free_.all().size()); ++k)
    if (!free_.is_rounding(free_motion(k).dot(side), side, out)) return true;
  return false;
}

template <class Space>
void LinearResponse<Space>::forget(Change& out) const {
  free_.forget(out);
  for (const int i : steps_.told().unknown()) out.told.col(i).setConstant(std::nan(""));
  for (const int p : equations_.undetermined()) {
    for (int e = at_.layout.first_edge(p); e <= at_.layout.last_edge(p); ++e)
      out.state.col(at_.state.force(e)).setConstant(std::nan(""));
    for (const int v : {at_.layout.spans()[p].start, at_.layout.spans()[p].end})
      out.told.col(at_.told.reaction_force(v)).setConstant(std::nan(""));
  }
}

template <class Space>
void LinearResponse<Space>::require_known(const Change& from) const {
  for (const int i : steps_.told().unknown())
    require(
        from.told.col(i).isZero(0),
        "linear: derivatives beside a jump, or a moment inside of a rod, of curvatures, frames of "
        "vertices and moments are not known there, and of curvatures where tendons run to an end");
  for (const int p : equations_.undetermined())
    for (int e = at_.layout.first_edge(p); e <= at_.layout.last_edge(p); ++e)
      require(from.state.col(at_.state.force(e)).isZero(0),
              "linear: the section force of a span is not determined, and has no derivative");
}

/// Of turns that are rounding: what the largest change of a moment bends, 1e-12 of it.
template <class Space>
double LinearResponse<Space>::noise(const Change& out) const {
  const double unit = at_.layout.unit_moment(),
               moment = out.told.middleCols(at_.told.moment(0), at_.told.vertices())
                            .template lpNorm<Eigen::Infinity>();
  return 1e-24 * moment * moment / unit;
}

template <class Space>
void LinearResponse<Space>::finish(const Items<Space>& numbers, Change& out) {
  steps_.add_unknowns(δ_, out.state);
  steps_.tell(numbers, out);
  if (equations_.doubtful()) equations_.require_sure(δ_, noise(out));
}

template <class Space>
void LinearResponse<Space>::follow(const Vector& δ, Change& out) {
  out.state.setZero();
  steps_.add_unknowns(δ, out.state);
  steps_.tell(no_numbers(), out);
}

template <class Space>
void LinearResponse<Space>::push(const Items<Space>& numbers, Change& out) {
  steps_.start(numbers, out.state);
  steps_.find_right_side(numbers, out.state, side_);
  equations_.solve(side_, δ_, false);
  finish(numbers, out);
  if (pushes_freely(side_, out))
    throw SingularEquilibrium(
        "linear: the equilibrium may move freely, and this change pushes it along: there is no "
        "derivative",
        0);
  forget(out);
}

template <class Space>
template <class Numbers, class Visit>
void LinearResponse<Space>::push_all(int count, Numbers&& numbers, Change& out, Visit&& visit) {
  sides_.resize(at_.layout.unknowns(), count);
  for (int k = 0; k < count; ++k) {
    const Items<Space>& change = numbers(k);
    steps_.start(change, out.state);
    steps_.find_right_side(change, out.state, side_);
    sides_.col(k) = side_;
  }
  all_ = sides_;
  equations_.solve_all(all_);
  for (int k = 0; k < count; ++k) {
    const Items<Space>& change = numbers(k);
    steps_.start(change, out.state);
    δ_ = all_.col(k), side_ = sides_.col(k);
    finish(change, out);
    pushes_freely(side_, out) ? out.set_nan() : forget(out);
    visit(k, out);
  }
}

template <class Space>
void LinearResponse<Space>::pull(const Change& from, Items<Space>& numbers) {
  require_known(from);
  free_.require_unmoved(from);
  steps_.weigh(from, side_);
  equations_.solve(side_, δ_, true);
  steps_.pull(δ_, numbers);
}

template <class Space>
void LinearResponse<Space>::pull_rounding(Items<Space>& numbers) {
  numbers.setZero();
  if (!equations_.doubtful()) return;
  Vector moved;
  equations_.find_rounding(δ_, moved);
  steps_.pull_alone(moved, numbers);
}

}  // namespace pyrod
