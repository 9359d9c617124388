// SPDX-License-Identifier: BSD-3-Clause
/// \file What free motions of an equilibrium change of it: what has no derivative there.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/at_state.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/response_change.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace pyrod {

/// What a motion leaves as it is, but for rounding, is zero.
template <class Space>
class FreeChanges {
 public:
  using Change = ResponseChange<Space>;

  /// `at` must stay where it is.
  explicit FreeChanges(const AtState<Space>& at) : at_(at) {
    for (const auto& rod : at.net.rods) length_ = std::max(length_, rod.grid.length());
  }

  /// What a motion by 1 rad, or a length, changes.
  void add(Change change) {
    auto &state = change.state, &told = change.told;
    const auto& items = at_.told;
    const double moment = at_.layout.unit_moment(), force = moment / length_;
    const int edges = at_.layout.edges(), vertices = items.vertices(),
              nodes = int(at_.net.nodes.size()), tendons = int(at_.net.tendons.size());
    state.rightCols(state.cols() - 2 * edges).setZero();
    told.leftCols(edges).setZero();  // reaches are told by positions
    clean(state.leftCols(edges), 1), clean(state.middleCols(edges, edges), force);
    clean(told.middleCols(items.strain(0), edges), 1);
    clean(told.middleCols(items.vertex_turn(0), vertices), 1);
    clean(told.middleCols(items.curvature(0), vertices), 1 / length_);
    clean(told.middleCols(items.moment(0), vertices), moment);
    clean(told.middleCols(items.rotation(0), vertices), 1);
    clean(told.middleCols(items.reaction_force(0), nodes), force);
    clean(told.middleCols(items.reaction_moment(0), nodes), moment);
    clean(told.middleCols(items.energy(), 1), moment);
    clean(told.middleCols(items.tendon_length(0), tendons), length_);
    clean(told.middleCols(items.tension(0), tendons), force);
    clean(change.positions.leftCols(vertices), length_);
    all_.push_back(std::move(change));
  }

  const std::vector<Change>& all() const { return all_; }

  /// What they move is NaN.
  void forget(Change& out) const {
    for (const auto& moved : all_)
      Change::for_both(out, moved, [](auto& to, const auto& by) {
        to =
            (by.array() != 0).select(std::numeric_limits<double>::quiet_NaN(), to.array()).matrix();
      });
  }

  /// Throws if they change a weighted sum.
  void require_unmoved(const Change& weights) const {
    for (const auto& moved : all_) {
      double sum = 0, size = 0;
      Change::for_both(weights, moved, [&](const auto& w, const auto& by) {
        sum += w.cwiseProduct(by).sum(), size += w.cwiseProduct(by).cwiseAbs().sum();
      });
      if (std::abs(sum) > leeway_ * size)
        throw SingularEquilibrium(
            "linear: the equilibrium may move freely, and what is weighed changes with that: there "
            "is no derivative",
            0);
    }
  }

  /// Whether a change pushes by what is rounding, beside the forces and moments it makes.
  bool is_rounding(double push, const Vector& right_side, const Change& out) const {
    const auto& items = at_.told;
    const double moments = out.told.middleCols(items.moment(0), items.vertices())
                               .template lpNorm<Eigen::Infinity>(),
                 forces = out.state.middleCols(at_.layout.edges(), at_.layout.edges())
                              .template lpNorm<Eigen::Infinity>();
    return std::abs(push) <= leeway_ * std::max({right_side.template lpNorm<Eigen::Infinity>(),
                                                 moments, forces * length_});
  }

 private:
  static constexpr double leeway_ = 1e-6;

  static void clean(auto&& items, double unit) {
    items = (items.array().abs() > leeway_ * unit).select(items.array(), 0.).matrix();
  }

  const AtState<Space>& at_;
  double length_ = 0;
  std::vector<Change> all_;
};

}  // namespace pyrod
