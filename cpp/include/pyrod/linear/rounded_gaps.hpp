// SPDX-License-Identifier: BSD-3-Clause
/// \file How far rounding of the gaps moves solutions of the linear equations of a network.
///
/// A span that can neither stretch nor move its ends closes its gap by bending. The straighter it
/// is, the less bending does, and the more bending rounding of the gap asks for: of a straight one
/// the force may be anything, and with it the stiffness against bending.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/tangent.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cmath>

namespace pyrod {

/// Compares the tangent with the one at a state that rounding cannot tell from the equilibrium.
template <class Space>
class RoundedGaps {
 public:
  /// `tangent`: at x. `solve(b, y)`: K y = b, and whether that was solved.
  template <class Solve>
  RoundedGaps(const NetworkProblem<Space>& problem, const NetworkState<Space>& x,
              Tangent<NetworkProblem<Space>>& tangent, const Solve& solve)
      : layout_(problem.layout()), tangent_(tangent), rounded_(problem) {
    Vector gaps = Vector::Zero(layout_.unknowns());
    for (const int k : tangent.multipliers().rows()) gaps[k] = tangent.rounding(x)[k] / 4;
    if (!solve(gaps, step_)) {
      tangent.factor().solve(gaps, step_);
      step_ /= largest_force();
    }
    NetworkState<Space> beside = x;
    problem.move(x, step_, beside);
    rounded_.linearise(beside, Hessian::exact);
  }

  /// By what part of itself the solution y moves, at the most, in the energy of bending. One whose
  /// energy is below `noise` is none.
  template <class Solve>
  double moved(const Vector& y, double noise, const Solve& solve) {
    if (energy(y) <= noise) return 0;
    return find(y, step_, solve) ? std::sqrt(energy(step_) / energy(y)) : 1;
  }

  /// By how much the solution y moves. Returns whether that is known; else it is by so much with
  /// the least that the factor has added.
  template <class Solve>
  bool find(const Vector& y, Vector& change, const Solve& solve) {
    tangent_.factor().matrix().multiply(y, here_);
    rounded_.factor().matrix().multiply(y, beside_);
    beside_ -= here_;
    if (solve(beside_, change)) return true;
    tangent_.factor().solve(beside_, change);
    return false;
  }

 private:
  double energy(const Vector& y) const { return y.cwiseAbs2().dot(tangent_.factor().stiffness()); }

  /// Of the multipliers in the step, over the unit of their spans.
  double largest_force() const {
    double out = 0;
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const auto& span = layout_.spans()[p]; span.block >= 0)
        out = std::max(out, step_.segment(layout_.row(span.block), span.open.cols()).norm() /
                                layout_.unit_force(p));
    return out;
  }

  const Layout<Space>& layout_;
  Tangent<NetworkProblem<Space>>& tangent_;
  Tangent<NetworkProblem<Space>> rounded_;
  Vector step_, here_, beside_;
};

}  // namespace pyrod
