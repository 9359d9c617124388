// SPDX-License-Identifier: BSD-3-Clause
/// \file What a cell between two edges makes of the state and the numbers there, item by item, and
/// the transposes.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/cell_part.hpp>
#include <pyrod/linear/edge_part.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/told_items.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

namespace detail {

template <class Space>
Point<Space> point(const Items<Space>& from, int i) {
  return from.col(i).template head<Space::dim>();
}
template <class Space>
Spin<Space> turn(const Items<Space>& from, int i) {
  return from.col(i).template head<Space::spin>();
}
/// What is left of the room of the item is zero.
template <class Space, class Value>
void set(Items<Space>& out, int i, const Value& value) {
  constexpr int N = Value::RowsAtCompileTime;
  out.col(i).template head<N>() = value;
  if constexpr (N < item_width<Space>) out.col(i).template tail<item_width<Space> - N>().setZero();
}

}  // namespace detail

/// Where a cell is: the edges before and behind, its numbers, and the vertex.
struct CellPlace {
  int a, b, stiffness, rest, vertex;
};

template <class Space>
class WholeCell {
 public:
  using Turn = Spin<Space>;
  using I = Items<Space>;
  struct Kinds {
    const StateItems<Space>& state;
    const NumberItems<Space>& numbers;
    const ToldItems<Space>& told;
  };

  WholeCell(const Kinds& kinds, const CellPart<Space>& part, const CellPlace& at,
            const EdgePart<Space>& a, const EdgePart<Space>& b)
      : kinds_(kinds), cell_(part), at_(at), before_(a.R), behind_(b.R) {}

  /// Adds to the residual, from numbers.
  void multiply(const I& numbers, I& residual) const {
    const Turn δm = moment(numbers);
    residual.col(kinds_.state.turn(at_.a)).template head<Space::spin>() -= cell_.raised(δm);
    residual.col(kinds_.state.turn(at_.b)).template head<Space::spin>() += cell_.lowered(δm);
  }

  /// Sets what is told of the vertex; returns the energy.
  double tell(const I& numbers, const I& state, I& told) const {
    const auto& items = kinds_.told;
    const Turn a = turn(state, kinds_.state.turn(at_.a)), b = turn(state, kinds_.state.turn(at_.b)),
               δu = cell_.turn(a, b), δm = moment(numbers);
    const double ha = numbers(0, kinds_.numbers.length(at_.a)),
                 hb = numbers(0, kinds_.numbers.length(at_.b)), l = 2 * cell_.length,
                 part = ((1 - cell_.part) * ha - cell_.part * hb) / l;
    set(told, items.moment(at_.vertex),
        spin_to_space(before_, Turn(cell_.moment(a, b) + cell_.raised(δm))));
    set(told, items.curvature(at_.vertex), Turn((δu - (ha + hb) / l * cell_.u) / cell_.length));
    set(told, items.rotation(at_.vertex),
        Turn((1 - cell_.part) * spin_to_space(before_, a) +
             cell_.part * spin_to_space(behind_, b)));
    set(told, items.vertex_turn(at_.vertex),
        cell_.frame(a, Turn(cell_.part * δu + part * cell_.u)));
    return m().dot(δu - turn(numbers, at_.rest)) +
           cell_.strain.cwiseAbs2().dot(turn(numbers, at_.stiffness)) / 2;
  }

  /// Adds to the turns of the edges, from weights of what is told.
  void pull_told(const I& told, double energy, I& state) const {
    const auto& items = kinds_.told;
    const Turn ρ = turn(told, items.rotation(at_.vertex)),
               M = spin_to_frame(before_, turn(told, items.moment(at_.vertex))),
               K = turn(told, items.curvature(at_.vertex));
    Turn a = (1 - cell_.part) * spin_to_frame(before_, ρ),
         b = cell_.part * spin_to_frame(behind_, ρ), δ;
    cell_.frame_back(turn(told, items.vertex_turn(at_.vertex)), a, δ);
    cell_.moment_back(M, a, b);
    cell_.turn_back(Turn(cell_.part * δ + K / cell_.length + energy * m()), a, b);
    state.col(kinds_.state.turn(at_.a)).template head<Space::spin>() += a;
    state.col(kinds_.state.turn(at_.b)).template head<Space::spin>() += b;
  }

  /// Sets stiffness and rest, from the residual and weights of what is told. Returns what belongs
  /// to the lengths of the two edges.
  Vec2 pull(const I& residual, const I& told, double energy, I& numbers) const {
    const auto& items = kinds_.told;
    const Turn M = spin_to_frame(before_, turn(told, items.moment(at_.vertex)));
    const Turn δm = cell_.lowered(M) + cell_.turn(turn(residual, kinds_.state.turn(at_.a)),
                                                  turn(residual, kinds_.state.turn(at_.b)));
    set(numbers, at_.stiffness, Turn(cell_.strain.cwiseProduct(δm + (energy / 2) * cell_.strain)));
    set(numbers, at_.rest, Turn(-cell_.k.cwiseProduct(δm + energy * cell_.strain)));
    Turn a = Turn::Zero(), δ;
    cell_.frame_back(turn(told, items.vertex_turn(at_.vertex)), a, δ);
    const double l = 2 * cell_.length, frame = δ.dot(cell_.u) / l,
                 K = cell_.u.dot(turn(told, items.curvature(at_.vertex))) / (l * cell_.length);
    return {(1 - cell_.part) * frame - K, -cell_.part * frame - K};
  }

 private:
  static Turn turn(const I& from, int i) { return detail::turn<Space>(from, i); }
  template <class Value>
  static void set(I& out, int i, const Value& value) {
    detail::set<Space>(out, i, value);
  }

  Turn m() const { return cell_.k.cwiseProduct(cell_.strain); }
  /// Theory (30).
  Turn moment(const I& numbers) const {
    return cell_.strain.cwiseProduct(turn(numbers, at_.stiffness)) -
           cell_.k.cwiseProduct(turn(numbers, at_.rest));
  }

  const Kinds& kinds_;
  const CellPart<Space>& cell_;
  const CellPlace& at_;
  const Mat<Space::dim>&before_, &behind_;
};

}  // namespace pyrod
