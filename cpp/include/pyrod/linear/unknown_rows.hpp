// SPDX-License-Identifier: BSD-3-Clause
/// \file The rows of a network's unknowns as items of its state, and back.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <vector>

namespace pyrod {

template <class Space>
class UnknownRows {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  explicit UnknownRows(const Layout<Space>& layout) : layout_(layout), state_(layout) {
    for (int e = 0; e < layout.edges(); ++e) frames_.push_back(layout.frame_row(e));
  }

  /// To the unknowns' rows: the transpose of `spread`.
  void gather(const Items<Space>& from, Vector& rows) const {
    rows.resize(layout_.unknowns());  // each is set
    for (int e = 0; e < layout_.edges(); ++e)
      rows.segment<spin>(frames_[e]) = from.col(state_.turn(e)).template head<spin>();
    for (int i = 0; i < layout_.hinges(); ++i)
      rows[layout_.row(layout_.hinge_block(i))] = from(0, state_.hinge(i));
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const auto& span = layout_.spans()[p]; span.block >= 0)
        rows.segment(layout_.row(span.block), span.open.cols()).noalias() =
            span.open.transpose() * from.col(state_.gap(p)).template head<dim>();
    for (int v = 0; v < int(layout_.network().nodes.size()); ++v) {
      const auto& node = layout_.network().nodes[v];
      if (const int b = layout_.turn_block(v); b >= 0)
        rows.segment(layout_.row(b), node.turns.cols()).noalias() =
            node.turns.transpose() * from.col(state_.node_turn(v)).template head<spin>();
      if (const int b = layout_.place_block(v); b >= 0)
        rows.segment(layout_.row(b), node.free.cols()).noalias() =
            node.free.transpose() * from.col(state_.place(v)).template head<dim>();
    }
    for (int i = 0; i < int(layout_.network().tendons.size()); ++i)
      if (const int b = layout_.tendon_block(i); b >= 0)
        rows[layout_.row(b)] = layout_.unit_tension(i) * from(0, state_.tendon(i));
  }

  /// To the state: sets the turns of edges, adds all others. Multipliers stay in the items of gaps.
  void spread(const Vector& rows, Items<Space>& state) const {
    for (int e = 0; e < layout_.edges(); ++e)
      state.col(state_.turn(e)).template head<spin>() = rows.segment<spin>(frames_[e]);
    for (int i = 0; i < layout_.hinges(); ++i)
      state(0, state_.hinge(i)) += rows[layout_.row(layout_.hinge_block(i))];
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const auto& span = layout_.spans()[p]; span.block >= 0)
        state.col(state_.gap(p)).template head<dim>().noalias() +=
            span.open * rows.segment(layout_.row(span.block), span.open.cols());
    for (int v = 0; v < int(layout_.network().nodes.size()); ++v) {
      const auto& node = layout_.network().nodes[v];
      if (const int b = layout_.turn_block(v); b >= 0)
        state.col(state_.node_turn(v)).template head<spin>().noalias() +=
            node.turns * rows.segment(layout_.row(b), node.turns.cols());
      if (const int b = layout_.place_block(v); b >= 0)
        state.col(state_.place(v)).template head<dim>().noalias() +=
            node.free * rows.segment(layout_.row(b), node.free.cols());
    }
    for (int i = 0; i < int(layout_.network().tendons.size()); ++i)
      if (const int b = layout_.tendon_block(i); b >= 0)
        state(0, state_.tendon(i)) += layout_.unit_tension(i) * rows[layout_.row(b)];
  }

 private:
  const Layout<Space>& layout_;
  StateItems<Space> state_;
  std::vector<int> frames_;
};

}  // namespace pyrod
