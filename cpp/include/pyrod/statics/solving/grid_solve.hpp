// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a network on one grid: Newton's method, its last resorts, and the way
/// down from saddles.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/homotopy.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/mode.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/result.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/softness.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/solution/uncertainty.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/solving/slack_tendons.hpp>
#include <pyrod/statics/start/false_shapes.hpp>
#include <pyrod/statics/start/moving_supports.hpp>
#include <pyrod/statics/start/start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace pyrod {

/// Where a search has got to, and how it went there.
template <class Space>
struct Search {
  NetworkState<Space> state;
  Solution<Space> found;  ///< without rods and nodes
  double energy = 0;

  bool converged() const { return found.converged(); }
  bool interrupted() const { return found.status == Status::interrupted; }

  void keep(Result<NetworkState<Space>>&& result) {
    add_record(result.record);
    found.status = result.status;
    found.index = result.index;
    found.residual = result.residual;
    energy = result.energy;
    state = std::move(result.state);
  }
  void add_record(const std::vector<Iteration>& record) {
    found.record.insert(found.record.end(), record.begin(), record.end());
  }
};

/// Continues a search on one grid.
template <class Space>
class GridSolve {
 public:
  using Problem = NetworkProblem<Space>;
  using State = NetworkState<Space>;

  GridSolve(const Posed<Space>& posed, const Options& options, const NetworkOptions& more,
            const Trace& trace, Search<Space>& search)
      : layout_(posed.layout()),
        problem_(posed.problem()),
        options_(options),
        more_(more),
        trace_(trace),
        search_(search),
        newton_(problem_, options, trace, more.stable) {}

  /// `resort`: whether the last resorts are tried. `estimate`: nothing is known of the multipliers,
  /// but much of the shape.
  void solve(State start, Hessian first, bool resort, bool estimate = false) {
    const bool open = !layout_.determinate();  // some forces are found, not told
    loosen(problem_, start);
    if (!resort)
      search_.keep(newton_.solve(std::move(start), first, estimate, estimate && more_.anchored));
    else
      search_.keep(newton_.solve(start, first, estimate, estimate && more_.anchored));
    if (open && !search_.interrupted() && cannot_hold(layout_, search_.state, search_.converged()))
      search_.found.status = Status::taut;
    else if (resort && !search_.converged() && !search_.interrupted())
      bring_on_loads(start), look_there();
    if (open && !estimate && search_.converged()) untie_false_shapes();
    settle_tendons();
    finish();
  }

  /// From the shape that the moments alone give, the forces step by step.
  void bring_on_forces(State start) {
    Options of_a_step = options_;
    of_a_step.max_iterations = std::min(options_.max_iterations, 12);
    Problem problem = problem_;
    Newton<Problem> newton(problem, of_a_step, trace_, more_.stable);
    auto path =
        follow(newton, [&](double part, State&) { problem.load(part, 1); }, std::move(start));
    search_.found.load_steps = path.steps;
    search_.keep(std::move(path.result));
    look_there();
    finish();
  }

  /// What is asked of a solution besides its state.
  void look_around() {
    const Uncertainty<Space> left(problem_);
    auto& found = search_.found;
    if (more_.rounding && !layout_.determinate() && left.feels_rounding())
      found.rounding = left.rounding(newton_.rounding_step(search_.state));
    if (!problem_.conservative()) return;
    auto mode = newton_.soft_mode();
    found.softness = mode ? left.softness(search_.state, *mode) : Softness{};
    found.neutral = found.softness.neutral();
    if (!found.neutral) mode.reset();
    if (more_.eigenvalue) {
      mode = newton_.lowest_mode();
      found.lowest_eigenvalue = mode->eigenvalue;
    }
    found.mode.clear();
    for (int j = 0; mode && j < layout_.edges(); ++j)
      found.mode.push_back(mode->shape.template segment<Space::spin>(layout_.frame_row(j)));
  }

 private:
  /// Where another solver than `newton_` has led to, or from where that went astray.
  void look_there() {
    if (search_.converged()) newton_.look_at(search_.state);
  }

  /// Tendons of given length do not push: those that would are slack, until they are too short
  /// again.
  void settle_tendons() {
    const int most = 2 * int(layout_.network().tendons.size()) + 4;
    for (int i = 0; search_.converged() && settle(problem_, search_.state); ++i) {
      search_.keep(newton_.solve(search_.state, Hessian::exact));
      if (i == most && search_.converged()) search_.found.status = Status::stalled;
    }
  }

  void untie_false_shapes() {
    if (!untie(layout_, search_.state)) return;
    search_.keep(newton_.solve(search_.state, Hessian::exact));
    if (search_.converged() && untie(layout_, search_.state))
      search_.found.status = Status::too_coarse;
  }

  void finish() {
    for (int i = 0; i < 6 && more_.stable && search_.converged() && search_.found.index > 0; ++i) {
      if (!descend()) break;
      settle_tendons();
    }
    auto& found = search_.found;
    found.fill = newton_.fill();
    found.unknowns = layout_.unknowns();
    found.multipliers = layout_.multipliers();
  }

  /// First the supports alone, then the loads in steps; if that fails, the supports are led in from
  /// where rods are nearly straight; and if that fails, from the shapes at rest with loads and
  /// motions of the supports brought on together.
  void bring_on_loads(const State& start) {
    Problem problem = problem_;
    Newton<Problem> newton(problem, options_, trace_, more_.stable);
    const auto steps = [&](auto&& set, const State& from) {
      auto path = follow(newton, set, from);
      search_.found.load_steps += path.steps;
      search_.keep(std::move(path.result));
      return search_.converged() || search_.interrupted();
    };
    if (steps([&](double part, State&) { problem.load(part); }, start)) return;
    const Start<Space> shapes(layout_);
    if (const auto taut = shapes.has_choice() ? shapes.drawn_taut() : std::nullopt) {
      const State straight = taut->state();
      const auto lead_in = [&](double part, State& x) {
        problem.load(part);
        move_points(layout_, part, straight, x);
      };
      if (steps(lead_in, straight)) return;
    }
    const State rest = shapes.at_rest();
    steps(
        [&](double part, State& x) {
          problem.load(part);
          move_supports(layout_, part, rest, x);
        },
        rest);
  }

  /// Leaves a saddle along its unstable mode, to the side where a minimum, or less of a saddle, is
  /// found.
  bool descend() {
    const auto mode = newton_.lowest_mode();
    if (!(mode.eigenvalue < 0)) return false;
    const int before = search_.found.index;
    const double energy = search_.energy;
    Options careful = options_;  // short steps, so as to find the nearest minimum
    careful.trust = std::min(options_.trust, 0.5);
    newton_.set(careful);
    bool left = false;
    for (const double step : {0.3, -0.3, 1., -1.}) {
      State away;
      problem_.move(search_.state, step * mode.shape, away);
      auto result = newton_.solve(std::move(away), Hessian::exact);
      left = result.converged() &&
             (result.index < before || result.energy < energy - 1e-6 * problem_.unit_energy());
      if (left) {
        ++search_.found.descents;
        search_.keep(std::move(result));
        break;
      }
      search_.add_record(result.record);
    }
    newton_.set(options_);
    if (!left) look_there();
    return left;
  }

  const Layout<Space>& layout_;
  const Problem& problem_;
  Options options_;
  NetworkOptions more_;
  const Trace& trace_;
  Search<Space>& search_;
  Newton<Problem> newton_;  ///< at the state of the search
};

}  // namespace pyrod
