// SPDX-License-Identifier: BSD-3-Clause
/// \file Steps along a path of equilibria, whatever λ does on it: a predictor along the tangent and
/// how that turns, a corrector at right angles to it (docs/theory.md, "Paths"). It knows no rods.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/family_tangent.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <utility>

namespace pyrod {

/// An equilibrium of a family, and the direction of its path: (turn, rate) is a unit vector.
template <class State>
struct OnPath {
  State x;
  double λ = 0;
  Vector turn;      ///< increments of the unknowns
  double rate = 0;  ///< of λ
  int index = -1;   ///< −1: there is no potential
};

/// How a step went.
struct Stepped {
  bool found = false;
  int factorisations = 0;
  double angle = 0;      ///< between the tangents at its ends [rad]
  double corrected = 0;  ///< length of all corrections
};

template <Family F>
class Continuation {
 public:
  using State = typename F::State;
  using At = OnPath<State>;

  /// Lengths are told by theory (38), `unit` its λ̂. `family` must stay where it is.
  Continuation(F& family, double unit) : tangent_(family), unit_(unit) {}

  FamilyTangent<F>& tangent() { return tangent_; }
  double unit() const { return unit_; }
  double product(const At& a, const At& b) const {
    return tangent_.product(a.turn, b.turn) + a.rate * b.rate / (unit_ * unit_);
  }
  double largest_turn(const At& a) const { return tangent_.largest(a.turn); }

  /// At λ itself, which goes the way of `towards`. False if there is no equilibrium near x.
  bool begin(At& at, double towards) {
    row_.setZero(tangent_.weights().size());
    tangent_.look_at(at.x, at.λ);
    tangent_.factorise(0);
    tangent_.look_for_neutral();
    if (!correct(at, 1, false)) return false;
    at.rate = tangent_.along(at.turn, false);
    if (at.rate * towards < 0) at.turn = -at.turn, at.rate = -at.rate;
    at.index = tangent_.index();
    return normalise(at);
  }

  /// At the equilibrium near `at` in the plane across its direction, which it may be only roughly.
  bool begin_along(At& at) {
    if (!normalise(at)) return false;
    tangent_.look_at(at.x, at.λ);
    tangent_.factorise(0);
    tangent_.look_for_neutral();
    take_row(at);
    return correct(at, at.rate / (unit_ * unit_), false) && turn_on(at, false);
  }

  /// From one point of a path to another, about `ds` behind it; `before`: the point before that,
  /// so far away, or null. `exact`: for the direction to be that of the new point to rounding.
  Stepped step(const At& from, const At* before, double ds_before, double ds, At& to,
               bool exact = false) {
    predict(from, before, ds_before, ds, to);
    take_row(from);
    const bool found = correct(to, from.rate / (unit_ * unit_), exact) && turn_on(to, exact);
    return stepped(from, to, found);
  }

  /// The same to a value of λ.
  Stepped step_to(const At& from, double ds, double λ, At& to) {
    predict(from, nullptr, 0, ds, to);
    to.λ = λ;
    row_.setZero(tangent_.weights().size());
    bool found = correct(to, 1, false);
    if (found) {
      take_row(from);
      tangent_.border(tangent_.slope(), row_, from.rate / (unit_ * unit_));
      found = turn_on(to, false);
    }
    return stepped(from, to, found);
  }

 private:
  static constexpr int most_ = 10;            ///< iterations of a corrector
  static constexpr double tolerance_ = 1e-8;  ///< of its last step; the square of that is left
  static constexpr double near_ = 1e-5;       ///< a shorter step needs no factor of its own
  static constexpr double longest_ = 1;       ///< [rad]
  static constexpr double drift_ = 1e-3;      ///< [rad]

  bool normalise(At& at) const {
    const double size = std::sqrt(product(at, at));
    at.turn /= size, at.rate /= size;
    return std::isfinite(size) && size > 0;
  }

  /// The row of the border: steps are at right angles to a direction.
  void take_row(const At& at) { row_ = tangent_.weights().cwiseProduct(at.turn); }

  /// Along the tangent, and along what it has turned by since the point before.
  void predict(const At& from, const At* before, double ds_before, double ds, At& to) {
    const double bend = before && ds_before > 0 ? ds * ds / (2 * ds_before) : 0;
    step_ = (ds + bend) * from.turn;
    to.λ = from.λ + (ds + bend) * from.rate;
    if (bend != 0) step_ -= bend * before->turn, to.λ -= bend * before->rate;
    tangent_.family().move(from.x, step_, to.x);
  }

  Stepped stepped(const At& from, const At& to, bool found) const {
    const double angle = found ? std::acos(std::clamp(product(from, to), -1., 1.)) : 0;
    return {found, factorisations_, angle, corrected_};
  }

  /// The direction at a point, as the last factor tells, on from that of the border.
  bool turn_on(At& to, bool exact) {
    to.rate = tangent_.along(to.turn, exact);
    to.index = tangent_.index();
    tangent_.judge_neutral();
    return normalise(to);
  }

  /// Newton's method for g = 0 across the row. Once steps are short, the factor of the one before
  /// does, unless the direction is wanted `exact`.
  bool correct(At& at, double corner, bool exact) {
    double before = std::numeric_limits<double>::infinity();
    factorisations_ = 0, corrected_ = 0;
    for (int i = 0; i < most_; ++i) {
      tangent_.look_at(at.x, at.λ);
      if (exact || !tangent_.conservative() || before > near_) {
        tangent_.find_slope();
        tangent_.factorise(0);
        if (tangent_.broken()) return false;
        tangent_.border(tangent_.slope(), row_, corner);
        ++factorisations_;
      }
      step_ = -tangent_.gradient();
      const double dλ = tangent_.step(step_, 0, other_);
      const double size = std::max(tangent_.largest(other_), std::abs(dλ) / unit_);
      if (!(size <= longest_)) return false;
      if (size > before / 2 && size > tolerance_)  // or drifts along what has no stiffness
        return size <= drift_ && tangent_.rounded();
      corrected_ += std::sqrt(tangent_.squared_norm(other_) + dλ * dλ / (unit_ * unit_));
      tangent_.family().move(at.x, other_, moved_);
      std::swap(at.x, moved_);
      at.λ += dλ;
      if (size <= tolerance_) {
        tangent_.family().set(at.λ);
        tangent_.family().place(at.x);
        return true;
      }
      before = size;
    }
    return false;
  }

  FamilyTangent<F> tangent_;
  double unit_;
  Vector row_, step_, other_;
  State moved_;
  int factorisations_ = 0;
  double corrected_ = 0;
};

}  // namespace pyrod
