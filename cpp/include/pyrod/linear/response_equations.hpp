// SPDX-License-Identifier: BSD-3-Clause
/// \file The linear equations for changes of a network's unknowns, and what these leave open.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/chains.hpp>
#include <pyrod/linear/force_sums.hpp>
#include <pyrod/linear/free_motions.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/residual_maps.hpp>
#include <pyrod/linear/rounded_gaps.hpp>
#include <pyrod/linear/unknown_rows.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/refined.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>
#include <pyrod/solve/tangent.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cmath>
#include <optional>
#include <vector>

namespace pyrod {

/// The tangent K + Z at an equilibrium, factorised.
template <class Space>
class ResponseEquations {
 public:
  /// What the residual is made of. `followed`: see `follower_turns`.
  struct Parts {
    const Chains<Space>& chains;
    const ResidualMaps<Space>& residual;
    const ItemMap<Space>& followed;
    ForceSums<Space>& force;
  };

  /// All must stay where they are. Throws `SingularEquilibrium` where a mode has no stiffness, but
  /// for free motions.
  ResponseEquations(const NetworkProblem<Space>& problem, const NetworkState<Space>& x,
                    const Parts& parts);

  /// (K + Z) y = b, or with the transpose. Throws where that cannot be solved. Where there are free
  /// motions: what b pushes along them is left out, and y is without them.
  void solve(const Vector& b, Vector& y, bool transposed);
  /// Overwrites columns by solutions.
  void solve_all(Eigen::MatrixXd& columns);

  /// Unknowns that move freely, in columns.
  const Eigen::MatrixXd& free() const { return refined_.free(); }

  /// Whether rounding of the gaps may matter.
  bool doubtful() const { return rounded_.has_value(); }
  /// Throws where it would change the solution y. `noise`: energy that is
  /// nothing.
  void require_sure(const Vector& y, double noise);
  /// By how much it changes the solution y.
  void find_rounding(const Vector& y, Vector& change) { rounded_->find(y, change, solver()); }

  /// out = Z v, the tangent beside its symmetric part, or Zᵀ v.
  void multiply_skew(const Vector& v, Vector& out, bool transposed);

  /// Whether the tangent is symmetric.
  bool symmetric() const { return !skew_; }
  /// The eigenvalue of the softest mode over the stiffness of the rods, if it is soft.
  std::optional<double> softest() const { return softest_; }
  /// Spans whose section force nothing tells.
  const std::vector<int>& undetermined() const { return undetermined_; }

 private:
  static constexpr double leeway_ = 1e-6;  ///< of a solution

  void look_for_modes();
  void look_for_forces();
  bool solved(const Vector& b, Vector& y, bool transposed) {
    return refined_.solve([&](const Vector& v, Vector& out) { multiply_skew(v, out, transposed); },
                          skew_, b, y);
  }
  auto solver() {
    return [this](const Vector& b, Vector& y) { return solved(b, y, false); };
  }
  [[noreturn]] void refuse() const {
    throw SingularEquilibrium(
        "linear: the equations for a change are singular: something moves freely, or a force is "
        "not determined",
        softest_.value_or(0));
  }

  const NetworkProblem<Space>& problem_;
  const NetworkState<Space>& x_;
  Parts parts_;
  UnknownRows<Space> rows_;
  Tangent<NetworkProblem<Space>> tangent_;
  Refined refined_;
  bool skew_;
  std::optional<double> softest_;
  std::vector<int> undetermined_;
  std::optional<RoundedGaps<Space>> rounded_;
  Items<Space> left_, turned_, acting_, forces_;  ///< storage for the transpose of Z
};

template <class Space>
ResponseEquations<Space>::ResponseEquations(const NetworkProblem<Space>& problem,
                                            const NetworkState<Space>& x, const Parts& parts)
    : problem_(problem),
      x_(x),
      parts_(parts),
      rows_(problem.layout()),
      tangent_(problem),
      refined_(tangent_.factor()),
      skew_(!problem.conservative()) {
  tangent_.linearise(x, Hessian::exact);
  tangent_.factor().factorise(0);
  look_for_modes();
  look_for_forces();
  if (!undetermined_.empty()) rounded_.emplace(problem, x, tangent_, solver());
}

template <class Space>
void ResponseEquations<Space>::look_for_modes() {
  if (skew_) return;  // the symmetric part alone says nothing
  if (const auto mode = tangent_.soft_mode()) softest_ = mode->eigenvalue;
  tangent_.factor().factorise(0);
  if (!tangent_.factor().broken() && !(softest_ && std::abs(*softest_) < 1e-8)) return;
  const FreeMotions<Space> motions(problem_, x_, tangent_);
  tangent_.factor().factorise(0);
  if (!motions.found())
    throw SingularEquilibrium(
        text("linear: the equilibrium is critical: a mode has no stiffness, its eigenvalue is ",
             softest_.value_or(0),
             " of that of the rods; there are no derivatives, see critical_load and path"),
        softest_.value_or(0));
  refined_.set_free(motions.modes());
}

/// Where nothing gives way to a section force, as in straight inextensible spans between fixed
/// points, it is what is added to the factor that tells it. Random gaps bring that out.
template <class Space>
void ResponseEquations<Space>::look_for_forces() {
  const auto& layout = problem_.layout();
  auto& factor = tangent_.factor();
  if (factor.multipliers().count() == 0) return;
  Vector gaps = Vector::Zero(layout.unknowns()), step;
  for (const int k : factor.multipliers().rows())
    gaps[k] = problem_.units()[k] * std::cos(1. + k * k % 101);
  factor.solve(gaps, step);
  refined_.leave_out(step);
  for (int p = 0; p < int(layout.spans().size()); ++p)
    if (const auto& span = layout.spans()[p]; span.block >= 0)
      for (int k = layout.row(span.block), i = 0; i < int(span.open.cols()); ++i, ++k)
        if (std::abs(factor.left(step, k)) > 1e-4 * problem_.units()[k]) {
          undetermined_.push_back(p);
          break;
        }
}

/// What `NetworkSkew` gives, or its transpose.
template <class Space>
void ResponseEquations<Space>::multiply_skew(const Vector& v, Vector& out, bool transposed) {
  if (!transposed) {
    problem_.multiply_skew(x_, v, out);
    return;
  }
  const auto zero = [](Items<Space>& items, int count) { items.setZero(item_width<Space>, count); };
  const int count = StateItems<Space>(problem_.layout()).count();
  zero(left_, count), zero(turned_, count);
  rows_.spread(v, left_);
  parts_.residual.skew().pull(left_, turned_);
  if (!problem_.dead_loads()) {
    zero(acting_, count), zero(forces_, NumberItems<Space>(problem_.layout()).count());
    parts_.residual.of_state().pull(left_, acting_);
    parts_.residual.balance().pull(left_, acting_);
    parts_.chains.pull_forces(left_, acting_);
    parts_.force.pull(acting_, forces_);
    parts_.followed.pull(forces_, turned_);
  }
  rows_.gather(turned_, out);
}

template <class Space>
void ResponseEquations<Space>::solve(const Vector& b, Vector& y, bool transposed) {
  if (!solved(b, y, transposed)) refuse();
}

template <class Space>
void ResponseEquations<Space>::solve_all(Eigen::MatrixXd& columns) {
  if (!skew_ && refined_.solve_all(columns)) return;
  Vector b, y;
  for (int k = 0; k < columns.cols(); ++k) {
    b = columns.col(k);
    solve(b, y, false);
    columns.col(k) = y;
  }
}

template <class Space>
void ResponseEquations<Space>::require_sure(const Vector& y, double noise) {
  const double moved = rounded_->moved(y, noise, solver());
  if (moved <= leeway_) return;
  throw SingularEquilibrium(
      text("linear: a rod that cannot stretch is held so straight that rounding of its length "
           "moves this derivative by ",
           moved, " of it; let the rod stretch, or hold it less taut"),
      softest_.value_or(0));
}

}  // namespace pyrod
