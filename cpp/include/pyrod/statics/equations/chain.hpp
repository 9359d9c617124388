// SPDX-License-Identifier: BSD-3-Clause
/// \file Edges in a row under known section forces, evaluated several at a time: a clamped rod, or
/// a span of a network.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/core/hessian.hpp>
#include <pyrod/core/pack.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/frames.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/sparse/chain_columns.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>
#include <pyrod/statics/equations/section_force.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace pyrod {

/// Some edges in a row, the first of them with that number among all.
template <class Space>
struct Chain {
  using Rotation = typename Space::Rotation;

  int edges, first;
  const EdgeColumns<Space>& columns;
  const Columns<Space::dim>& known;  ///< section forces of all edges, but for what is
  Point<Space> added;                ///< added to them in each edge of the chain
  Rotation before;                   ///< the frame before vertex 0, which does not turn
  const Rotation* frames;            ///< of its edges

  /// Section forces in edges number j, j + 1, …
  template <class Real>
  Point<Space, Real> force(int j) const {
    Point<Space, Real> n = known.template at<Real>(first + j);
    for (int i = 0; i < Space::dim; ++i) n[i] += Real(added[i]);
    return n;
  }

  /// Frames number j, j + 1, …; behind the last the last.
  template <class Real>
  typename Space::template RotationOf<Real> frames_at(int j) const {
    constexpr int W = width_of<Real>;
    if (j >= 0 && j + W <= edges) return load_frames<Real>(frames + j);
    std::array<Rotation, W> near;
    for (int i = 0; i < W; ++i) {
      const int k = std::min(j + i, edges - 1);
      near[i] = k < 0 ? before : frames[k];
    }
    return load_frames<Real>(near.data());
  }
};

/// Where its energy, gradient and Hessian go.
template <class Space>
struct ChainRows {
  using Block = Mat<Space::spin>;
  double* gradient;
  ChainColumns<Space::spin> hessian;
  double energy = 0, magnitude = 0;
  /// What the first cell does to the frame before it, if that turns as well: gradient and Hessian
  /// of its turn, and the coupling of this with the chain's first frame.
  Spin<Space> start = Spin<Space>::Zero();
  Block start_twice = Block::Zero(), start_first = Block::Zero();
};

/// L of theory (8), its gradient and Hessian for a chain, in one pass from its end to its start:
/// the vertex at the end of an edge adds to the edge's row, so that a row is complete, and written
/// once, when the vertex at its start is reached.
template <class Space, Hessian kind>
class ChainLinearisation {
 public:
  ChainLinearisation(const Chain<Space>& chain, ChainRows<Space>& out) : chain_(chain), out_(out) {}

  template <int W>
  void run() const {
    using Real = Pack<W>;
    const int n = chain_.edges;
    const auto& columns = chain_.columns;
    Sum<W> energy, magnitude;
    Row<Real> next{Spin<Space, Real>::Zero(), Row<Real>::Block::Zero()};
    for (int first = (n - 1) / W * W; first >= 0; first -= W) {
      const int count = std::min(W, n - first);
      const int number = chain_.first + first;
      const auto before = chain_.template frames_at<Real>(first - 1),
                 here = chain_.template frames_at<Real>(first);
      const Spin<Space, Real> u = log(before.conjugate() * here);
      auto cell = bend_twist<kind>(u, typename Space::template DifferentialOf<Real>(u),
                                   columns.stiffness.template at<Real>(number),
                                   columns.rest.template at<Real>(number));
      auto edge = edge_term<kind, Space, Real>(here, chain_.template force<Real>(first),
                                               columns.compliance.template at<Real>(number),
                                               columns.lengths.template at<Real>(number)[0]);
      if (count < W) clear(cell, edge, count);
      energy.add(first, cell.energy + edge.energy);
      magnitude.add(first, cell.energy + abs(edge.energy));
      const Row<Real> row{cell.b + edge.gradient + shifted(cell.a, next.gradient),
                          cell.bb + edge.hessian + shifted(cell.aa, next.hessian)};
      next = {cell.a, cell.aa};
      out_.hessian.set(first, count, cell.ab, row.hessian);
      store(row.gradient, first, count);
      if (first == 0) keep_start(cell);
    }
    out_.energy = energy.total();
    out_.magnitude = magnitude.total();
  }

 private:
  static constexpr int spin = Space::spin;

  template <class Real>
  struct Row {
    using Block = Mat<spin, spin, Real>;
    Spin<Space, Real> gradient;
    Block hessian;
  };

  /// Lanes beyond the last edge bring nothing.
  template <class Real>
  static void clear(TurnJet<Space, Real>& cell, EdgeJet<Space, Real>& edge, int count) {
    cell.energy = leading(cell.energy, count);
    edge.energy = leading(edge.energy, count);
    for (auto& a : cell.a.reshaped()) a = leading(a, count);
    for (auto& aa : cell.aa.reshaped()) aa = leading(aa, count);
  }

  template <class Values>
  static Values shifted(const Values& a, const Values& next) {
    Values out;
    for (Eigen::Index i = 0; i < a.size(); ++i)
      out.data()[i] = pyrod::shifted(a.data()[i], next.data()[i]);
    return out;
  }

  template <class Real>
  void keep_start(const TurnJet<Space, Real>& cell) const {
    for (int k = 0; k < spin; ++k) {
      out_.start[k] = cell.a[k].values[0];
      for (int i = 0; i < spin; ++i) {
        out_.start_twice(i, k) = cell.aa(i, k).values[0];
        out_.start_first(i, k) = cell.ab(i, k).values[0];
      }
    }
  }

  template <class Real>
  void store(const Spin<Space, Real>& g, int first, int count) const {
    double* to = out_.gradient + std::ptrdiff_t(spin) * first;
    for (int lane = 0; lane < count; ++lane)
      for (int i = 0; i < spin; ++i) *to++ = g[i].values[lane];
  }

  const Chain<Space>& chain_;
  ChainRows<Space>& out_;
};

}  // namespace pyrod
