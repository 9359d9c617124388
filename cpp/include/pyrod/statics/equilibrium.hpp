// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibrium of a rod clamped at its start and free at its end, as a problem for the
/// solver.
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

  /// Replaces the section forces; the couples stay.
  void set_forces(std::vector<Point<Space>> n) { force_ = std::move(n); }

  Storage linearisation() const {
    const int n = rod_.edges();
    return {0, 0, Vector::Zero(spin * n), BlockTridiagonal<spin>(n)};
  }

  void linearise(const State& q, Curvature curvature, Storage& out) const {
    if (curvature == Curvature::exact)
      linearise<Curvature::exact>(q, out);
    else
      linearise<Curvature::convex>(q, out);
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
  static constexpr int batch = 32;

  /// The turns at the vertices of a batch, and the logarithm's differentials there.
  struct Turns {
    std::array<Spin<Space>, batch> u;
    std::array<typename Space::Differential, batch> dlog;
  };

  /// Batch by batch in short passes: one long pass would be a single chain of dependent operations,
  /// and twice as slow. Flattened, as g++ leaves Eigen's calls as calls when it meets many models.
  template <Curvature kind>
  [[gnu::flatten]] void linearise(const State& q, Storage& out) const {
    const int n = rod_.edges();
    Turns turns;
    out.energy = out.magnitude = 0;
    for (int first = 0; first < n; first += batch) {
      const int end = std::min(first + batch, n);
      measure(q, first, end, turns);
      for (int j = first; j < end; ++j)
        add_vertex(j,
                   bend_twist<kind>(turns.u[j - first], turns.dlog[j - first], rod_.bending[j],
                                    rod_.K0[j], rod_.grid.Δs(j)),
                   out);
      for (int j = first; j < end; ++j)
        add_edge(
            j,
            section_force_term<kind, Space, Model>(q[j], force_[j], compliance_[j], rod_.grid.h(j)),
            out);
    }
    if (!couple_.empty()) add_couples(q, out);
  }

  /// The turns at the vertices first … end − 1.
  void measure(const State& q, int first, int end, Turns& turns) const {
    for (int j = first; j < end; ++j)
      turns.u[j - first] = log((j == 0 ? clamp_ : q[j - 1]).conjugate() * q[j]);
    for (int i = 0; i < end - first; ++i) turns.dlog[i] = typename Space::Differential(turns.u[i]);
  }

  /// Vertex j: the first to write what belongs to the edge behind it, the last to add to the edge
  /// before it. The clamp before vertex 0 does not turn.
  static void add_vertex(int j, const TurnJet<Space>& cell, Storage& out) {
    out.energy += cell.energy;
    out.magnitude += cell.energy;
    for (int i = 0; i < spin; ++i) out.gradient[spin * j + i] = cell.b[i];
    out.hessian.set_column(j, cell.ab, cell.bb);
    if (j == 0) return;
    for (int i = 0; i < spin; ++i) out.gradient[spin * (j - 1) + i] += cell.a[i];
    out.hessian.add_to_diagonal(j - 1, cell.aa);
  }

  /// Edge j, between the vertices j and j + 1.
  static void add_edge(int j, const EdgeJet<Space>& edge, Storage& out) {
    out.energy += edge.energy;
    out.magnitude += std::abs(edge.energy);
    for (int i = 0; i < spin; ++i) out.gradient[spin * j + i] += edge.gradient[i];
    out.hessian.add_to_diagonal(j, edge.hessian);
  }

  void add_couples(const State& q, Storage& out) const {
    for (int j = 0; j < rod_.edges(); ++j) {
      out.gradient.template segment<spin>(spin * j) -= material_couple(q, j);
      if constexpr (spin == 1) out.energy -= couple_[j][0] * q[j].radians;
    }
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
