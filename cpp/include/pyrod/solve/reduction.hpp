// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibria near a singular one as the zeros of one function of two numbers, by Lyapunov
/// and Schmidt (docs/theory.md, "Paths"). It knows no rods.
///
/// For an amplitude ξ of a mode c and a parameter λ, theory (40), g(x, λ) + β W c = 0 and h(x) = ξ,
/// determines x and β: the matrix of that is regular where the tangent is singular. Equilibria are
/// where β = 0.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/family_tangent.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace pyrod {

/// A point of the reduced problem, and the first derivatives there.
template <class State>
struct Reduced {
  State x;
  double ξ = 0, λ = 0, β = 0;
  double β_ξ = 0, β_λ = 0;
  Vector x_ξ, x_λ;  ///< increments of the unknowns
};

/// Second derivatives of β.
struct Curved {
  double ξξ = 0, ξλ = 0, λλ = 0;
};

template <Family F>
class Reduction {
 public:
  using State = typename F::State;
  using At = Reduced<State>;

  /// About x0. `mode`: any increments to which the null vectors are not at right angles.
  Reduction(FamilyTangent<F>& tangent, State x0, Vector mode)
      : tangent_(tangent), x0_(std::move(x0)), mode_(std::move(mode)) {
    tangent_.family().amplitude(x0_, x0_, mode_, row_);
    const double size = std::sqrt(mode_.dot(row_));
    mode_ /= size;
    pushed_ = row_ / size;
  }

  /// x0 itself, at λ, where it is in equilibrium.
  bool begin(double λ, At& at) {
    at.x = x0_, at.ξ = 0, at.λ = λ, at.β = 0;
    return settle(at);
  }

  /// The point at other ξ and λ, from one that is near.
  bool go(const At& from, double ξ, double λ, At& to) {
    start(from, ξ, λ, to);
    to.β = from.β + (ξ - from.ξ) * from.β_ξ + (λ - from.λ) * from.β_λ;
    return settle(to);
  }

  /// The equilibrium of this amplitude, whatever its λ, from a point near it; and dx/dξ, dλ/dξ
  /// there, in place of what the derivatives for fixed λ would be.
  bool find_equilibrium(const At& from, double ξ, double λ, At& to, double& λ_ξ) {
    start(from, ξ, λ, to);
    to.β = 0;
    const auto turn = [&] { return λ_ξ = tangent_.exactly(none(), 1, to.x_ξ); };
    return iterate(
               to, [&] { tangent_.find_slope(); }, tangent_.slope(), to.λ) &&
           std::isfinite(turn());
  }

  /// By central differences of the first ones, over these distances.
  bool differentiate(const At& at, double dξ, double dλ, Curved& out) {
    At more, less;
    if (!go(at, at.ξ + dξ, at.λ, more) || !go(at, at.ξ - dξ, at.λ, less)) return false;
    out.ξξ = (more.β_ξ - less.β_ξ) / (2 * dξ);
    out.ξλ = (more.β_λ - less.β_λ) / (2 * dξ);
    if (!go(at, at.ξ, at.λ + dλ, more) || !go(at, at.ξ, at.λ - dλ, less)) return false;
    out.λλ = (more.β_λ - less.β_λ) / (2 * dλ);
    return true;
  }

  double amplitude(const State& x) { return tangent_.family().amplitude(x0_, x, mode_, other_); }

 private:
  static constexpr double shift_ = 1e-2;  ///< of the stiffness: far from singular
  static constexpr int most_ = 12;
  static constexpr double small_ = 1e-7;  ///< a step that rounding may keep from getting shorter
  static constexpr double rounding_ = 1e-13;

  Vector none() const { return Vector::Zero(mode_.size()); }

  void start(const At& from, double ξ, double λ, At& to) {
    step_ = (ξ - from.ξ) * from.x_ξ + (λ - from.λ) * from.x_λ;
    tangent_.family().move(from.x, step_, to.x);
    to.ξ = ξ, to.λ = λ;
  }

  /// At fixed λ, and what depends on it.
  bool settle(At& at) {
    if (!iterate(at, [] {}, pushed_, at.β)) return false;
    tangent_.find_slope();
    at.β_ξ = tangent_.exactly(none(), 1, at.x_ξ);
    at.β_λ = tangent_.exactly(-tangent_.slope(), 0, at.x_λ);
    return std::isfinite(at.β_ξ) && std::isfinite(at.β_λ);
  }

  /// Newton's method for x and the number that `column` belongs to, which `find_column` renews.
  /// What is factorised in the end is at x but for a step that rounding alone is left of.
  template <class FindColumn>
  bool iterate(At& at, const FindColumn& find_column, const Vector& column, double& number) {
    double before = std::numeric_limits<double>::infinity();
    for (int i = 0; i < most_; ++i) {
      tangent_.look_at(at.x, at.λ);
      const double off = at.ξ - tangent_.family().amplitude(x0_, at.x, mode_, row_);
      find_column();
      tangent_.factorise(shift_);
      if (tangent_.broken()) return false;
      tangent_.border(column, row_, 0);
      left_ = -tangent_.gradient() - at.β * pushed_;
      const double change = tangent_.exactly(left_, off, step_);
      const double size = tangent_.largest(step_);
      if (!(size <= 1) || !std::isfinite(change)) return false;
      tangent_.family().move(at.x, step_, moved_);
      std::swap(at.x, moved_);
      number += change;
      if (size <= rounding_ || (size <= small_ && size >= before / 4)) return true;
      before = size;
    }
    return false;
  }

  FamilyTangent<F>& tangent_;
  State x0_, moved_;
  Vector mode_, row_, pushed_;  ///< c, ∇h and W c
  Vector step_, left_, other_;
};

}  // namespace pyrod
