// SPDX-License-Identifier: BSD-3-Clause
/// \file How the terms of an edge, theory (8), change with its section force and its numbers.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// One edge under its section force n, b = Rᵀn.
template <class Space>
struct EdgeMaps {
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Lever = Mat<spin, dim>;

  Mat<dim> R;
  Point<Space> b, S, Γ;
  double h;

  EdgeMaps(const typename Space::Rotation& q, const Point<Space>& n, const Point<Space>& compliance,
           double length)
      : R(matrix(q)),
        b(R.transpose() * n),
        S(compliance),
        Γ(axis<Space>() + S.cwiseProduct(b)),
        h(length) {}

  /// h (δb × Γ + b × S δb) of δn, theory (31).
  Lever moment_of_force() const {
    Lever out;
    for (int i = 0; i < dim; ++i) {
      const Point<Space> db = R.row(i).transpose();
      out.col(i) = h * (cross(db, Γ) + cross(b, Point<Space>(S.cwiseProduct(db))));
    }
    return out;
  }
  Lever moment_of_compliance() const {
    Lever out;
    for (int i = 0; i < dim; ++i)
      out.col(i) = h * cross(b, Point<Space>(b[i] * Point<Space>::Unit(i)));
    return out;
  }
  Spin<Space> moment_of_length() const { return cross(b, Γ); }

  /// δb of a turn: b × φ.
  Mat<dim, spin> force_of_turn() const { return skew(b); }

  /// The reach h R Γ: of turns (at a fixed n), of δn, S and h.
  Mat<dim, spin> reach_of_turn() const { return h * R * (S.asDiagonal() * skew(b) - skew(Γ)); }
  Mat<dim> reach_of_force() const { return h * R * S.asDiagonal() * R.transpose(); }
  Mat<dim> reach_of_compliance() const { return h * R * b.asDiagonal(); }
  Point<Space> reach_of_length() const { return R * Γ; }
};

}  // namespace pyrod
