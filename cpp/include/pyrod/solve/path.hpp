// SPDX-License-Identifier: BSD-3-Clause
/// \file A path of equilibria from end to end, with its singular points. It knows no rods.
///
/// Steps are as long as the path bends little on them, and so short that between two of their ends
/// at most one singular point lies: no branch is left for another.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/solve/continuation.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/path_end.hpp>
#include <pyrod/solve/singular_point.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pyrod {

/// How far a path goes.
struct PathLimits {
  double start = 0, stop = 1;  ///< of λ; it also ends as far on the other side of the start
  int max_points = 500;
  /// Sees how many points there are, and λ at the last; returns false to stop.
  std::function<bool(int, double)> look = {};

  double range() const { return std::abs(stop - start); }
  double sign() const { return stop < start ? -1 : 1; }
};

template <class State>
struct FoundPath {
  struct Point {
    State x;
    double λ;
    int index;  ///< −1: there is no potential
  };
  std::vector<Point> points;
  std::vector<SingularPoint<State>> special;
  PathEnd ended = PathEnd::lost;
  std::string reason = {};  ///< what was refused where it was lost, if anything was
};

template <Family F>
class PathFollower {
 public:
  using State = typename F::State;
  using At = OnPath<State>;

  /// `family` must stay where it is.
  PathFollower(F& family, PathLimits limits)
      : limits_(std::move(limits)), continuation_(family, limits_.range() / fewest_) {}

  /// From an equilibrium at `start`.
  FoundPath<State> follow(State x) {
    At at;
    at.x = std::move(x), at.λ = limits_.start;
    return continuation_.begin(at, limits_.sign()) ? go(std::move(at)) : FoundPath<State>{};
  }

  /// Along the branch that crosses at a singular point, to one side.
  FoundPath<State> follow(const SingularPoint<State>& from, double side) {
    At at;
    SingularSearch<F> search(continuation_);
    if (!search.start(from, side * first_, at) || !continuation_.begin_along(at)) return {};
    return go(std::move(at));
  }

 private:
  static constexpr double fewest_ = 4;     ///< units that the range of λ has at the least
  static constexpr double first_ = 0.02;   ///< length of the first step
  static constexpr double least_ = 1e-6;   ///< of a step
  static constexpr double turn_ = 0.5;     ///< [rad] by which a step may turn anything
  static constexpr double bent_ = 0.6;     ///< [rad] between tangents: too long a step
  static constexpr double wanted_ = 0.25;  ///< the same, of steps to come
  static constexpr double share_ = 0.05;   ///< of the range of λ
  static constexpr int halvings_ = 24;
  static constexpr int most_modes_ = 3;      ///< at one special point
  static constexpr double off_ = 0.4;        ///< by which a corrector may lead from where it began
  static constexpr double together_ = 1e-4;  ///< singular points nearer than that are not parted

  enum class Event { none, fold, bifurcation, several };

  FoundPath<State> go(At&& first) {
    At at = std::move(first), before, to;
    double ds = first_, ds_before = 0;
    FoundPath<State> out;
    out.points.reserve(std::size_t(std::min(limits_.max_points, 200)));
    while (true) {
      out.points.push_back({at.x, at.λ, at.index});
      if (const auto ended = end(out)) {
        out.ended = *ended;
        return out;
      }
      ds = bounded(at, ds);
      Stepped how;
      const At* last = ds_before > 0 ? &before : nullptr;
      while (!(how = step_if_allowed(at, last, ds_before, ds, to, out)).found)
        if ((ds /= 2) < least_) return out;  // lost
      ds_before = ds;
      const double longer = std::clamp(wanted_ / std::max(how.angle, 1e-3), 0.5, 2.);
      ds *= how.factorisations > 5 ? 0.5 : how.factorisations > 3 ? std::min(longer, 1.) : longer;
      std::swap(before, at), std::swap(at, to);
    }
  }

  std::optional<PathEnd> end(const FoundPath<State>& path) const {
    const double λ = path.points.back().λ, gone = (λ - limits_.start) * limits_.sign();
    if (limits_.look && !limits_.look(int(path.points.size()), λ)) return PathEnd::interrupted;
    if (gone >= limits_.range() * (1 - 1e-12)) return PathEnd::reached;
    if (gone <= -limits_.range()) return PathEnd::turned_back;
    if (int(path.points.size()) >= limits_.max_points) return PathEnd::most_points;
    return std::nullopt;
  }

  double bounded(const At& at, double ds) const {
    const double turn = continuation_.largest_turn(at), λ = std::abs(at.rate);
    if (turn * ds > turn_) ds = turn_ / turn;
    if (λ * ds > share_ * limits_.range()) ds = share_ * limits_.range() / λ;
    return ds;
  }

  /// Adds the singular point that it passes, if there is one. Not found: shorter ones may be.
  Stepped step(const At& at, const At* before, double ds_before, double ds, At& to,
               FoundPath<State>& path) {
    Stepped how = continuation_.step(at, before, ds_before, ds, to);
    how.found = how.found && how.corrected <= off_ * ds;
    if (how.found && (to.λ - limits_.stop) * limits_.sign() > 0) {
      ds *= (limits_.stop - at.λ) / (to.λ - at.λ);
      how = continuation_.step_to(at, ds, limits_.stop, to);
    }
    how.found = how.found && how.angle <= bent_ && passes(at, to, ds, path);
    return how;
  }

  /// The same, where the family may refuse a value.
  Stepped step_if_allowed(const At& at, const At* before, double ds_before, double ds, At& to,
                          FoundPath<State>& path) {
    try {
      path.reason.clear();
      return step(at, before, ds_before, ds, to, path);
    } catch (const InvalidArgument& refused) {
      path.reason = refused.what();
      return {};
    }
  }

  static Event event(const At& a, const At& b) {
    const bool turns = (a.rate > 0) != (b.rate > 0);
    if (a.index < 0 || b.index < 0) return turns ? Event::fold : Event::none;
    const int modes = std::abs(b.index - a.index);
    if (modes == 0 && !turns) return Event::none;
    if (modes == 1) return turns ? Event::fold : Event::bifurcation;
    return Event::several;
  }

  /// Whether it is known what lies between.
  bool passes(const At& a, const At& b, double ds, FoundPath<State>& path) {
    const Event what = event(a, b);
    if (what == Event::none) return true;
    if (std::abs(b.index - a.index) > most_modes_) {  // as where a force becomes infinite
      path.reason = "many modes lose their stiffness at once";
      return false;
    }
    std::optional<SingularPoint<State>> found;
    SingularSearch<F> search(continuation_);
    if (what == Event::fold) found = search.fold(a, b, ds);
    if (what == Event::bifurcation) found = search.bifurcation(a, b, ds);
    if (!found && ds > together_) return false;
    if (!found && what == Event::several && b.index == a.index) found = search.fold(a, b, ds);
    if (!found) found = unresolved(a, b, ds);
    found->behind = path.points.size();
    path.special.push_back(std::move(*found));
    return true;
  }

  /// Where the index changes, for a reason that is not known: by halves.
  SingularPoint<State> unresolved(const At& a, const At& b, double ds) {
    At middle = a;
    double from = 0, to = ds;
    for (int i = 0; i < halvings_; ++i) {
      const double s = (from + to) / 2;
      if (!continuation_.step(a, nullptr, 0, s, middle).found) break;
      (middle.index == a.index ? from : to) = s;
    }
    SingularPoint<State> out;
    const bool several = std::abs(b.index - a.index) > 1;
    out.kind = several ? Singularity::multiple : Singularity::unresolved;
    out.x = middle.x, out.λ = middle.λ;
    // the shift of the factor lets eigenvalues change sides so much too late
    out.error = std::abs(a.rate) * (to - from) + 1e-6 * std::max(std::abs(out.λ), limits_.range());
    out.mode = Vector::Zero(a.turn.size());
    out.index_before = a.index, out.index_behind = b.index;
    return out;
  }

  PathLimits limits_;
  Continuation<F> continuation_;
};

}  // namespace pyrod
