// SPDX-License-Identifier: BSD-3-Clause
/// \file How what a cell between two edges tells changes with the turns φ of these, and the
/// transposes.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/cells.hpp>
#include <pyrod/linear/free_ends.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

/// `part` of the cell's turn lies before its vertex.
template <class Space>
struct CellPart;

/// In the plane turns add up.
template <>
struct CellPart<Planar> {
  Vec1 k, strain, u, slope;  ///< slope: of the moment, with all that acts in it
  double length, part;

  CellPart(const CellOfNetwork<Planar>& c, double before)
      : k(c.k),
        strain(c.strain()),
        u(c.u),
        slope(c.driven ? Vec1(c.k + c.others.k) : c.k),
        length(c.length),
        part(before) {}

  /// δu = T φ_b − Tᵀφ_a.
  Vec1 turn(const Vec1& a, const Vec1& b) const { return b - a; }
  void turn_back(const Vec1& w, Vec1& a, Vec1& b) const { a -= w, b += w; }
  /// T δm.
  Vec1 raised(const Vec1& m) const { return m; }
  Vec1 lowered(const Vec1& w) const { return w; }
  /// Of the moment, fixed in space, in frame a; of turns.
  Vec1 moment(const Vec1& a, const Vec1& b) const { return slope.cwiseProduct(b - a); }
  void moment_back(const Vec1& w, Vec1& a, Vec1& b) const {
    turn_back(slope.cwiseProduct(w), a, b);
  }
  /// The frame at the vertex; `δ`: of that part of the turn.
  Vec1 frame(const Vec1& a, const Vec1& δ) const { return a + δ; }
  void frame_back(const Vec1& w, Vec1& a, Vec1& δ) const { a += w, δ = w; }
};

template <>
struct CellPart<Spatial> {
  Vec3 k, strain, u;
  double length, part;
  Mat3 T, by_a, by_b, D;

  CellPart(const CellOfNetwork<Spatial>& c, double before)
      : k(c.k), strain(c.strain()), u(c.u), length(c.length), part(before), T(c.T()) {
    const auto jet = c.whole();
    by_a = skew(jet.a) / 2 - jet.aa;
    by_b = -jet.ab;
    D = turn_differential(Vec3(part * u));
  }

  Vec3 turn(const Vec3& a, const Vec3& b) const { return T * b - T.transpose() * a; }
  void turn_back(const Vec3& w, Vec3& a, Vec3& b) const {
    a.noalias() -= T * w;
    b.noalias() += T.transpose() * w;
  }
  Vec3 raised(const Vec3& m) const { return T * m; }
  Vec3 lowered(const Vec3& w) const { return T.transpose() * w; }
  Vec3 moment(const Vec3& a, const Vec3& b) const { return by_a * a + by_b * b; }
  void moment_back(const Vec3& w, Vec3& a, Vec3& b) const {
    a.noalias() += by_a.transpose() * w;
    b.noalias() += by_b.transpose() * w;
  }
  /// exp(−w) φ + D δ, as exp(−w) = 1 − [w] D.
  Vec3 frame(const Vec3& a, const Vec3& δ) const { return a + D * δ - part * u.cross(D * a); }
  void frame_back(const Vec3& w, Vec3& a, Vec3& δ) const {
    δ.noalias() = D.transpose() * w;
    a += w;
    a.noalias() += D.transpose() * (part * u.cross(w));
  }
};

}  // namespace pyrod
