// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibrium of a rod clamped at its start and free at its end, as a problem for the solver.
///
/// The loads give the section force on every edge, so the unknowns are the frames of the edges and
/// nothing else: one number per edge in the plane and three in space, for all three models. What is
/// minimised is W_bt − Σ h (b·e3 + ½ b·S b), b = Rᵀn (docs/theory.md, "Unknowns").
#pragma once

#include <pyrod/rod/bend_twist.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/statics/loads.hpp>
#include <pyrod/statics/section_force.hpp>

#include <algorithm>
#include <array>

namespace pyrod {

template <class Space, class Model>
class Equilibrium {
 public:
  using Rotation = typename Space::Rotation;
  using State = std::vector<Rotation>;
  static constexpr int spin = Space::spin;
  using Storage = Linearisation<BlockTridiagonal<spin>>;

  Equilibrium(const Rod<Space>& rod, const Rotation& clamp, const Loads<Space>& loads)
      : rod_(rod), clamp_(clamp), force_(loads.section_forces()) {
    compliance_.reserve(rod.stretching.size());
    for (const auto& C : rod.stretching) compliance_.emplace_back(C);
    if (loads.has_couples()) {
      couple_ = loads.couple;
      couple_.back() += loads.end_couple;
    }
  }

  Storage linearisation() const {
    const int n = rod_.edges();
    return {0, 0, Vector::Zero(spin * n), BlockTridiagonal<spin>(n)};
  }

  void linearise(const State& q, Curvature curvature, Storage& out) const {
    if (curvature == Curvature::exact) linearise<Curvature::exact>(q, out);
    else linearise<Curvature::convex>(q, out);
  }

  void move(const State& q, const Vector& δ, State& out) const {
    out.resize(q.size());
    for (std::size_t j = 0; j < q.size(); ++j)
      out[j] = moved(q[j], Spin<Space>(δ.segment<spin>(spin * j)));
  }

  /// A couple fixed in space has a potential in the plane only.
  bool conservative() const { return spin == 1 || couple_.empty(); }

  /// −½ [Rᵀm] on every edge with a couple m: with it the tangent is that of the residual in the
  /// coordinates exp(φ), and Newton's method is quadratic.
  void multiply_skew(const State& q, const Vector& v, Vector& out) const {
    out.setZero(v.size());
    for (std::size_t j = 0; j < couple_.size(); ++j)
      out.segment<spin>(spin * j) =
          spin_skew(Spin<Space>(v.segment<spin>(spin * j))) * material_couple(q, j) / 2;
  }

 private:
  /// Vertices are worked on in batches, each in short passes: one long pass per vertex would be a
  /// single chain of dependent operations, and twice as slow.
  static constexpr int batch = 32;
  using Cells = std::array<TurnJet<Space>, batch>;

  template <Curvature kind>
  void linearise(const State& q, Storage& out) const {
    const int n = rod_.edges();
    Cells cells;
    Pending last;
    out.energy = out.magnitude = 0;
    for (int first = 0; first < n; first += batch) {
      const int count = std::min(batch, n - first);
      bend<kind>(q, first, count, cells);
      for (int i = 0; i < count; ++i) add_station<kind>(q, first + i, cells[i], last, out);
    }
    flush(n - 1, Spin<Space>::Zero(), Mat<spin>::Zero(), last, out);
  }

  /// Bending and twisting at the vertices first … first + count − 1.
  template <Curvature kind>
  void bend(const State& q, int first, int count, Cells& cells) const {
    std::array<Spin<Space>, batch> u;
    std::array<typename Space::Differential, batch> dlog;
    for (int i = 0; i < count; ++i) {
      const int j = first + i;
      u[i] = log((j == 0 ? clamp_ : q[j - 1]).conjugate() * q[j]);
    }
    for (int i = 0; i < count; ++i) dlog[i] = typename Space::Differential(u[i]);
    for (int i = 0; i < count; ++i) {
      const int j = first + i;
      cells[i] = bend_twist<kind>(u[i], dlog[i], rod_.bending[j], rod_.K0[j], rod_.grid.Δs(j));
    }
  }

  /// Blocks of an edge that still lack what the vertex behind it adds.
  struct Pending {
    Spin<Space> gradient;
    Mat<spin> above, diagonal;
  };

  /// Vertex j and the edge behind it.
  template <Curvature kind>
  void add_station(const State& q, int j, const TurnJet<Space>& cell, Pending& last,
                   Storage& out) const {
    if (j > 0) flush(j - 1, cell.a, cell.aa, last, out);
    const auto edge =
        section_force_term<kind, Space, Model>(q[j], force_[j], compliance_[j], rod_.grid.h(j));
    out.energy += cell.energy + edge.energy;
    out.magnitude += cell.energy + std::abs(edge.energy);
    last = {cell.b + edge.gradient, cell.ab, cell.bb + edge.hessian};
    if (couple_.empty()) return;
    last.gradient -= material_couple(q, j);
    if constexpr (spin == 1) out.energy -= couple_[j][0] * q[j].radians;
  }

  void flush(int edge, const Spin<Space>& gradient, const Mat<spin>& diagonal, const Pending& last,
             Storage& out) const {
    out.gradient.template segment<spin>(spin * edge) = last.gradient + gradient;
    out.hessian.set_column(edge, last.above, last.diagonal + diagonal);
  }

  Spin<Space> material_couple(const State& q, std::size_t j) const {
    return rotate_spin(q[j].conjugate(), couple_[j]);
  }

  const Rod<Space>& rod_;
  Rotation clamp_;
  std::vector<Point<Space>> force_;
  std::vector<Spin<Space>> couple_;  ///< empty if no couple acts
  std::vector<Compliance<Space, Model>> compliance_;
};

}  // namespace pyrod
