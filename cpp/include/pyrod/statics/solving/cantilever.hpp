// SPDX-License-Identifier: BSD-3-Clause
/// \file The scene of one rod clamped at its start: where solver and rod meet.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/solve/homotopy.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/equations/cantilever_problem.hpp>
#include <pyrod/statics/solution/cantilever_shape.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace pyrod {

/// A rod in equilibrium, and how it was found.
template <class Space>
struct Solution : RodSolution<Space> {
  Status status = Status::out_of_iterations;
  int index = -1;
  double residual = 0;
  int load_steps = 0;  ///< 0: all loads at once; else steps in which the forces were brought on
  std::vector<Iteration> record;

  double energy() const { return this->bend_twist_energy + this->stretch_shear_energy; }
};

/// A rod whose start is held in position and frame, under dead loads: what follows the rod, and
/// more supports, take a network (`held`). The equilibrium found may be a saddle, as its index
/// tells.
template <class Space>
class Cantilever {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;

  Cantilever(Rod<Space> rod, const Point<Space>& r0, const Rotation& q0, Loads<Space> loads)
      : rod_(std::move(rod)), r0_(r0), q0_(q0), loads_(std::move(loads)) {
    require(!rod_.grid.closed(), "grid: a rod that is held at its start needs an open grid");
    rod_.check();
    loads_.check(rod_.edges());
    require(!loads_.follow(),
            "loads: some follow the rod, which only a network can; solve held(rod, clamp, loads), "
            "or call solve(rod, dimension, model, clamp, loads), which does so");
    require(r0_.allFinite(), "position: expected finite numbers, got ", r0_.transpose());
    require_rotation(q0_, "frame");
  }

  /// Frames of the edges in equilibrium, and how they were found.
  struct Found : Result<Frames> {
    int load_steps = 0;
  };

  /// In one call from the start that `start` gives. Where moments have no potential and that fails,
  /// the forces are brought on step by step, from the shape that the moments alone give.
  Found find(const Options& options = {}, const Trace& trace = {}) const {
    Problem problem(rod_, q0_, loads_);
    auto [frames, first] = start();
    if (problem.conservative())
      return {Newton<Problem>(problem, options, trace).solve(std::move(frames), first)};
    Options short_of_patience = options;
    short_of_patience.max_iterations = std::min(options.max_iterations, 30);
    auto result =
        Newton<Problem>(problem, short_of_patience, trace).solve(std::move(frames), first);
    if (result.converged() || result.status == Status::interrupted) return {std::move(result)};
    return bring_on_forces(problem, result.record, options, trace);
  }

  /// From given frames of the edges, which are trusted to be near a solution.
  Found find(Frames frames, const Options& options = {}, const Trace& trace = {}) const {
    require_frames(frames, rod_.edges(), "start");
    const Problem problem(rod_, q0_, loads_);
    return {Newton<Problem>(problem, options, trace).solve(std::move(frames), Hessian::exact)};
  }

  /// All that follows, at every `stride`-th vertex; see `CantileverShape`.
  Solution<Space> told(Found found, int stride = 1) const {
    Solution<Space> out;
    out.status = found.status;
    out.index = found.index;
    out.residual = found.residual;
    out.load_steps = found.load_steps;
    out.record = std::move(found.record);
    static_cast<RodSolution<Space>&>(out) =
        CantileverShape<Space>(rod_, loads_, stride).solution(r0_, q0_, std::move(found.state));
    return out;
  }

  Solution<Space> solve(const Options& options = {}, const Trace& trace = {}) const {
    return told(find(options, trace));
  }
  Solution<Space> solve(Frames frames, const Options& options = {}, const Trace& trace = {}) const {
    return told(find(std::move(frames), options, trace));
  }

  const Rod<Space>& rod() const { return rod_; }
  const Loads<Space>& loads() const { return loads_; }

  /// The shape at rest; where the moments outweigh the forces, the shape that the moments alone
  /// give, which is a solution already if there are no forces. With it, the Hessian to begin with.
  std::pair<Frames, Hessian> start() const {
    if (!loads_.has_moments()) return {rod_.frames_at_rest(q0_), Hessian::convex};
    double moments = 0, levers = 0;
    for (const auto& m : loads_.moments_behind()) moments = std::max(moments, m.norm());
    for (const auto& n : loads_.section_forces())
      levers = std::max(levers, n.norm() * rod_.grid.length());
    if (moments <= levers) return {rod_.frames_at_rest(q0_), Hessian::convex};
    return {under_moments(), Hessian::exact};
  }

 private:
  using Problem = CantileverProblem<Space>;

  Found bring_on_forces(Problem& problem, const std::vector<Iteration>& before,
                        const Options& options, const Trace& trace) const {
    const auto part_of_forces = [&](double part, const Frames&) {
      auto forces = loads_.section_forces();
      for (auto& n : forces) n *= part;
      problem.set_forces(std::move(forces));
    };
    Options of_a_step = options;
    of_a_step.max_iterations = std::min(options.max_iterations, 12);
    Newton<Problem> newton(problem, of_a_step, trace);
    auto path = follow(newton, part_of_forces, under_moments());
    path.result.record.insert(path.result.record.begin(), before.begin(), before.end());
    return {std::move(path.result), path.steps};
  }

  /// The shape that the moments alone give the rod, marched along it.
  Frames under_moments() const {
    const auto m = loads_.moments_behind();
    Frames frames;
    frames.reserve(m.size());
    for (int j = 0; j < rod_.edges(); ++j) {
      const Rotation& before = j == 0 ? q0_ : frames[j - 1];
      frames.push_back(moved(before, turn_under(before, m[j], j)));
    }
    return frames;
  }

  /// The turn at vertex j under the spatial moment m, seen from the frame before it.
  Spin<Space> turn_under(const Rotation& before, const Spin<Space>& m, int j) const {
    return turn_under_moment<Space>(rotate_spin(before.conjugate(), m), rod_.bending[j], rod_.K0[j],
                                    rod_.grid.Δs(j));
  }

  Rod<Space> rod_;
  Point<Space> r0_;
  Rotation q0_;
  Loads<Space> loads_;
};

}  // namespace pyrod
