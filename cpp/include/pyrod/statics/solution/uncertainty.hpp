// SPDX-License-Identifier: BSD-3-Clause
/// \file What rounding and soft modes leave open of an equilibrium of a network.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/rounding.hpp>
#include <pyrod/statics/solution/softness.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cmath>

namespace pyrod {

template <class Space>
class Uncertainty {
 public:
  using Problem = NetworkProblem<Space>;

  /// `problem` must stay where it is.
  explicit Uncertainty(const Problem& problem)
      : problem_(problem), layout_(problem.layout()), rods_(layout_.network().rods) {}

  /// Whether a span gives way along itself; else its gaps are closed by bending, which is soft, and
  /// rounding of them makes no forces.
  bool feels_rounding() const {
    return std::any_of(rods_.begin(), rods_.end(), [](const auto& rod) {
      return !rod.stretching.back().array().isInf().all();
    });
  }

  /// What the step makes of forces and moments that rounding of the gaps may ask for.
  Rounding rounding(const Vector& step) const {
    Rounding out;
    out.force = largest_force(step);
    for_each_cell(step, [&](const auto& change, int rod, int j) {
      const auto& r = rods_[rod];
      out.moment = std::max(out.moment, r.bending[j].cwiseProduct(change).norm() / r.grid.Δs(j));
    });
    return out;
  }

  /// Rounding leaves moments in the cells of an eighth of what the rows allow for, at random, which
  /// push along the mode by what it turns the cells: theory (26).
  Softness softness(const NetworkState<Space>& x, const Mode& mode) const {
    Softness out{mode.eigenvalue};
    Vector rounding;
    problem_.rounding(x, rounding);
    double squares = 0;
    for_each_cell(mode.shape, [&](const auto& change, int rod, int j) {
      const double row = rounding[layout_.frame_row(layout_.edge(rod, j))];
      squares += std::pow(change.norm() * row / 8, 2);
      out.bend = std::max(out.bend, change.norm() / rods_[rod].grid.Δs(j));
    });
    out.push = largest_force(mode.multipliers);
    const double stiffness =
        std::abs(mode.eigenvalue) * mode.shape.cwiseAbs2().dot(problem_.stiffness());
    out.drift = std::sqrt(squares) / stiffness;
    return out;
  }

 private:
  /// Calls see(change of the turn, rod, vertex) for the cells inside all rods.
  template <class See>
  void for_each_cell(const Vector& step, const See& see) const {
    const auto turn = [&](int rod, int j) -> Spin<Space> {
      return step.template segment<Space::spin>(layout_.frame_row(layout_.edge(rod, j)));
    };
    for (int rod = 0; rod < int(rods_.size()); ++rod)
      for (int j = 1; j < rods_[rod].edges(); ++j)
        see(Spin<Space>(turn(rod, j) - turn(rod, j - 1)), rod, j);
  }

  /// Of the section forces that a step of the multipliers adds.
  double largest_force(const Vector& step) const {
    double out = 0;
    for (const auto& span : layout_.spans())
      if (span.block >= 0)
        out = std::max(
            out, (span.open * step.segment(layout_.row(span.block), span.open.cols())).norm());
    return out;
  }

  const Problem& problem_;
  const Layout<Space>& layout_;
  const std::vector<Rod<Space>>& rods_;
};

}  // namespace pyrod
