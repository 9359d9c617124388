// SPDX-License-Identifier: BSD-3-Clause
/// \file Cells that a node cuts in two halves, and the frames that hold the ends of a rod.
#pragma once

#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/end_turn.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

namespace pyrod {

/// A vertex that is held: the halves of its cell turn by themselves. Strain and material moment are
/// their mean.
template <class Space>
struct HalvedCell {
  int rod, vertex;
  Spin<Space> turn, K, material_moment;
  Spin<Space> moment_before, moment_behind;  ///< that the halves transmit, in space
  double energy;
};

/// Of one rod.
template <class Space>
class HalfCells {
 public:
  using Rotation = typename Space::Rotation;

  HalfCells(const Layout<Space>& layout, const CellTerms<Space>& terms,
            const NetworkState<Space>& x, int rod)
      : on_(layout.attached(rod)),
        terms_(terms),
        loads_(layout.network().loads[rod]),
        r_(layout.network().rods[rod]),
        x_(x),
        rod_(rod),
        next_(on_.begin()) {}

  /// The attachment that cuts the cell of vertex j in two, if one does; to be asked for rising j.
  const Attachment<Space>* inside(int j) {
    while (next_ != on_.end() && next_->vertex < j) ++next_;
    if (next_ == on_.end() || next_->vertex != j || !next_->rigid) return nullptr;
    const bool end = !r_.grid.closed() && (j == 0 || j == r_.edges());
    return end ? nullptr : &*next_;
  }

  HalvedCell<Space> cell(int j, const Attachment<Space>& a,
                         const CosseratCurve<Space>& curve) const {
    const Rotation h = held_frame(x_, a);
    const int before = j == 0 ? r_.edges() - 1 : j - 1;
    const Spin<Space> u = log(principal(curve.frames[before].conjugate() * h)),
                      v = log(principal(h.conjugate() * curve.frames[j]));
    const double du = r_.grid.h(before) / 2, dv = r_.grid.h(j) / 2;
    const auto on = r_.sides(j);
    const Spin<Space>&C = on.bending_before, &D = on.bending_behind;
    const Spin<Space> ΔU = u / du - on.K0_before, ΔV = v / dv - on.K0_behind;
    HalvedCell<Space> out;
    out.rod = rod_, out.vertex = j;
    out.K = (u + v) / (du + dv);
    out.turn = r_.grid.Δs(j) * out.K;
    out.material_moment = r_.bending[j].cwiseProduct(out.K - r_.K0[j]);
    out.moment_before =
        rotate_spin(curve.frames[before], transmitted_moment<Space>(u, C, on.K0_before, du));
    out.moment_behind = rotate_spin(h, transmitted_moment<Space>(v, D, on.K0_behind, dv));
    add_terms(j, u, v, curve.frames[before], h, out);
    out.energy = (du * ΔU.dot(C.cwiseProduct(ΔU)) + dv * ΔV.dot(D.cwiseProduct(ΔV))) / 2;
    return out;
  }

  /// The frames that hold the ends; of a free end, the one that its last half cell turns to.
  void end_frames(CosseratCurve<Space>& curve) const {
    const Rotation &first = curve.frames.front(), &last = curve.frames.back();
    if (r_.grid.closed()) {
      curve.start_frame = first * principal(last.conjugate() * first).conjugate();
      curve.end_frame = last;
      return;
    }
    if (on_.front().rigid)
      curve.start_frame = nearest(held_frame(x_, on_.front()), first);
    else
      curve.start_frame = moved(
          first, turn_of_end<Space>(terms_, r_, rod_, End::start,
                                    rotate_spin(first.conjugate(), loads_.start_moment), false));
    const bool follows = !loads_.follower_end_moment.isZero(0);
    if (on_.back().rigid)
      curve.end_frame = nearest(held_frame(x_, on_.back()), last);
    else
      curve.end_frame =
          moved(last, turn_of_end<Space>(terms_, r_, rod_, End::end,
                                         follows ? loads_.follower_end_moment
                                                 : rotate_spin(last.conjugate(), loads_.end_moment),
                                         follows));
  }

 private:
  void add_terms(int j, const Spin<Space>& u, const Spin<Space>& v, const Rotation& before,
                 const Rotation& held, HalvedCell<Space>& out) const {
    if (terms_.none(rod_)) return;
    const auto exerted = [&](const Rotation& q, CellKind kind, const Spin<Space>& turn) {
      const Spin<Space> m = terms_.at(rod_, j, kind, turn).m;
      return rotate_spin(q, Spin<Space>(typename Space::Differential(turn).T() * m));
    };
    out.moment_before += exerted(before, CellKind::before, u);
    out.moment_behind += exerted(held, CellKind::behind, v);
  }

  const std::vector<Attachment<Space>>& on_;
  const CellTerms<Space>& terms_;
  const Loads<Space>& loads_;
  const Rod<Space>& r_;
  const NetworkState<Space>& x_;
  int rod_;
  typename std::vector<Attachment<Space>>::const_iterator next_;
};

}  // namespace pyrod
