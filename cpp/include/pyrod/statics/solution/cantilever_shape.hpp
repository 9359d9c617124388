// SPDX-License-Identifier: BSD-3-Clause
/// \file All that follows from the frames of a rod whose section forces the loads tell.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/statics/solution/extremes.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/vertices.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// Told at every `stride`-th vertex, and at the centre between two such: an edge if the stride is
/// one, else a vertex, so that an other stride must be even. Sums go over all.
template <class Space>
class CantileverShape {
 public:
  using Rotation = typename Space::Rotation;

  CantileverShape(const Rod<Space>& rod, const Loads<Space>& loads, int stride = 1)
      : rod_(rod), loads_(loads), stride_(stride) {}

  RodSolution<Space> solution(const Point<Space>& r0, const Rotation& q0,
                              std::vector<Rotation> frames) const {
    RodSolution<Space> out;
    const int told = rod_.edges() / stride_;
    reserve(out, told);
    out.curve.start_frame = q0;
    out.curve.frames = std::move(frames);
    const auto force = loads_.section_forces();
    const Rotation& last = out.curve.frames.back();
    out.curve.end_frame = moved(last, turn_under(last, loads_.end_moment));
    Extremes<Space> extremes(rod_);
    weigh(out, extremes);
    place(out, r0, force, extremes);
    Vertices<Space>(rod_, loads_, {}, stride_).see(out, force);
    out.largest = extremes.largest(out, stride_);
    out.load = lumped(loads_.force, stride_);
    if (stride_ == 1)
      out.force = force;
    else
      out.curve.frames = centre_frames(out.curve);
    return out;
  }

 private:
  void reserve(RodSolution<Space>& out, int told) const {
    const auto n = std::size_t(told), m = n + 1;
    out.curve.positions.reserve(m), out.strains.K.reserve(m);
    out.moment.reserve(m), out.material_moment.reserve(m);
    out.material_force.reserve(n), out.strains.Γ.reserve(n), out.force.reserve(n);
  }

  /// With a stride the moments of the forces are part of `load_moment`, about the origin.
  bool tells(int vertex) const { return vertex % stride_ == 0; }
  bool is_centre(int vertex) const { return vertex % stride_ == stride_ / 2; }

  /// Positions from the section forces, r_j = r_{j-1} + h R Γ, and what edges say.
  void place(RodSolution<Space>& out, Point<Space> r, const std::vector<Point<Space>>& force,
             Extremes<Space>& extremes) const {
    out.load_moment = loads_.total_moment();
    out.curve.positions.push_back(r);
    if (stride_ > 1) out.load_moment += cross(r, loads_.force[0]);
    Point<Space> Γ_before = axis<Space>(), n_before = Point<Space>::Zero();
    for (int j = 0; j < rod_.edges(); ++j) {
      const Mat<Space::dim> R = matrix(out.curve.frames[j]);
      const Point<Space> N = R.transpose() * force[j],
                         strain = compliance(rod_.stretching[j]).cwiseProduct(N),
                         Γ = axis<Space>() + strain;
      out.stretch_shear_energy += rod_.grid.h(j) / 2 * strain.dot(N);
      if (stride_ == 1) {
        out.material_force.push_back(N);
        out.strains.Γ.push_back(Γ);
      } else if (is_centre(j)) {
        out.force.push_back((n_before + force[j]) / 2);
        out.strains.Γ.push_back((Γ_before + Γ) / 2);
      }
      extremes.add_force(force[j] + loads_.share(j, out.curve.frames[j]));
      r += rod_.grid.h(j) * (R * Γ);
      if (tells(j + 1)) out.curve.positions.push_back(r);
      if (stride_ > 1) out.load_moment += cross(r, loads_.force[j + 1]);
      Γ_before = Γ, n_before = force[j];
    }
    extremes.add_force(n_before);  // replaced by what is told at the end
  }

  /// Curvatures, moments and energies.
  void weigh(RodSolution<Space>& out, Extremes<Space>& extremes) const {
    for (int j = 0; j <= rod_.edges(); ++j) {
      const Spin<Space> u = turn(out.curve, j), &C = rod_.bending[j], &K0 = rod_.K0[j];
      const double Δs = rod_.grid.Δs(j);
      const Spin<Space> ΔK = u / Δs - K0, M = C.cwiseProduct(ΔK);
      out.bend_twist_energy += Δs * ΔK.dot(M) / 2;
      extremes.add_cell(u, M);
      if (!tells(j)) continue;
      out.strains.K.push_back(u / Δs);
      out.material_moment.push_back(M);
      out.moment.push_back(
          rotate_spin(out.curve.frame_before(j), transmitted_moment<Space>(u, C, K0, Δs)));
    }
  }

  std::vector<Rotation> centre_frames(const CosseratCurve<Space>& curve) const {
    std::vector<Rotation> out;
    out.reserve(std::size_t(rod_.edges() / stride_));
    for (int j = stride_ / 2; j < rod_.edges(); j += stride_)
      out.push_back(vertex_frame(rod_.grid, curve, j));
    return out;
  }

  /// The turn of the last half cell under a spatial moment, seen from the frame before it.
  Spin<Space> turn_under(const Rotation& before, const Spin<Space>& m) const {
    const int n = rod_.edges();
    return turn_under_moment<Space>(rotate_spin(before.conjugate(), m), rod_.bending[n], rod_.K0[n],
                                    rod_.grid.Δs(n));
  }

  const Rod<Space>& rod_;
  const Loads<Space>& loads_;
  int stride_;
};

}  // namespace pyrod
