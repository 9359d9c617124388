// SPDX-License-Identifier: BSD-3-Clause
/// \file The scene of one rod clamped at its start: where solver and rod meet.
#pragma once

#include <pyrod/rod/moment_law.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/statics/equilibrium.hpp>

namespace pyrod {

/// All there is to know of an equilibrium. Spatial unless a name says material.
template <class Space>
struct Solution {
  CosseratCurve<Space> curve;
  Strains<Space> strains;
  std::vector<Point<Space>> force;           ///< n on the n edges
  std::vector<Point<Space>> material_force;  ///< N = Rᵀn
  std::vector<Spin<Space>> moment;           ///< m at the n + 1 vertices, in balance with the loads
  std::vector<Spin<Space>> material_moment;  ///< M = C (K − K0)
  double bend_twist_energy = 0, stretch_shear_energy = 0;

  Status status = Status::out_of_iterations;
  int index = -1;
  double residual = 0;
  std::vector<Iteration> record;

  double energy() const { return bend_twist_energy + stretch_shear_energy; }
};

/// A rod whose start is held in position and frame, under dead loads.
template <class Space, class Model>
class Cantilever {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;

  Cantilever(Rod<Space> rod, const Point<Space>& r0, const Rotation& q0, Loads<Space> loads)
      : rod_(std::move(rod)), r0_(r0), q0_(q0), loads_(std::move(loads)) {}

  Solution<Space> solve(const Options& options = {}, const Trace& trace = {}) const {
    auto [frames, first] = start();
    return solve_from(std::move(frames), options, trace, first);
  }

  /// From given frames of the edges, which are trusted to be near a solution.
  Solution<Space> solve(Frames frames, const Options& options = {}, const Trace& trace = {}) const {
    return solve_from(std::move(frames), options, trace, Curvature::exact);
  }

  /// The shape at rest; where the couples outweigh the forces, the shape that the couples alone give,
  /// which is a solution already if there are no forces. With it, the Hessian to begin with.
  std::pair<Frames, Curvature> start() const {
    const auto m = loads_.couples_behind();
    const auto n = loads_.section_forces();
    double couples = 0, levers = 0;
    for (const auto& mj : m) couples = std::max(couples, mj.norm());
    for (const auto& nj : n) levers = std::max(levers, nj.norm() * rod_.grid.length());
    if (couples <= levers) return {rod_.at_rest(r0_, q0_).frames, Curvature::convex};
    Frames frames;
    frames.reserve(n.size());
    for (int j = 0; j < rod_.edges(); ++j) {
      const Rotation& before = j == 0 ? q0_ : frames[j - 1];
      frames.push_back(moved(before, turn_under(before, m[j], j)));
    }
    return {std::move(frames), Curvature::exact};
  }

 private:
  Solution<Space> solve_from(Frames frames, const Options& options, const Trace& trace,
                             Curvature first) const {
    const Equilibrium<Space, Model> problem(rod_, q0_, loads_);
    Newton<Equilibrium<Space, Model>> newton(problem, options, trace);
    auto result = newton.solve(std::move(frames), first);

    Solution<Space> out;
    out.status = result.status;
    out.index = result.index;
    out.residual = result.residual;
    out.record = std::move(result.record);
    out.force = loads_.section_forces();
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
      out.moment.push_back(rotate_spin(out.curve.frame_before(j),
                                       transmitted_moment<Space>(u, C, K0, Δs)));
      out.bend_twist_energy += Δs * ΔK.dot(M) / 2;
    }
    for (int j = 0; j < n; ++j)
      out.stretch_shear_energy += rod_.grid.h(j) / 2 *
                                  (out.strains.Γ[j] - axis<Space>()).dot(out.material_force[j]);
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
