// SPDX-License-Identifier: BSD-3-Clause
/// \file The rows of the spans of a network: turning inside a span, the section force in it, and
/// how far it reaches.
///
/// They are written, not added to, as they are nearly all of the matrix; so they come first.
#pragma once

#include <pyrod/statics/network_cells.hpp>
#include <pyrod/statics/section_force.hpp>

#include <array>

namespace pyrod {

template <class Space>
class NetworkSpans : public NetworkCells<Space> {
 public:
  using Base = NetworkCells<Space>;
  using Base::Base;
  using Base::dim, Base::spin, Base::first_row;
  using typename Base::Acting, typename Base::Rotation, typename Base::State;
  using typename Base::Storage;

 protected:
  using Base::layout_, Base::net_, Base::compliance_, Base::first_;

  /// Writes the rows of span p.
  template <Curvature kind>
  void set_span(const State& x, const Acting& now, int p, Storage& out) const {
    const auto& span = layout_.spans()[p];
    const Part part{&span,
                    &net_.rods[span.rod],
                    now.vertices[span.rod].data(),
                    layout_.edge(span.rod, 0),
                    first_row(layout_.edge(span.rod, span.first)),
                    layout_.unit_force(p)};
    clear_ends(part, out);
    Batch batch;
    batch.n[0] = x.forces[p] + now.known[p];
    Reach sum;
    for (int first = span.first; first < span.last; first += capacity) {
      const int end = std::min(first + capacity, span.last);
      fill<kind>(x, part, first, end, batch, out);
      if (span.block >= 0) reach(x, part, first, end, batch, sum, out);
      batch.n[0] = batch.n[end - first];
    }
    if (span.block >= 0) close(x, p, sum, out);
  }

 private:
  static constexpr int capacity = 32;  ///< of a batch: short passes, as in equilibrium.hpp

  /// A span, with what is needed of it at every edge j of its rod.
  struct Part {
    const Span<Space>* span;
    const Rod<Space>* rod;
    const Point<Space>* load;  ///< on the vertices of the rod
    int edge, row;             ///< number of edge 0; first row of the span
    double unit;               ///< of its force
    int row_of(int j) const { return row + spin * (j - span->first); }
  };

  /// Of the edges of a batch: section forces, with the one behind the last; turns before them.
  struct Batch {
    std::array<Point<Space>, capacity + 1> n;
    std::array<Spin<Space>, capacity> u;
    std::array<typename Space::Differential, capacity> dlog;
  };

  /// Σ h R Γ, what is left of it without strains by itself, so that small strains are not rounded
  /// to the length; and Σ h R S Rᵀ, of which the upper triangle.
  struct Reach {
    Point<Space> rigid = Point<Space>::Zero(), strained = Point<Space>::Zero();
    Mat<dim> give = Mat<dim>::Zero();
  };

  /// Only the first and the last frame of a span can be coupled to more than the frame before.
  static void clear_ends(const Part& part, Storage& out) {
    for (const int j : {part.span->first, part.span->last - 1})
      out.hessian.set_zero(part.row_of(j), part.row_of(j + 1));
  }

  template <Curvature kind>
  [[gnu::flatten]] void fill(const State& x, const Part& part, int first, int end, Batch& batch,
                             Storage& out) const {
    const auto& rod = *part.rod;
    const Rotation* frames = x.frames.data() + part.edge;
    const int inner = std::max(first, part.span->first + 1);  // vertices from here have a cell
    for (int j = first; j < end; ++j)
      batch.n[j + 1 - first] = batch.n[j - first] - part.load[j + 1];
    for (int j = inner; j < end; ++j)
      batch.u[j - first] = log(frames[j - 1].conjugate() * frames[j]);
    for (int j = inner; j < end; ++j)
      batch.dlog[j - first] = typename Space::Differential(batch.u[j - first]);
    for (int j = first; j < end; ++j)
      set_edge(part.row_of(j),
               edge_term<kind, Space, double>(frames[j], batch.n[j - first],
                                              compliance_[part.edge + j], rod.grid.h(j)),
               out);
    for (int j = inner; j < end; ++j)
      add_vertex(part.row_of(j),
                 bend_twist<kind>(batch.u[j - first], batch.dlog[j - first], rod.bending[j],
                                  rod.K0[j], rod.grid.Δs(j)),
                 out);
  }

  /// The first to write what belongs to the frame in this row alone.
  static void set_edge(int row, const EdgeJet<Space>& edge, Storage& out) {
    Base::add_energy(edge.energy, out);
    out.gradient.template segment<spin>(row) = edge.gradient;
    const auto to = out.hessian.columns(row);
    for (int k = 0; k < spin; ++k)
      for (int i = 0; i <= k; ++i) to[k][to.above + i] = edge.hessian(i, k);
  }

  /// The cell between the frame in this row and the one before it.
  static void add_vertex(int row, const TurnJet<Space>& cell, Storage& out) {
    Base::add_energy(cell.energy, out);
    for (int i = 0; i < spin; ++i) out.gradient[row - spin + i] += cell.a[i];
    for (int i = 0; i < spin; ++i) out.gradient[row + i] += cell.b[i];
    const auto before = out.hessian.columns(row - spin), to = out.hessian.columns(row);
    for (int k = 0; k < spin; ++k) {
      double *mixed = to[k] + to.above - spin, *own = to[k] + to.above;
      for (int i = 0; i < spin; ++i) mixed[i] = cell.ab(i, k);
      for (int i = 0; i <= k; ++i) own[i] += cell.bb(i, k);
      for (int i = 0; i <= k; ++i) before[k][before.above + i] += cell.aa(i, k);
    }
  }

  void reach(const State& x, const Part& part, int first, int end, const Batch& batch, Reach& sum,
             Storage& out) const {
    switch (part.span->open.cols()) {
      case 1:
        return reach<1>(x, part, first, end, batch, sum, out);
      case dim:
        return reach<dim>(x, part, first, end, batch, sum, out);
      default:
        return reach<2>(x, part, first, end, batch, sum, out);
    }
  }

  /// How the end of the span moves with the frames, ∂(h R Γ)/∂φ = h ([b] S − [Γ]) Rᵀ, and with the
  /// force.
  template <int open>
  [[gnu::flatten]] void reach(const State& x, const Part& part, int first, int end,
                              const Batch& batch, Reach& sum, Storage& out) const {
    const auto columns = out.hessian.columns(first_[part.span->block]);
    const Eigen::Matrix<double, dim, open> C = part.span->open;
    const double unit = part.unit;
    std::array<double*, open> to;
    for (int k = 0; k < open; ++k) to[k] = columns[k] + spin * (first - part.span->first);
    for (int j = first; j < end; ++j) {
      const double h = part.rod->grid.h(j);
      const Mat<dim> R = matrix(x.frames[part.edge + j]);
      const Point<Space> S = compliance_[part.edge + j], b = R.transpose() * batch.n[j - first],
                         Γ = axis<Space>() + S.cwiseProduct(b);
      const Point<Space> hS = h * S;
      sum.rigid += h * R.col(dim - 1);
      for (int k = 0; k < dim; ++k) {
        const Point<Space> r = hS[k] * R.col(k);
        sum.strained += b[k] * r;
        for (int l = 0; l < dim; ++l)
          for (int i = 0; i <= l; ++i) sum.give(i, l) += r[i] * R(l, k);
      }
      for (int k = 0; k < open; ++k) {
        Point<Space> c;  // the direction, in the frame; all of them are the axes
        if constexpr (open == dim)
          c = h * unit * R.row(k);
        else
          c = h * R.transpose() * C.col(k);
        for (const double B : lever(c, b, S, Γ)) *to[k]++ = B;
      }
    }
  }

  /// c × Γ + b × S c.
  static Vec3 lever(const Vec3& c, const Vec3& b, const Vec3& S, const Vec3& Γ) {
    Vec3 out;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      out[i] = c[j] * (Γ[k] - S[j] * b[k]) - c[k] * (Γ[j] - S[k] * b[j]);
    }
    return out;
  }
  static Vec1 lever(const Vec2& c, const Vec2& b, const Vec2& S, const Vec2& Γ) {
    return Vec1(c[1] * (Γ[0] - S[1] * b[0]) - c[0] * (Γ[1] - S[0] * b[1]));
  }

  /// The rows of the force: the span reaches from node to node.
  void close(const State& x, int p, const Reach& reach, Storage& out) const {
    const auto& span = layout_.spans()[p];
    const Point<Space> apart = x.positions[span.end] - x.positions[span.start];
    const int row = first_[span.block], open = int(span.open.cols());
    out.gradient.segment(row, open) =
        span.open.transpose() * (apart - reach.rigid - reach.strained);
    const Mat<dim> give = reach.give.template selfadjointView<Eigen::Upper>();
    const auto to = out.hessian.columns(row);
    for (int k = 0; k < open; ++k)
      for (int i = 0; i <= k; ++i)
        to[k][to.above + i] = -span.open.col(i).dot(give * span.open.col(k));
    out.energy += x.forces[p].dot(apart);
  }
};

}  // namespace pyrod
