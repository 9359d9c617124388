// SPDX-License-Identifier: BSD-3-Clause
/// \file What a rod itself carries where tendons carry a part of what its sections transmit.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/jump.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>

#include <Eigen/LU>

#include <cstddef>

namespace pyrod {

template <class Space>
class Backbone {
 public:
  static constexpr int spin = Space::spin;

  /// `stride`: see `Recovery`.
  Backbone(const CellTerms<Space>& terms, const Rod<Space>& rod, int number, int stride)
      : terms_(terms), rod_(rod), number_(number), stride_(stride) {}

  /// Curvature and material moment where cells are halves, or `everywhere`, as the moment there
  /// makes them; and the section force without the tendons'.
  void tell(RodSolution<Space>& s, bool everywhere) const {
    const int last = rod_.edges() / stride_;
    s.backbone_force.resize(std::size_t(last) + 1);
    for (int J = 0; J <= last; ++J) {
      const auto i = std::size_t(J);
      const CellKind side = J == last ? CellKind::before : CellKind::behind;
      if (everywhere || J == 0 || J == last) see(s, J, side);
      s.backbone_force[i] = s.vertex_force[i] - carried(s, J, side, s.strains.K[i]);
    }
    for (auto& b : s.before) {
      see(s, b.vertex, CellKind::behind);
      s.backbone_force[std::size_t(b.vertex)] =
          s.vertex_force[std::size_t(b.vertex)] -
          carried(s, b.vertex, CellKind::behind, s.strains.K[std::size_t(b.vertex)]);
      b.K = curvature(b.vertex, CellKind::before, in_frame(s, b.vertex, b.moment),
                      s.strains.K[std::size_t(b.vertex)]);
    }
  }

  /// What a tendon exerts where it begins, at a vertex that is told.
  Point<Space> pull(const RodSolution<Space>& s, int tendon, int vertex) const {
    const int J = vertex / stride_;
    Point<Space> out = Point<Space>::Zero();
    terms_.for_each_tendon_at(number_, vertex, CellKind::behind, s.strains.K[std::size_t(J)],
                              [&](int i, double T, const auto& length) {
                                if (i == tendon) out = T * length.direction;
                              });
    return rotate(s.vertex_frames[std::size_t(J)], out);
  }

 private:
  Spin<Space> in_frame(const RodSolution<Space>& s, int J, const Spin<Space>& moment) const {
    return rotate_spin(s.vertex_frames[std::size_t(J)].conjugate(), moment);
  }

  void see(RodSolution<Space>& s, int J, CellKind side) const {
    const auto i = std::size_t(J);
    auto& K = s.strains.K[i];
    K = curvature(J, side, in_frame(s, J, s.moment[i]), K);
    const auto sides = rod_.sides(J * stride_);
    s.material_moment[i] = side == CellKind::before
                               ? sides.bending_before.cwiseProduct(K - sides.K0_before)
                               : sides.bending_behind.cwiseProduct(K - sides.K0_behind);
  }

  /// C (K − K⁰) + Σ T ∂ℓ/∂K = M, theory (37). The left side is the gradient of a convex function.
  Spin<Space> curvature(int J, CellKind side, const Spin<Space>& M, Spin<Space> K) const {
    const int j = J * stride_;
    const auto sides = rod_.sides(j);
    const bool before = side == CellKind::before;
    const Spin<Space>&C = before ? sides.bending_before : sides.bending_behind,
          &K0 = before ? sides.K0_before : sides.K0_behind;
    for (int i = 0; i < 50; ++i) {
      TurnPotential<Space> ψ;
      ψ.m = C.cwiseProduct(K - K0), ψ.k.diagonal() = C;
      terms_.for_each_tendon_at(number_, j, side, K, [&](int, double T, const auto& length) {
        add_tension<Space>(T, length, ψ);
      });
      const Spin<Space> δ = ψ.k.inverse() * (M - ψ.m);
      K += δ;
      if (!(δ.norm() > 1e-15 * (K.norm() + 1 / rod_.grid.length()))) break;
    }
    return K;
  }

  /// By the tendons, in space.
  Point<Space> carried(const RodSolution<Space>& s, int J, CellKind side,
                       const Spin<Space>& K) const {
    Point<Space> out = Point<Space>::Zero();
    terms_.for_each_tendon_at(
        number_, J * stride_, side, K,
        [&](int, double T, const auto& length) { out += T * length.direction; });
    return rotate(s.vertex_frames[std::size_t(J)], out);
  }

  const CellTerms<Space>& terms_;
  const Rod<Space>& rod_;
  int number_, stride_;
};

}  // namespace pyrod
