// SPDX-License-Identifier: BSD-3-Clause
/// \file What forces on vertices make of section forces, theory (13) and (16), and the transpose.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// A linear map; the storage is made once.
template <class Space>
class ForceSums {
 public:
  static constexpr int dim = Space::dim;

  explicit ForceSums(const Layout<Space>& layout)
      : layout_(layout),
        state_(layout),
        numbers_(layout),
        nodes_(layout.network().nodes.size()),
        known_(layout.spans().size()),
        inside_(layout.spans().size()) {}

  /// Adds to the section forces and the loads of nodes in `state`, from forces in `numbers`.
  void multiply(const Items<Space>& numbers, Items<Space>& state) {
    clear();
    for_each_attached([&](int node, int item) { nodes_[node] += point(numbers, item); });
    for_each_inside([&](int p, int, int item) { inside_[p] += point(numbers, item); });
    for (const auto& step : layout_.known().steps()) {
      Point<Space> balance = -nodes_[step.node];
      for (const auto& [s, end] : layout_.spans_at(step.node))
        balance += end ? Point<Space>(known_[s] - inside_[s]) : Point<Space>(-known_[s]);
      known_[step.span] += step.solve * balance;
    }
    for (int v = 0; v < int(nodes_.size()); ++v)
      state.col(state_.load(v)).template head<dim>() += nodes_[v];
    for (int p = 0; p < int(known_.size()); ++p) {
      const auto& span = layout_.spans()[p];
      Point<Space> n = known_[p];
      for (int j = span.first; j < span.last; ++j) {
        if (j > span.first) n -= point(numbers, numbers_.force(span.rod, j));
        state.col(state_.force(layout_.edge(span.rod, j))).template head<dim>() += n;
      }
    }
  }

  /// Adds to the forces in `numbers`.
  void pull(const Items<Space>& state, Items<Space>& numbers) {
    clear();
    for (int p = 0; p < int(known_.size()); ++p) {
      const auto& span = layout_.spans()[p];
      for (int j = span.last - 1; j >= span.first; --j) {
        known_[p] += point(state, state_.force(layout_.edge(span.rod, j)));
        if (j > span.first)
          numbers.col(numbers_.force(span.rod, j)).template head<dim>() -= known_[p];
      }
    }
    const auto& steps = layout_.known().steps();
    for (auto step = steps.rbegin(); step != steps.rend(); ++step) {
      const Point<Space> balance = step->solve.transpose() * known_[step->span];
      nodes_[step->node] -= balance;
      for (const auto& [s, end] : layout_.spans_at(step->node)) {
        known_[s] += end ? balance : Point<Space>(-balance);
        if (end) inside_[s] -= balance;
      }
    }
    for (int v = 0; v < int(nodes_.size()); ++v) nodes_[v] += point(state, state_.load(v));
    for_each_attached(
        [&](int node, int item) { numbers.col(item).template head<dim>() += nodes_[node]; });
    for_each_inside(
        [&](int p, int, int item) { numbers.col(item).template head<dim>() += inside_[p]; });
  }

 private:
  static Point<Space> point(const Items<Space>& from, int item) {
    return from.col(item).template head<dim>();
  }

  void clear() {
    for (auto* list : {&nodes_, &known_, &inside_})
      std::fill(list->begin(), list->end(), Point<Space>::Zero());
  }

  /// Vertices on nodes; of a closed rod the last one is the first.
  template <class Visit>
  void for_each_attached(Visit&& visit) const {
    const auto& rods = layout_.network().rods;
    for (int rod = 0; rod < int(rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod)) {
        visit(a.node, numbers_.force(rod, a.vertex));
        if (rods[rod].grid.closed() && a.vertex == 0)
          visit(a.node, numbers_.force(rod, rods[rod].edges()));
      }
  }

  template <class Visit>
  void for_each_inside(Visit&& visit) const {
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      for (int j = span.first + 1; j < span.last; ++j) visit(p, j, numbers_.force(span.rod, j));
    }
  }

  const Layout<Space>& layout_;
  StateItems<Space> state_;
  NumberItems<Space> numbers_;
  std::vector<Point<Space>> nodes_, known_, inside_;
};

}  // namespace pyrod
