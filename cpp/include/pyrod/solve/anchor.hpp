// SPDX-License-Identifier: BSD-3-Clause
/// \file Of equilibria that go over into each other at no cost, the one nearest to the start. It
/// knows no rods.
///
/// Steps of Newton's method drift along a motion without stiffness by chance: what errors of second
/// order push there is divided by next to nothing. So the start draws back, weaker as the steps get
/// smaller: along such a motion nothing else acts, and none of it is left.
#pragma once

#include <pyrod/core/types.hpp>

#include <algorithm>

namespace pyrod {

class Anchor {
 public:
  /// At the start of a solve; `held`: whether there is one.
  void drop(bool held, Eigen::Index size) {
    weight_ = held ? 1 : 0;
    if (held) moved_.setZero(size);
  }

  bool holds() const { return weight_ > 0; }
  /// Of the stiffness: what is added to that of the system.
  double weight() const { return weight_; }

  /// The gradient, and what draws back, theory (24).
  const Vector& pull(const Vector& gradient, const Vector& stiffness) {
    if (!holds()) return gradient;
    pull_ = gradient + weight_ * stiffness.cwiseProduct(moved_);
    return pull_;
  }

  /// A step from here is tried, shorter ones after it, and one is taken.
  void leave() {
    if (holds()) before_ = moved_;
  }
  void reach(double fraction, const Vector& step) {
    if (holds()) moved_ = before_ + fraction * step;
  }
  void go_back() {
    if (holds()) moved_ = before_;
  }

  /// The last step was taken whole and that long [rad]: in the end the loads act alone.
  void weaken(double step) {
    weight_ = std::min(0.3 * weight_, 100 * step);
    if (weight_ < 1e-6) weight_ = 0;
  }

 private:
  double weight_ = 0;
  Vector moved_, before_, pull_;  ///< all steps together, these up to the last, what `pull` tells
};

}  // namespace pyrod
