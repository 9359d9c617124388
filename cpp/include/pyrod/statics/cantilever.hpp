// SPDX-License-Identifier: BSD-3-Clause
/// \file The scene of one rod clamped at its start: where solver and rod meet.
#pragma once

#include <pyrod/rod/moment_law.hpp>
#include <pyrod/solve/homotopy.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/rod_solution.hpp>

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

/// A rod whose start is held in position and frame, under dead loads.
template <class Space, class Model>
class Cantilever {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;

  Cantilever(Rod<Space> rod, const Point<Space>& r0, const Rotation& q0, Loads<Space> loads)
      : rod_(std::move(rod)), r0_(r0), q0_(q0), loads_(std::move(loads)) {}

  /// In one call from the start that `start` gives. Where couples have no potential and that fails,
  /// the forces are brought on step by step, from the shape that the couples alone give.
  Solution<Space> solve(const Options& options = {}, const Trace& trace = {}) const {
    Problem problem(rod_, q0_, loads_);
    auto [frames, first] = start();
    if (problem.conservative()) return solve_from(std::move(frames), options, trace, first);
    Options short_of_patience = options;
    short_of_patience.max_iterations = std::min(options.max_iterations, 30);
    auto result =
        Newton<Problem>(problem, short_of_patience, trace).solve(std::move(frames), first);
    if (result.converged() || result.status == Status::interrupted) return finished(result);
    return bring_on_forces(problem, result.record, options, trace);
  }

  /// From given frames of the edges, which are trusted to be near a solution.
  Solution<Space> solve(Frames frames, const Options& options = {}, const Trace& trace = {}) const {
    return solve_from(std::move(frames), options, trace, Curvature::exact);
  }

  /// The shape at rest; where the couples outweigh the forces, the shape that the couples alone
  /// give, which is a solution already if there are no forces. With it, the Hessian to begin with.
  std::pair<Frames, Curvature> start() const {
    double couples = 0, levers = 0;
    for (const auto& m : loads_.couples_behind()) couples = std::max(couples, m.norm());
    for (const auto& n : loads_.section_forces())
      levers = std::max(levers, n.norm() * rod_.grid.length());
    if (couples <= levers) return {rod_.at_rest(r0_, q0_).frames, Curvature::convex};
    return {under_couples(), Curvature::exact};
  }

 private:
  using Problem = Equilibrium<Space, Model>;

  Solution<Space> solve_from(Frames frames, const Options& options, const Trace& trace,
                             Curvature first) const {
    const Problem problem(rod_, q0_, loads_);
    auto result = Newton<Problem>(problem, options, trace).solve(std::move(frames), first);
    return finished(result);
  }

  Solution<Space> bring_on_forces(Problem& problem, const std::vector<Iteration>& before,
                                  const Options& options, const Trace& trace) const {
    const auto part_of_forces = [&](double part, const Frames&) {
      auto forces = loads_.section_forces();
      for (auto& n : forces) n *= part;
      problem.set_forces(std::move(forces));
    };
    Options of_a_step = options;
    of_a_step.max_iterations = std::min(options.max_iterations, 12);
    Newton<Problem> newton(problem, of_a_step, trace);
    auto path = follow(newton, part_of_forces, under_couples());
    path.result.record.insert(path.result.record.begin(), before.begin(), before.end());
    auto out = finished(path.result);
    out.load_steps = path.steps;
    return out;
  }

  /// The shape that the couples alone give the rod, marched along it.
  Frames under_couples() const {
    const auto m = loads_.couples_behind();
    Frames frames;
    frames.reserve(m.size());
    for (int j = 0; j < rod_.edges(); ++j) {
      const Rotation& before = j == 0 ? q0_ : frames[j - 1];
      frames.push_back(moved(before, turn_under(before, m[j], j)));
    }
    return frames;
  }

  Solution<Space> finished(Result<Frames>& result) const {
    Solution<Space> out;
    out.status = result.status;
    out.index = result.index;
    out.residual = result.residual;
    out.record = std::move(result.record);
    out.force = loads_.section_forces();
    out.load = loads_.force;
    out.load_moment = loads_.total_couple();
    out.curve.frames = std::move(result.state);
    place(out);
    weigh(out);
    return out;
  }

  /// Positions from the section forces, r_j = r_{j-1} + h R Γ, and the frame of the free end.
  void place(Solution<Space>& out) const {
    const int n = rod_.edges();
    auto& curve = out.curve;
    curve.start_frame = q0_;
    curve.positions.assign(1, r0_);
    for (int j = 0; j < n; ++j) {
      const Compliance<Space, Model> S(rod_.stretching[j]);
      const Point<Space> N = unrotate(curve.frames[j], out.force[j]);
      out.material_force.push_back(N);
      out.strains.Γ.push_back(axis<Space>() + S * N);
      curve.positions.push_back(curve.positions[j] +
                                rod_.grid.h(j) * rotate(curve.frames[j], out.strains.Γ[j]));
    }
    const Rotation& last = curve.frames[n - 1];
    curve.end_frame = moved(last, turn_under(last, loads_.end_couple, n));
  }

  /// Curvatures, moments and energies.
  void weigh(Solution<Space>& out) const {
    const int n = rod_.edges();
    for (int j = 0; j <= n; ++j) {
      const Spin<Space> u = turn(out.curve, j), &C = rod_.bending[j], &K0 = rod_.K0[j];
      const double Δs = rod_.grid.Δs(j);
      const Spin<Space> ΔK = u / Δs - K0, M = C.cwiseProduct(ΔK);
      out.strains.K.push_back(u / Δs);
      out.material_moment.push_back(M);
      out.moment.push_back(
          rotate_spin(out.curve.frame_before(j), transmitted_moment<Space>(u, C, K0, Δs)));
      out.bend_twist_energy += Δs * ΔK.dot(M) / 2;
    }
    for (int j = 0; j < n; ++j)
      out.stretch_shear_energy +=
          rod_.grid.h(j) / 2 * (out.strains.Γ[j] - axis<Space>()).dot(out.material_force[j]);
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
