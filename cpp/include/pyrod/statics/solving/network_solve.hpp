// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a network: from few edges to all of them, and down from saddles.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/solve/homotopy.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/saddle_newton.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/recovery.hpp>
#include <pyrod/statics/solution/rounding.hpp>
#include <pyrod/statics/solution/softness.hpp>
#include <pyrod/statics/solution/uncertainty.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/start/coarsening.hpp>
#include <pyrod/statics/start/false_shapes.hpp>
#include <pyrod/statics/start/start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// How a solve of a network went.
template <class Space>
struct NetworkResult {
  NetworkSolution<Space> solution;
  NetworkState<Space> state;
  Status status = Status::out_of_iterations;
  int index = -1;
  double residual = 0, fill = 1, energy = 0;
  int unknowns = 0, multipliers = 0;
  int load_steps = 0;  ///< 0: all loads at once
  int descents = 0;    ///< saddles that the search left along their unstable modes
  bool conservative = true;
  bool neutral = false;           ///< it can move along `mode` without a change of energy
  Softness softness;              ///< if the loads have a potential
  std::vector<Spin<Space>> mode;  ///< of the edges, material [rad]; if asked for, or neutral
  double lowest_eigenvalue = 0;   ///< if it was asked for, [N m]: of ∫ |φ|² ds/L
  Rounding rounding;              ///< if it was asked for
  std::vector<Iteration> record;
};

template <class Space>
class NetworkSolver {
 public:
  NetworkSolver(Network<Space> network, const Options& options, const NetworkOptions& more,
                Trace trace)
      : network_(std::move(network)), options_(options), more_(more), trace_(std::move(trace)) {
    network_.check();
    fine_ = std::make_unique<Posed>(network_);
  }

  const Layout<Space>& layout() const { return fine_->layout; }

  /// From the shapes that `Start` makes, through coarser grids.
  NetworkResult<Space> solve() {
    out_.state = Start<Space>(layout()).state();
    if (largest_turn() > std::numbers::pi - 1e-6) return finished();  // no grid tells such a start
    std::vector<std::unique_ptr<Posed>> coarser;
    for (const int edges : levels())
      coarser.push_back(std::make_unique<Posed>(coarsened(network_, edges)));
    Posed& first = coarser.empty() ? *fine_ : *coarser.front();
    const NetworkState<Space> start = std::move(out_.state);
    at_first(first, coarser.empty() ? start : Start<Space>(first.layout).state());
    for (std::size_t i = 0; i < coarser.size() && converged(); ++i) {
      Posed& to = i + 1 < coarser.size() ? *coarser[i + 1] : *fine_;
      at_level(to, refined(coarser[i]->layout, out_.state, to.layout), Hessian::exact, false);
    }
    if (!converged() && !coarser.empty() && out_.status != Status::interrupted &&
        out_.status != Status::taut)
      at_level(*fine_, start, Hessian::convex, true);
    return finished();
  }

  /// From a state that is trusted to be near.
  NetworkResult<Space> solve(NetworkState<Space> start) {
    at_level(*fine_, std::move(start), Hessian::exact, false, true);
    return finished();
  }

 private:
  using Problem = NetworkProblem<Space>;

  /// The network on one grid. The problem keeps a reference to the layout: not to be moved.
  struct Posed {
    Layout<Space> layout;
    Problem problem{layout};

    explicit Posed(const Network<Space>& network) : layout(network) {}
    Posed(const Posed&) = delete;
    Posed& operator=(const Posed&) = delete;
  };
  static constexpr int coarsest = 16, refinement = 8;

  bool converged() const { return out_.status == Status::converged; }

  /// Edges of a span on the coarser grids, the coarsest first. Such that a start does not turn by
  /// more than half a radian from edge to edge.
  std::vector<int> levels() const {
    int longest = 0, turns = 0;
    for (const auto& span : layout().spans()) longest = std::max(longest, span.last - span.first);
    for (const auto& a : layout().network().attachments) turns = std::max(turns, std::abs(a.turns));
    double rest = 0;
    for (const auto& rod : layout().network().rods) {
      double sum = 0;
      for (int j = 0; j < rod.grid.vertices(); ++j) sum += rod.grid.Δs(j) * rod.K0[j].norm();
      rest = std::max(rest, sum);
    }
    const double turn = 2 * std::numbers::pi * turns + rest;
    std::vector<int> out;
    for (int n = coarsest * std::max(1, int(std::ceil(turn / 8))); 2 * n <= longest;
         n *= refinement)
      out.push_back(n);
    return out;
  }

  /// On the coarsest grid. Where a rod may pass its supports in several ways, and the likeliest
  /// leads to no stable shape, another is tried before all that comes last.
  void at_first(Posed& posed, const NetworkState<Space>& start) {
    const bool choice = Start<Space>(posed.layout).has_choice();
    at_level(posed, start, Hessian::convex, !choice);
    if (!choice || settled()) return;
    NetworkResult<Space> before = out_;
    at_level(posed, Start<Space>(posed.layout, true).state(), Hessian::convex, false);
    if (settled()) return;
    if (before.status == Status::converged && (!converged() || before.index <= out_.index)) {
      before.record = std::move(out_.record);
      out_ = std::move(before);
    }
    if (!converged() && out_.status != Status::interrupted)
      at_level(posed, start, Hessian::convex, true);
  }

  /// Whether there is nothing better to look for.
  bool settled() const {
    return out_.status == Status::interrupted ||
           (converged() && (out_.index <= 0 || !more_.stable));
  }

  /// Solves on one grid; the result and its record go to `out_`.
  void at_level(Posed& posed, NetworkState<Space> start, Hessian first, bool resort,
                bool estimate = false) {
    auto& [layout, problem] = posed;
    SaddleNewton<Problem> newton(problem, options_, trace_, more_.stable);
    keep(newton.solve(start, first, estimate, estimate && more_.anchored));
    if (out_.status != Status::interrupted && cannot_hold(layout, out_.state, converged()))
      out_.status = Status::taut;
    else if (resort && !converged() && out_.status != Status::interrupted)
      bring_on_loads(problem, newton, start);
    if (!estimate && converged() && untie(layout, out_.state)) {
      keep(newton.solve(out_.state, Hessian::exact));
      if (converged() && untie(layout, out_.state)) out_.status = Status::too_coarse;
    }
    for (int i = 0; i < 6 && more_.stable && converged() && out_.index > 0; ++i)
      if (!descend(problem, newton)) break;
    out_.fill = newton.fill();
    out_.unknowns = int(problem.weights().size());
    out_.multipliers = int((problem.weights().array() == 0).count());
    out_.conservative = problem.conservative();
    if (&posed != fine_.get() || !converged()) return;
    const Uncertainty<Space> open(problem);
    if (more_.rounding && open.feels_rounding())
      out_.rounding = open.rounding(newton.rounding_step());
    if (out_.conservative) look_at_modes(open, newton);
  }

  void look_at_modes(const Uncertainty<Space>& open, SaddleNewton<Problem>& newton) {
    auto mode = newton.soft_mode();
    out_.softness = mode ? open.softness(out_.state, *mode) : Softness{};
    out_.neutral = out_.softness.neutral();
    if (!out_.neutral) mode.reset();
    if (more_.eigenvalue) {
      mode = newton.lowest_mode();
      out_.lowest_eigenvalue = mode->eigenvalue;
    }
    out_.mode.clear();
    for (int j = 0; mode && j < layout().edges(); ++j)
      out_.mode.push_back(mode->shape.template segment<Space::spin>(layout().frame_row(j)));
  }

  void keep(Result<NetworkState<Space>>&& result) {
    out_.record.insert(out_.record.end(), result.record.begin(), result.record.end());
    out_.status = result.status;
    out_.index = result.index;
    out_.residual = result.residual;
    out_.energy = result.energy;
    out_.state = std::move(result.state);
  }

  /// The last resort: first the supports alone, then the loads in steps; if that fails, the
  /// supports are led in from where rods are nearly straight; and if that fails, from the shapes at
  /// rest with loads and motions of the supports brought on together.
  void bring_on_loads(Problem& problem, SaddleNewton<Problem>& newton,
                      const NetworkState<Space>& start) {
    const auto steps = [&](auto&& set, const NetworkState<Space>& from) {
      auto path = follow(newton, set, from);
      problem.load(1);
      out_.load_steps += path.steps;
      keep(std::move(path.result));
    };
    steps([&](double part, NetworkState<Space>&) { problem.load(part); }, start);
    if (converged() || out_.status == Status::interrupted) return;
    const Start<Space> shapes(problem.layout());
    if (const auto taut = shapes.has_choice() ? shapes.drawn_taut() : std::nullopt) {
      const NetworkState<Space> straight = taut->state();
      steps(
          [&](double part, NetworkState<Space>& x) {
            problem.load(part);
            shapes.move_points(part, straight, x);
          },
          straight);
      if (converged() || out_.status == Status::interrupted) return;
    }
    const NetworkState<Space> rest = shapes.at_rest();
    steps(
        [&](double part, NetworkState<Space>& x) {
          problem.load(part);
          shapes.move_supports(part, rest, x);
        },
        rest);
  }

  /// Leaves a saddle along its unstable mode, to the side where a minimum, or less of a saddle, is
  /// found.
  bool descend(const Problem& problem, SaddleNewton<Problem>& newton) {
    const auto mode = newton.lowest_mode();
    if (!(mode.eigenvalue < 0)) return false;
    const int before = out_.index;
    const double energy = out_.energy;
    Options careful = options_;  // short steps, so as to find the nearest minimum
    careful.trust = std::min(options_.trust, 0.5);
    newton.set(careful);
    for (const double step : {0.3, -0.3, 1., -1.}) {
      NetworkState<Space> away;
      problem.move(out_.state, step * mode.shape, away);
      auto result = newton.solve(std::move(away), Hessian::exact);
      if (result.converged() &&
          (result.index < before || result.energy < energy - 1e-6 * problem.unit_energy())) {
        ++out_.descents;
        keep(std::move(result));
        newton.set(options_);
        return true;
      }
      out_.record.insert(out_.record.end(), result.record.begin(), result.record.end());
    }
    newton.set(options_);
    return false;
  }

  NetworkResult<Space> finished() {
    if (int(out_.state.frames.size()) != layout().edges())
      out_.state = Start<Space>(layout()).state();
    if (!converged() && out_.status != Status::interrupted && out_.status != Status::taut &&
        largest_turn() > 2.5)
      out_.status = Status::too_coarse;
    out_.solution = Recovery<Space>(fine_->problem, out_.state).solution();
    return std::move(out_);
  }

  /// Between neighbouring edges [rad].
  double largest_turn() const {
    double largest = 0;
    for (int rod = 0; rod < int(layout().network().rods.size()); ++rod)
      for (int j = 1; j < layout().network().rods[rod].edges(); ++j) {
        const auto &a = out_.state.frames[layout().edge(rod, j - 1)],
                   &b = out_.state.frames[layout().edge(rod, j)];
        largest = std::max(largest, log(a.conjugate() * b).norm());
      }
    return largest;
  }

  Network<Space> network_;  // as given: what a layout makes of it has its units and nodes already
  Options options_;
  NetworkOptions more_;
  Trace trace_;
  std::unique_ptr<Posed> fine_;
  NetworkResult<Space> out_;
};

}  // namespace pyrod
