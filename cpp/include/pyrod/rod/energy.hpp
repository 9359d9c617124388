// SPDX-License-Identifier: BSD-3-Clause
/// \file The energy of a rod, Linn (49) + (51), with gradient and Hessian in positions and frames.
///
/// This is the library's definition of a discrete rod, theory (3). Unknowns are numbered station by
/// station: r_0, q_{1/2}, r_1, q_{3/2}, …, r_n; frames move as R ← R exp(φ).
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rod/stretch_shear.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/space.hpp>

#include <Eigen/SparseCore>

#include <vector>

namespace pyrod {

/// Which ends are held by a frame of their own and so have a half cell in (49).
struct HeldEnds {
  bool start = true, end = false;
};

struct EnergyJet {
  double bend_twist = 0, stretch_shear = 0;
  Vector gradient;                      ///< in r and φ, station by station
  Eigen::SparseMatrix<double> hessian;  ///< symmetric, both triangles

  double energy() const { return bend_twist + stretch_shear; }
};

namespace detail {

/// Adds `block` and, off the diagonal, its transpose.
template <class Block>
void add_symmetric(std::vector<Eigen::Triplet<double>>& entries, int row, int column,
                   const Block& block) {
  for (int i = 0; i < block.rows(); ++i)
    for (int k = 0; k < block.cols(); ++k) {
      entries.emplace_back(row + i, column + k, block(i, k));
      if (row != column) entries.emplace_back(column + k, row + i, block(i, k));
    }
}

}  // namespace detail

template <class Space>
EnergyJet energy(const Rod<Space>& rod, const CosseratCurve<Space>& curve, HeldEnds held = {}) {
  constexpr int dim = Space::dim, spin = Space::spin, station = dim + spin;
  const int n = rod.edges(), size = station * n + dim;
  EnergyJet out;
  out.gradient = Vector::Zero(size);
  std::vector<Eigen::Triplet<double>> entries;

  for (int j = 0; j < n; ++j) {  // edges: r_j, q_{j+1/2}, r_{j+1} follow each other
    const auto jet =
        stretch_shear<Space>(curve.positions[j], curve.positions[j + 1], curve.frames[j],
                             storing_stiffness(rod.stretching[j]), rod.grid.h(j));
    out.stretch_shear += jet.energy;
    out.gradient.template segment<jet.size>(station * j) += jet.gradient;
    detail::add_symmetric(entries, station * j, station * j, jet.hessian);
  }
  for (int j = 0; j <= n; ++j) {  // vertices
    if ((j == 0 && !held.start) || (j == n && !held.end)) continue;
    const Spin<Space> u = turn(curve, j);
    const auto jet = bend_twist<Hessian::exact>(u, typename Space::Differential(u), rod.bending[j],
                                                rod.K0[j], rod.grid.Δs(j));
    out.bend_twist += jet.energy;
    const int a = station * (j - 1) + dim, b = station * j + dim;
    if (j > 0) {
      out.gradient.template segment<spin>(a) += jet.a;
      detail::add_symmetric(entries, a, a, jet.aa);
    }
    if (j < n) {
      out.gradient.template segment<spin>(b) += jet.b;
      detail::add_symmetric(entries, b, b, jet.bb);
    }
    if (j > 0 && j < n) detail::add_symmetric(entries, a, b, jet.ab);
  }
  out.hessian.resize(size, size);
  out.hessian.setFromTriplets(entries.begin(), entries.end());
  return out;
}

}  // namespace pyrod
