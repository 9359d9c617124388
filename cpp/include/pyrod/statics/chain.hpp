// SPDX-License-Identifier: BSD-3-Clause
/// \file A clamped rod under known section forces, evaluated several edges at a time.
#pragma once

#include <pyrod/core/columns.hpp>
#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rotation/frames.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/statics/section_force.hpp>

namespace pyrod {

/// What the evaluation of n edges, each with the vertex at its start, needs to know of the rod. All
/// models are one: a strain that is forbidden has the compliance 0.
template <class Space>
struct Chain {
  int edges;
  typename Space::Rotation clamp;        ///< the frame before vertex 0, which does not turn
  Columns<Space::spin> stiffness, rest;  ///< C/Δs and Δs K0 at the vertices
  Columns<1> edge_lengths;
  Columns<Space::dim> force, compliance;
};

/// Energy, gradient and Hessian of a chain, in one pass from its end to its start: the vertex at
/// the end of an edge adds to the edge's row, so that a row is complete, and written once, when the
/// vertex at its start is reached.
template <class Space, Curvature kind>
class ChainLinearisation {
 public:
  using Rotation = typename Space::Rotation;
  using Storage = Linearisation<BlockTridiagonal<Space::spin>>;

  ChainLinearisation(const Chain<Space>& chain, const Rotation* frames, Storage& out)
      : chain_(chain), frames_(frames), out_(out) {}

  template <int W>
  void run() const {
    using Real = Pack<W>;
    const int n = chain_.edges;
    Sum<W> energy, magnitude;
    Row<Real> next{Spin<Space, Real>::Zero(), Row<Real>::Block::Zero()};
    for (int first = (n - 1) / W * W; first >= 0; first -= W) {
      const int count = std::min(W, n - first);
      const auto before = frames<Real>(first - 1), here = frames<Real>(first);
      const Spin<Space, Real> u = log(before.conjugate() * here);
      auto cell = bend_twist<kind>(u, typename Space::template DifferentialOf<Real>(u),
                                   chain_.stiffness.template at<Real>(first),
                                   chain_.rest.template at<Real>(first));
      auto edge = edge_term<kind, Space, Real>(here, chain_.force.template at<Real>(first),
                                               chain_.compliance.template at<Real>(first),
                                               chain_.edge_lengths.template at<Real>(first)[0]);
      if (count < W) clear(cell, edge, count);
      energy.add(first, cell.energy + edge.energy);
      magnitude.add(first, cell.energy + abs(edge.energy));
      const Row<Real> row{cell.b + edge.gradient + shifted(cell.a, next.gradient),
                          cell.bb + edge.hessian + shifted(cell.aa, next.hessian)};
      next = {cell.a, cell.aa};
      out_.hessian.set_columns(first, count, cell.ab, row.hessian);
      store(row.gradient, first, count);
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

  /// Frames number first, first + 1, …; before the first the clamp, behind the last the last.
  template <class Real>
  typename Space::template RotationOf<Real> frames(int first) const {
    constexpr int W = width_of<Real>;
    if (first >= 0 && first + W <= chain_.edges) return load_frames<Real>(frames_ + first);
    std::array<Rotation, W> near;
    for (int i = 0; i < W; ++i) {
      const int j = std::min(first + i, chain_.edges - 1);
      near[i] = j < 0 ? chain_.clamp : frames_[j];
    }
    return load_frames<Real>(near.data());
  }

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
  void store(const Spin<Space, Real>& g, int first, int count) const {
    double* to = out_.gradient.data() + std::ptrdiff_t(spin) * first;
    for (int lane = 0; lane < count; ++lane)
      for (int i = 0; i < spin; ++i) *to++ = g[i].values[lane];
  }

  const Chain<Space>& chain_;
  const Rotation* frames_;
  Storage& out_;
};

}  // namespace pyrod
