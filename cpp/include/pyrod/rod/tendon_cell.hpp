// SPDX-License-Identifier: BSD-3-Clause
/// \file A tendon inside of one cell of a rod that keeps its length: how long it is.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// What lies between the ends of the cell: v = along + u × lever, in its own components.
template <class Space>
struct TendonCell {
  Point<Space> along;  ///< Δs e3 + d₊ − d₋
  Point<Space> lever;  ///< d̄, of the middle of the cell
};

/// The length ℓ = |v| as a function of the turn, theory (33), and its direction t = v/ℓ.
template <class Space>
struct TendonLength {
  double length;
  Point<Space> direction;
  Spin<Space> slope;           ///< ∂ℓ/∂u = d̄ × t
  Mat<Space::spin> curvature;  ///< ∂²ℓ/∂u² = [d̄](I − t tᵀ)[d̄]ᵀ/ℓ, positive semidefinite
};

inline Vec3 levered(const Vec3& u, const Vec3& lever) { return u.cross(lever); }
inline Vec2 levered(const Vec1& u, const Vec2& lever) { return u[0] * Vec2(lever[1], -lever[0]); }

/// With its derivatives.
template <class Space>
TendonLength<Space> tendon_length(const TendonCell<Space>& cell, const Spin<Space>& u) {
  const Point<Space> v = cell.along + levered(u, cell.lever);
  const double length = v.norm();
  const Point<Space> t = v / length;
  TendonLength<Space> out{length, t, cross(cell.lever, t), {}};
  for (int i = 0; i < Space::spin; ++i) {
    const Point<Space> dv = levered(Spin<Space>(Spin<Space>::Unit(i)), cell.lever);
    const Point<Space> across = dv - t * t.dot(dv);
    for (int j = 0; j <= i; ++j)
      out.curvature(i, j) = out.curvature(j, i) =
          levered(Spin<Space>(Spin<Space>::Unit(j)), cell.lever).dot(across) / length;
  }
  return out;
}

}  // namespace pyrod
