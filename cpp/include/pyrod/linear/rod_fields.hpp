// SPDX-License-Identifier: BSD-3-Clause
/// \file The numbers of a network from those of one rod: stiffnesses and curvature at rest, all
/// along it.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/scene_change.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pyrod {

/// Where a curvature or a stiffness jumps, both sides change alike.
template <class Space>
class RodNumbers {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  RodNumbers(const Layout<Space>& layout, int rod)
      : layout_(layout),
        rod_(rod),
        r_(layout.network().rods[rod]),
        numbers_(layout),
        attached_(layout) {
    add_edges();
    const auto& on = layout.attached(rod);
    for (int i = 0; i < int(on.size()); ++i) add_attached(on[i], attached_.of(rod, i));
    if (r_.grid.closed()) return;
    for (const auto& [side, j] : {std::pair(Side::before, 0), std::pair(Side::behind, r_.edges())})
      add(numbers_.end_stiffness(rod, side), numbers_.end_rest(rod, side), j, r_.grid.Δs(j));
  }

  /// Adds to the numbers of the network.
  void multiply(const RodFields& fields, Items<Space>& numbers) const {
    Items<Space> in = Items<Space>::Zero(item_width<Space>, count());
    for (int j = 0; j < r_.grid.vertices(); ++j) {
      in.col(bending(j)).template head<spin>() = restrict_spin<Space>(fields.bending[j]);
      in.col(K0(j)).template head<spin>() = restrict_spin<Space>(fields.K0[j]);
    }
    for (int j = 0; j < r_.edges(); ++j)
      in.col(stretching(j)).template head<dim>() = restrict_point<Space>(fields.stretching[j]);
    map_.multiply(in, numbers);
  }

  RodFields pull(const Items<Space>& numbers) const {
    Items<Space> in = Items<Space>::Zero(item_width<Space>, count());
    map_.pull(numbers, in);
    RodFields out;
    for (int j = 0; j < r_.grid.vertices(); ++j) {
      out.bending.push_back(embed_spin(Spin<Space>(in.col(bending(j)).template head<spin>())));
      out.K0.push_back(embed_spin(Spin<Space>(in.col(K0(j)).template head<spin>())));
    }
    for (int j = 0; j < r_.edges(); ++j)
      out.stretching.push_back(embed(Point<Space>(in.col(stretching(j)).template head<dim>())));
    return out;
  }

 private:
  int bending(int j) const { return j; }
  int K0(int j) const { return r_.edges() + 1 + j; }
  int stretching(int j) const { return 2 * (r_.edges() + 1) + j; }
  int count() const { return stretching(r_.edges()); }

  /// The cell of vertex j, or a half of it.
  void add(int stiffness, int rest, int j, double length) {
    map_.add(stiffness, bending(j), 1 / length);
    map_.add(rest, K0(j), length);
  }

  void add_edges() {
    for (const auto& span : layout_.spans()) {
      if (span.rod != rod_) continue;
      for (int j = span.first; j < span.last; ++j) {
        const int e = layout_.edge(rod_, j);
        if (j > span.first)
          add(numbers_.stiffness(e), numbers_.rest(e), j, r_.grid.Δs(j));
        else if (layout_.clamp_of(span))
          add(numbers_.stiffness(e), numbers_.rest(e), j, r_.grid.h(j) / 2);
        Mat<dim> of = Mat<dim>::Zero();
        for (int i = 0; i < dim; ++i) of(i, i) = -1 / (r_.stretching[j][i] * r_.stretching[j][i]);
        map_.add(numbers_.compliance(e), stretching(j), of);
      }
    }
  }

  void add_attached(const Attachment<Space>& a, int number) {
    const int n = r_.edges(), j = a.vertex;
    const bool closed = r_.grid.closed();
    const auto put = [&](Side side, double length) {
      add(numbers_.stiffness(number, side), numbers_.rest(number, side), j, length);
    };
    if (!a.rigid) {
      if (closed || (j > 0 && j < n)) put(Side::before, r_.grid.Δs(j));
      return;
    }
    if (closed || j > 0) put(Side::before, r_.grid.h(j > 0 ? j - 1 : n - 1) / 2);
    if (j < n) put(Side::behind, r_.grid.h(j) / 2);
  }

  const Layout<Space>& layout_;
  int rod_;
  const Rod<Space>& r_;
  NumberItems<Space> numbers_;
  AttachmentNumbers<Space> attached_;
  ItemMap<Space> map_;
};

}  // namespace pyrod
