// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a network: from few edges to all of them.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/recovery.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/solving/grid_solve.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/clamped_start.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/start/outlook.hpp>
#include <pyrod/statics/start/start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace pyrod {

template <class Space>
class NetworkSolver {
 public:
  using State = NetworkState<Space>;

  /// `posed` must stay where it is.
  NetworkSolver(const Posed<Space>& posed, const Options& options, const NetworkOptions& more,
                Trace trace)
      : posed_(posed),
        layout_(posed.layout()),
        options_(options),
        more_(more),
        trace_(std::move(trace)) {}

  /// From the shapes that `ClampedStart` and `Start` make.
  Found<Space> find() {
    if (layout_.determinate() && posed_.problem().dead_loads())
      solve_clamped();
    else
      solve_from_coarse();
    return finished();
  }

  /// From a state that is trusted to be near; `forces`: so are its section forces.
  Found<Space> find(State start, bool forces = false) {
    on(posed_, options_,
       [&](auto& grid) { grid.solve(std::move(start), Hessian::exact, false, !forces); });
    return finished();
  }

 private:
  static constexpr int patience = 30;         ///< iterations under moments that have no potential
  static constexpr double short_step = 1e-6;  ///< [rad]: the next is but rounding

  template <class Solve>
  void on(const Posed<Space>& posed, const Options& options, const Solve& solve) {
    GridSolve<Space> grid(posed, options, more_, trace_, search_);
    solve(grid);
    if (&posed == &posed_ && search_.converged()) grid.look_around();
  }

  /// Through coarser grids, if there are any; if that fails, or the start is the solution, on all
  /// edges at once.
  void solve_clamped() {
    if (posed_.coarser() > 0 && !ClampedStart<Space>(layout_).exact()) {
      climb([&](const Posed<Space>& coarsest) { solve_clamped_on(coarsest); });
      if (search_.converged() || search_.interrupted()) return;
      search_.found.load_steps = search_.found.descents = 0;
    }
    solve_clamped_on(posed_);
  }

  /// Where moments have no potential and that fails, the forces are brought on step by step, from
  /// the shape under moments alone.
  void solve_clamped_on(const Posed<Space>& posed) {
    const ClampedStart<Space> start(posed.layout());
    const bool potential = posed.problem().conservative();
    Options patient = options_;
    if (!potential) patient.max_iterations = std::min(options_.max_iterations, patience);
    on(posed, patient, [&](auto& grid) { grid.solve(start.state(), start.first(), false); });
    if (potential || search_.converged() || search_.interrupted()) return;
    on(posed, options_, [&](auto& grid) { grid.bring_on_forces(start.under_moments()); });
  }

  /// `first`: solves on the coarsest grid. From there to ever finer ones, until one step and its
  /// check are expected to do on all edges.
  template <class First>
  void climb(const First& first) {
    first(posed_.coarser(0));
    const int grids = posed_.coarser();
    Outlook<Space> outlook;
    double expected = 1;  // length of the first step on the next grid
    for (int i = 0; i < grids && search_.converged(); ++i) {
      outlook.add(posed_.coarser(i).layout(), search_.state);
      const bool last = i + 1 == grids || expected <= short_step;
      const auto& to = last ? posed_ : posed_.coarser(i + 1);
      const bool sees_change = outlook.sees_change();
      const auto before = search_.found.record.size();
      const int descents = search_.found.descents;
      on_grid(to, outlook.on(to.layout()), Hessian::exact, false);
      if (last) return;
      if (search_.found.descents > descents) outlook.clear();
      // what is left when second order is known is of fourth order
      expected = sees_change ? search_.found.record[before].step / 256 : 1;
    }
  }

  /// Through coarser grids.
  void solve_from_coarse() {
    const State start = Start<Space>(layout_).state();
    search_.state = start;
    if (largest_turn() > std::numbers::pi - 1e-6) return;  // no grid tells such a start
    if (posed_.coarser() == 0) return on_first(posed_, start);
    climb([&](const Posed<Space>& coarsest) {
      on_first(coarsest, Start<Space>(coarsest.layout()).state());
    });
    if (!search_.converged() && !search_.interrupted() && search_.found.status != Status::taut)
      on_grid(posed_, start, Hessian::convex, true);
  }

  void on_grid(const Posed<Space>& posed, const State& start, Hessian first, bool resort) {
    on(posed, options_, [&](auto& grid) { grid.solve(start, first, resort); });
  }

  /// On the coarsest grid. Where a rod may pass its supports in several ways, and the likeliest
  /// leads to no stable shape, another is tried before all that comes last.
  void on_first(const Posed<Space>& posed, const State& start) {
    const bool choice = Start<Space>(posed.layout()).has_choice();
    on_grid(posed, start, Hessian::convex, !choice);
    if (!choice || settled()) return;
    Search<Space> before = search_;
    on_grid(posed, Start<Space>(posed.layout(), true).state(), Hessian::convex, false);
    if (settled()) return;
    if (before.converged() && (!search_.converged() || before.found.index <= search_.found.index)) {
      before.found.record = std::move(search_.found.record);
      search_ = std::move(before);
    }
    if (!search_.converged() && !search_.interrupted())
      on_grid(posed, start, Hessian::convex, true);
  }

  /// Whether there is nothing better to look for.
  bool settled() const {
    return search_.interrupted() ||
           (search_.converged() && (search_.found.index <= 0 || !more_.stable));
  }

  Found<Space> finished() {
    auto& status = search_.found.status;
    if (int(search_.state.frames.size()) != layout_.edges())
      search_.state = Start<Space>(layout_).state();
    if (!search_.converged() && !search_.interrupted() && status != Status::taut &&
        largest_turn() > 2.5)
      status = Status::too_coarse;
    return {static_cast<Course&&>(search_.found), std::move(search_.state),
            std::move(search_.found.mode)};
  }

  /// Between neighbouring edges [rad].
  double largest_turn() const {
    double largest = 0;
    for (int rod = 0; rod < int(layout_.network().rods.size()); ++rod)
      for (int j = 1; j < layout_.network().rods[rod].edges(); ++j) {
        const auto &a = search_.state.frames[layout_.edge(rod, j - 1)],
                   &b = search_.state.frames[layout_.edge(rod, j)];
        largest = std::max(largest, log(a.conjugate() * b).norm());
      }
    return largest;
  }

  const Posed<Space>& posed_;
  const Layout<Space>& layout_;
  Options options_;
  NetworkOptions more_;
  Trace trace_;
  Search<Space> search_;
};

/// What was found says this, see `Recovery` for the rest.
template <class Space>
Solution<Space> told(const Posed<Space>& posed, const Found<Space>& found, int stride = 1,
                     bool from_moments = false) {
  Solution<Space> out{found, {}, {}, {}, found.mode};
  Recovery<Space>(posed.problem(), found.state, stride, from_moments).fill(out);
  return out;
}

/// From a state whose section forces are known, too.
template <class Space>
Found<Space> find_near(const Posed<Space>& posed, NetworkState<Space> start, const Options& options,
                       const NetworkOptions& more, const Trace& trace) {
  return NetworkSolver<Space>(posed, options, more, trace).find(std::move(start), true);
}

/// In the plane or in space. `start`: a shape that is trusted to be near; none: see `Start`.
template <class Space>
Found<Space> find(const Posed<Space>& posed, const std::optional<NetworkStart>& start,
                  const Options& options, const NetworkOptions& more, const Trace& trace) {
  NetworkSolver<Space> solver(posed, options, more, trace);
  if (!start) return solver.find();
  const StateNear<Space> near(posed.layout(), posed.here(), posed.network().nodes.size());
  return solver.find(near.state(*start));
}

}  // namespace pyrod
