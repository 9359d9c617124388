// SPDX-License-Identifier: BSD-3-Clause
/// \file Where a path has no single direction, or λ none: folds and bifurcations, found to rounding
/// and told apart (docs/theory.md, "Paths"). It knows no rods.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/solve/continuation.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/family_tangent.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/solve/reduction.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <utility>

namespace pyrod {

template <class State>
struct SingularPoint {
  Singularity kind = Singularity::fold;
  State x;
  double λ = 0, error = 0;                   ///< of λ: what is left of its search, and rounding
  Vector mode;                               ///< that has no stiffness, Σ weights mode² = 1
  int index_before = -1, index_behind = -1;  ///< −1: there is no potential
  std::size_t behind = 0;                    ///< so many points of the path

  /// Of the branch that crosses: x_λ, and λ = λ₀ + slope ξ + bend ξ²/2 for the amplitude ξ.
  Vector x_λ;
  double slope = 0, bend = 0;

  bool branches() const {
    return kind == Singularity::transcritical || kind == Singularity::supercritical ||
           kind == Singularity::subcritical;
  }
};

template <Family F>
class SingularSearch {
 public:
  using State = typename F::State;
  using At = OnPath<State>;
  using Point = SingularPoint<State>;

  explicit SingularSearch(Continuation<F>& path) : path_(path), tangent_(path.tangent()) {}

  /// Between two points `ds` apart at which λ goes different ways: where dλ/ds = 0, by secants.
  std::optional<Point> fold(const At& a, const At& b, double ds) {
    double from = 0, to = ds, s = 0, before = ds, rate_before = b.rate;
    At at = a, next;
    Point out;
    for (int i = 0; i < most_; ++i) {
      double zero = s + (before - s) * at.rate / (at.rate - rate_before);
      if (!(zero > from && zero < to)) zero = (from + to) / 2;
      if (!path_.step(at, nullptr, 0, zero - s, next, true).found) return std::nullopt;
      before = s, rate_before = at.rate, s = zero;
      std::swap(at, next);
      ((at.rate > 0) == (a.rate > 0) ? from : to) = s;
      const double left = std::abs(at.rate * (s - before));
      out.error = left + rounding_ * std::max(std::abs(at.λ), path_.unit());
      if (left <= rounding_ * path_.unit()) break;
    }
    out.x = at.x, out.λ = at.λ, out.mode = at.turn;
    out.mode /= std::sqrt(tangent_.squared_norm(out.mode));
    finish(a, b, out);
    return out;
  }

  /// Between two points `ds` apart whose indices differ by one. None: nothing was found there, or
  /// branches that come near each other, but do not meet.
  std::optional<Point> bifurcation(const At& a, const At& b, double ds) {
    At near;
    if (!path_.step(a, nullptr, 0, ds / 2, near).found) return std::nullopt;
    unit_ = std::clamp(std::abs(b.λ - a.λ), 1e-3 * path_.unit(), path_.unit());
    Vector mode = tangent_.soft_mode().shape;
    Point out;
    if (!find_saddle(near.x, near.λ, std::move(mode), out)) return std::nullopt;
    const double low = std::min(a.λ, b.λ), high = std::max(a.λ, b.λ), more = 0.5 * (high - low);
    if (out.λ < low - more || out.λ > high + more) return std::nullopt;
    finish(a, b, out);
    if (!tell_branches(a, b, out)) return std::nullopt;
    return out;
  }

  /// The start of the branch that crosses, on one side.
  bool start(const Point& from, double ξ, At& out) {
    Reduction<F> about(tangent_, from.x, from.mode);
    Reduced<State> at, found;
    at.x = from.x, at.λ = from.λ, at.x_ξ = from.mode, at.x_λ = from.x_λ;
    double λ_ξ = 0;
    const double λ = from.λ + ξ * from.slope + ξ * ξ * from.bend / 2;
    if (!about.find_equilibrium(at, ξ, λ, found, λ_ξ)) return false;
    const double side = ξ < 0 ? -1 : 1;
    out.x = found.x, out.λ = found.λ;
    out.turn = side * found.x_ξ, out.rate = side * λ_ξ;
    return true;
  }

 private:
  static constexpr int most_ = 30;
  static constexpr double rounding_ = 1e-14;
  static constexpr double apart_ = 1e-3;      ///< over which is differenced
  static constexpr double longest_ = 0.3;     ///< of a step
  static constexpr double meet_ = 1e-9;       ///< of the unit of energies: what rounding may leave
  static constexpr double amplitude_ = 1e-2;  ///< at which the bend of a branch is seen
  static constexpr double level_ = 1e-4;      ///< dλ/dξ in units: none

  static void finish(const At& a, const At& b, Point& out) {
    out.index_before = a.index, out.index_behind = b.index;
  }

  /// Where both first derivatives of β are zero, and so is β: theory (41).
  bool find_saddle(const State& near, double λ, Vector mode, Point& out) {
    Reduction<F> reduction(tangent_, near, std::move(mode));
    Reduced<State> at, next;
    if (!reduction.begin(λ, at)) return false;
    const double unit = unit_;
    Curved by;
    double before = 1, change = 1;
    bool known = false;
    for (int i = 0; i < most_; ++i) {
      if (!known && !reduction.differentiate(at, apart_, apart_ * unit, by)) return false;
      const double det = by.ξξ * by.λλ - by.ξλ * by.ξλ;
      if (!(det < 0)) return false;  // no branches cross
      double dξ = -(by.λλ * at.β_ξ - by.ξλ * at.β_λ) / det,
             dλ = -(by.ξξ * at.β_λ - by.ξλ * at.β_ξ) / det;
      change = std::max(std::abs(dξ), std::abs(dλ) / unit);
      if (const double cut = change / longest_; cut > 1) dξ /= cut, dλ /= cut;
      if (!reduction.go(at, at.ξ + dξ, at.λ + dλ, next)) return false;
      std::swap(at, next);
      if (change <= 1e-13 || (change <= 1e-8 && change >= before / 4)) break;
      known = change <= before / 20;
      before = change;
    }
    if (change > 1e-8 || std::abs(at.β) > meet_ * tangent_.family().unit_energy()) return false;
    out.x = at.x, out.λ = at.λ;
    out.error = change * unit + rounding_ * std::max(std::abs(at.λ), unit);
    out.mode = at.x_ξ;
    return true;
  }

  /// Where the branch that crosses goes to, from the second derivatives of β, and what that makes
  /// of the point.
  bool tell_branches(const At& a, const At& b, Point& out) {
    Reduction<F> about(tangent_, out.x, out.mode);
    Reduced<State> at, more, less;
    Curved by;
    if (!about.begin(out.λ, at) || !about.differentiate(at, apart_, apart_ * unit_, by))
      return false;
    out.mode = at.x_ξ, out.x_λ = at.x_λ;
    const double unit = unit_;
    const double ξ = about.amplitude(b.x) - about.amplitude(a.x), λ = (b.λ - a.λ) / unit;
    const auto [other_ξ, other_λ] = other_root(by.ξξ, by.ξλ * unit, by.λλ * unit * unit, ξ, λ);
    if (!(std::abs(other_ξ) > level_ * std::abs(other_λ))) return false;
    out.slope = unit * other_λ / other_ξ;
    const bool pitchfork = std::abs(out.slope) <= level_ * unit;
    if (pitchfork) out.slope = 0;
    double rate = 0, ε = amplitude_;
    if (!about.find_equilibrium(at, ε, at.λ + ε * out.slope, more, rate) ||
        !about.find_equilibrium(at, -ε, at.λ - ε * out.slope, less, rate))
      return false;
    out.bend = (more.λ - 2 * at.λ + less.λ) / (ε * ε);
    if (!pitchfork) {
      out.kind = Singularity::transcritical;
      return true;
    }
    const bool beyond = out.bend * (b.λ - a.λ) * (b.index - a.index) > 0;
    out.kind = beyond ? Singularity::supercritical : Singularity::subcritical;
    return true;
  }

  /// Of A ξ² + 2 B ξ λ + D λ² = 0, theory (42), the root that is farther from (ξ, λ).
  static std::pair<double, double> other_root(double A, double B, double D, double ξ, double λ) {
    const double q = -(B + std::copysign(std::sqrt(std::max(0., B * B - A * D)), B));
    const auto along = [&](double x, double y) {
      return std::abs(x * ξ + y * λ) / std::hypot(x, y);
    };
    return along(q, A) < along(D, q) ? std::pair(q, A) : std::pair(D, q);
  }

  Continuation<F>& path_;
  FamilyTangent<F>& tangent_;
  double unit_ = 1;  ///< of λ about a bifurcation
};

}  // namespace pyrod
