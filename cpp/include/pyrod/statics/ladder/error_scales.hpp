// SPDX-License-Identifier: BSD-3-Clause
/// \file What errors are relative to, and what rounding allows no less than.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/statics/ladder/rung.hpp>
#include <pyrod/statics/solution/quantity.hpp>
#include <pyrod/statics/solution/rounding.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace pyrod {

/// Errors of positions are relative to the longest rod, of frames in radians; others to the largest
/// value of their kind, unless all are nothing beside EI/L², EI/L or 1/L.
struct ErrorScales {
  std::array<double, quantities> size{};
  std::array<double, quantities> least{};  ///< relative errors that rounding leaves
  double noise = 0;                        ///< the same of numbers that nothing magnifies

  /// `length`, `force`: units of the scene.
  ErrorScales(const Rung& rung, double length, double force, const Rounding& rounding,
              double least_error)
      : noise(least_error) {
    measure(rung, length, force);
    least.fill(noise);
    allow(Quantity::curvatures, rounding.moment / (force * length * length));
    for (const auto what : {Quantity::forces, Quantity::reactions, Quantity::edge_forces})
      allow(what, rounding.force);
    for (const auto what : {Quantity::moments, Quantity::reaction_moments})
      allow(what, rounding.moment);
    allow(Quantity::energy, length * (rounding.force * stretch_ + rounding.moment * bend_));
  }

  /// Scales so large that rounding is the noise of all quantities alike.
  std::vector<double> levelled(int first, int count) const {
    std::vector<double> out;
    for (int q = first; q < first + count; ++q)
      out.push_back(size[std::size_t(q)] * least[std::size_t(q)] / noise);
    return out;
  }

  /// Errors found with levelled scales, relative to the sizes.
  void restore(std::vector<double>& errors, int first) const {
    for (std::size_t i = 0; i < errors.size(); ++i)
      errors[i] *= least[std::size_t(first) + i] / noise;
  }

  /// The largest error, but for those that are what rounding makes of small gaps: no grid is
  /// better.
  double judged(const std::vector<double>& errors) const {
    double out = noise;
    for (std::size_t q = 0; q < errors.size(); ++q)
      if (!(least[q] > noise && errors[q] <= 3 * least[q])) out = std::max(out, errors[q]);
    return out;
  }

 private:
  void measure(const Rung& rung, double length, double force) {
    const auto look = [&](Quantity what, const double* numbers, int width) {
      if (what == Quantity::unjudged) return;
      auto& s = at(what);
      s = std::max(s, Eigen::Map<const Vector>(numbers, width).norm());
    };
    visit_vertices(rung.rods, rung.nodes, rung.tendons, look);
    visit_edges(rung.rods, look);
    for (const auto& rod : rung.rods) {
      for (const auto& Γ : rod.strains.Γ) stretch_ = std::max(stretch_, (Γ - Vec3::UnitZ()).norm());
      for (const auto& K : rod.strains.K) bend_ = std::max(bend_, K.norm());
    }
    const auto at_least = [&](Quantity what, Quantity like, double unit) {
      const double found = std::max(at(what), at(like));
      at(what) = found > 1e-8 * unit ? found : unit;
    };
    at(Quantity::positions) = length;
    at(Quantity::frames) = at(Quantity::edge_frames) = 0.5;  // a turn is twice its quaternion
    at(Quantity::strains) = 1;
    at_least(Quantity::curvatures, Quantity::curvatures, 1 / length);
    for (const auto what : {Quantity::reactions, Quantity::edge_forces, Quantity::forces})
      at_least(what, Quantity::forces, force);
    for (const auto what : {Quantity::reaction_moments, Quantity::moments})
      at_least(what, Quantity::moments, force * length);
    const double energy = rung.energy();
    at(Quantity::energy) = energy > 1e-16 * force * length ? energy : force * length;
  }

  void allow(Quantity what, double error) {
    auto& l = least[std::size_t(what)];
    l = std::max(l, error / at(what));
  }
  double& at(Quantity what) { return size[std::size_t(what)]; }

  double stretch_ = 0, bend_ = 0;  ///< the largest strains
};

}  // namespace pyrod
