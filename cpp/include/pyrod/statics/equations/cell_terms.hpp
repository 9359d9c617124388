// SPDX-License-Identifier: BSD-3-Clause
/// \file What acts in the cells of a network besides the diagonal law of bending and twisting:
/// potentials of their turns.
///
/// Rods without such terms never come here.
#pragma once

#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rod/tendon_cell.hpp>
#include <pyrod/rod/tension.hpp>
#include <pyrod/rod/turn_potential.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pyrod {

template <class Space>
class CellTerms {
 public:
  static constexpr int spin = Space::spin;

  /// `network` must stay where it is.
  explicit CellTerms(const Network<Space>& network) : net_(network) {
    if (net_.tendons.empty()) return;
    on_.resize(net_.rods.size());
    for (const auto& tendon : net_.tendons) tensions_.push_back(tendon.tension);
    for (int i = 0; i < int(net_.tendons.size()); ++i)
      on_[std::size_t(net_.tendons[std::size_t(i)].rod)].push_back(i);
  }

  /// Lets only a part of them act.
  void load(double part) {
    for (std::size_t i = 0; i < tensions_.size(); ++i)
      tensions_[i] = part * net_.tendons[i].tension;
  }
  /// The same with the tensions that are found as they are; none: zero.
  CellTerms under(const std::vector<double>& tensions) const {
    CellTerms out = *this;
    for (std::size_t i = 0; i < std::min(tensions_.size(), tensions.size()); ++i)
      if (net_.tendons[i].length) out.tensions_[i] = tensions[i];
    return out;
  }
  double tension(int tendon) const { return tensions_[std::size_t(tendon)]; }

  bool none() const { return on_.empty(); }
  bool none(int rod) const { return none() || on_[std::size_t(rod)].empty(); }
  bool none(int rod, int j, CellKind kind) const {
    return none() || std::ranges::none_of(on_[std::size_t(rod)], [&](int i) {
             return net_.tendons[std::size_t(i)].covers(j, kind);
           });
  }

  /// visit(number of the tendon, its tension, its length in the cell).
  template <class Visit>
  void for_each_tendon(int rod, int j, CellKind kind, const Spin<Space>& u,
                       const Visit& visit) const {
    if (none()) return;
    const auto& grid = net_.rods[rod].grid;
    for (const int i : on_[std::size_t(rod)]) {
      const auto& tendon = net_.tendons[std::size_t(i)];
      if (tendon.covers(j, kind))
        visit(i, tension(i), tendon_length(tendon.template cell<Space>(grid, j, kind), u));
    }
  }

  /// What they are at the turn u of a cell of vertex j.
  TurnPotential<Space> at(int rod, int j, CellKind kind, const Spin<Space>& u) const {
    TurnPotential<Space> out;
    for_each_tendon(rod, j, kind, u,
                    [&](int, double T, const auto& length) { add_tension<Space>(T, length, out); });
    return out;
  }

  /// With the diagonal law.
  TurnPotential<Space> whole(int rod, int j, CellKind kind, const Spin<Space>& u) const {
    auto out = at(rod, j, kind, u);
    const auto& r = net_.rods[rod];
    const auto sides = r.sides(j);
    const double Δs = length(r.grid, j, kind);
    const Spin<Space>&C = kind == CellKind::whole    ? r.bending[j]
                          : kind == CellKind::before ? sides.bending_before
                                                     : sides.bending_behind,
          &K0 = kind == CellKind::whole    ? r.K0[j]
                : kind == CellKind::before ? sides.K0_before
                                           : sides.K0_behind;
    const Spin<Space> k = C / Δs, strain = u - Δs * K0;
    out.energy += strain.dot(k.cwiseProduct(strain)) / 2;
    out.m += k.cwiseProduct(strain);
    out.k.diagonal() += k;
    return out;
  }

  static double length(const Grid& grid, int j, CellKind kind) {
    return kind == CellKind::before   ? grid.h(j - 1) / 2
           : kind == CellKind::behind ? grid.h(j) / 2
                                      : grid.Δs(j);
  }

  /// The same in the limit of short cells beside a vertex: potentials per length, of K.
  /// visit(number of the tendon, its tension, its length per length).
  template <class Visit>
  void for_each_tendon_at(int rod, int j, CellKind side, const Spin<Space>& K,
                          const Visit& visit) const {
    if (none()) return;
    const auto& grid = net_.rods[rod].grid;
    for (const int i : on_[std::size_t(rod)]) {
      const auto& tendon = net_.tendons[std::size_t(i)];
      if (tendon.covers(j, side))
        visit(i, tension(i), tendon_length(tendon.template at_vertex<Space>(grid, j, side), K));
    }
  }

 private:
  const Network<Space>& net_;
  std::vector<std::vector<int>> on_;  ///< tendons of each rod; none: there are no tendons
  std::vector<double> tensions_;
};

}  // namespace pyrod
