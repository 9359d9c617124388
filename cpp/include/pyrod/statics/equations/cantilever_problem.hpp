// SPDX-License-Identifier: BSD-3-Clause
/// \file The equilibrium of a rod clamped at its start and free at its end as a problem for the
/// solver.
///
/// The loads give the section force on every edge, so the unknowns are the frames of the edges and
/// nothing else: one number per edge in the plane and three in space, for all models. What is
/// minimised is W_bt − Σ h (b·e3 + ½ b·S b), b = Rᵀn (docs/theory.md, "Unknowns").
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/frames.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/symmetric.hpp>
#include <pyrod/statics/equations/chain.hpp>
#include <pyrod/statics/equations/edge_columns.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

template <class Space>
class CantileverProblem {
 public:
  using Rotation = typename Space::Rotation;
  using State = std::vector<Rotation>;
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Storage = Linearisation<BlockTridiagonal<spin>>;

  CantileverProblem(const Rod<Space>& rod, const Rotation& clamp, const Loads<Space>& loads)
      : clamp_(clamp), columns_(edge_columns(rod)), edges_(rod.edges()) {
    set_forces(loads.section_forces());
    if (loads.has_moments()) {
      moment_ = loads.moment;
      moment_.back() += loads.end_moment;
    }
  }

  /// Replaces the section forces; the moments stay.
  void set_forces(const std::vector<Point<Space>>& n) {
    forces_.assign(edges_, [&](int j) { return n[j]; });
  }

  bool fits(const Storage& made) const { return made.gradient.size() == spin * edges_; }

  Storage linearisation() const {
    return {0, 0, Vector::Zero(spin * edges_), BlockTridiagonal<spin>(edges_)};
  }

  void linearise(const State& q, Hessian kind, Storage& out) const {
    if (kind == Hessian::exact)
      linearise<Hessian::exact>(q, out);
    else
      linearise<Hessian::convex>(q, out);
  }

  void move(const State& q, const Vector& δ, State& out) const {
    out.resize(q.size());
    dispatch(MoveFrames<Space>{int(q.size()), q.data(), δ.data(), out.data()});
  }

  /// A moment fixed in space has a potential in the plane only.
  bool conservative() const { return spin == 1 || moment_.empty(); }

  /// −½ [Rᵀm] on every edge with a moment m: with it the tangent is that of the residual in the
  /// coordinates exp(φ), and Newton's method is quadratic.
  void multiply_skew(const State& q, const Vector& v, Vector& out) const {
    out.setZero(v.size());
    for (std::size_t j = 0; j < moment_.size(); ++j)
      out.segment<spin>(spin * j) =
          spin_skew(Spin<Space>(v.segment<spin>(spin * j))) * material_moment(q, j) / 2;
  }

 private:
  template <Hessian kind>
  void linearise(const State& q, Storage& out) const {
    const Chain<Space> chain{edges_, 0, columns_, forces_, Point<Space>::Zero(), clamp_, q.data()};
    ChainRows<Space> rows{out.gradient.data(), out.hessian.chain()};
    dispatch(ChainLinearisation<Space, kind>(chain, rows));
    out.energy = rows.energy;
    out.magnitude = rows.magnitude;
    if (!moment_.empty()) add_moments(q, out);
  }

  void add_moments(const State& q, Storage& out) const {
    for (int j = 0; j < edges_; ++j) {
      out.gradient.template segment<spin>(spin * j) -= material_moment(q, j);
      if constexpr (spin == 1) out.energy -= moment_[j][0] * q[j].radians;
    }
  }

  Spin<Space> material_moment(const State& q, std::size_t j) const {
    return rotate_spin(q[j].conjugate(), moment_[j]);
  }

  Rotation clamp_;
  EdgeColumns<Space> columns_;
  Columns<dim> forces_;  ///< on every edge
  int edges_;
  std::vector<Spin<Space>> moment_;  ///< empty if no moment acts
};

}  // namespace pyrod
