// SPDX-License-Identifier: BSD-3-Clause
/// \file What places of nodes and reaches of edges make of positions, and the transpose.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/linear/response_change.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

/// A linear map in the order in which `Recovery` finds positions.
template <class Space>
class PositionSums {
 public:
  static constexpr int dim = Space::dim;
  using Points = typename ResponseChange<Space>::Points;

  explicit PositionSums(const Layout<Space>& layout)
      : layout_(layout), state_(layout), nodes_(dim, layout.network().nodes.size()) {
    for (const auto& rod : layout.network().rods) first_.push_back(first_.back() + rod.edges() + 1);
    find_order();
    left_.resize(dim, first_.back());
  }

  /// Column of a vertex. A closed rod has one more, which is its first again.
  int column(int rod, int vertex) const { return first_[rod] + vertex; }
  int columns() const { return first_.back(); }

  /// `reach`: of edges, in their order.
  void multiply(const Items<Space>& state, const Items<Space>& reach, Points& out) {
    for (int v = 0; v < int(nodes_.cols()); ++v) {
      nodes_.col(v).setZero();
      if (!layout_.derived(v)) nodes_.col(v) = state.col(state_.place(v)).template head<dim>();
    }
    out.setZero(dim, columns());
    for (const auto& [p, forwards] : order_) {
      const auto& span = layout_.spans()[p];
      Point<Space> r = forwards ? nodes_.col(span.start) : nodes_.col(span.end);
      if (!forwards) {
        for (int j = span.first; j < span.last; ++j) r -= edge(reach, span.rod, j);
        nodes_.col(span.start) = r;
      }
      out.col(column(span.rod, span.first)) = r;
      for (int j = span.first; j < span.last; ++j)
        out.col(column(span.rod, j + 1)) = r += edge(reach, span.rod, j);
      if (forwards && layout_.derived(span.end)) nodes_.col(span.end) = r;
    }
  }

  /// Adds to places and reaches.
  void pull(const Points& from, Items<Space>& state, Items<Space>& reach) {
    nodes_.setZero();
    left_ = from;
    for (std::size_t i = order_.size(); i-- > 0;) {
      const auto& [p, forwards] = order_[i];
      const auto& span = layout_.spans()[p];
      Point<Space> sum = Point<Space>::Zero();
      if (forwards && layout_.derived(span.end)) {
        sum = nodes_.col(span.end);
        nodes_.col(span.end).setZero();
      }
      for (int j = span.last - 1; j >= span.first; --j) {
        take(span.rod, j + 1, sum);
        reach.col(layout_.edge(span.rod, j)).template head<dim>() += sum;
      }
      take(span.rod, span.first, sum);
      if (forwards) {
        nodes_.col(span.start) += sum;
        continue;
      }
      sum += nodes_.col(span.start);
      nodes_.col(span.start).setZero();
      for (int j = span.first; j < span.last; ++j)
        reach.col(layout_.edge(span.rod, j)).template head<dim>() -= sum;
      nodes_.col(span.end) += sum;
    }
    for (int v = 0; v < int(nodes_.cols()); ++v)
      if (!layout_.derived(v)) state.col(state_.place(v)).template head<dim>() += nodes_.col(v);
  }

 private:
  void find_order() {
    const auto& spans = layout_.spans();
    std::vector<char> known(layout_.network().nodes.size()), done(spans.size(), false);
    for (int v = 0; v < int(known.size()); ++v) known[v] = !layout_.derived(v);
    for (bool more = true; more;) {
      more = false;
      for (std::size_t p = 0; p < spans.size(); ++p) {
        if (done[p] || !(known[spans[p].start] || known[spans[p].end])) continue;
        order_.emplace_back(int(p), known[spans[p].start] != 0);
        known[spans[p].start] = known[spans[p].end] = done[p] = more = true;
      }
    }
  }

  Point<Space> edge(const Items<Space>& reach, int rod, int j) const {
    return reach.col(layout_.edge(rod, j)).template head<dim>();
  }

  /// A vertex between two spans is told by the later of them.
  void take(int rod, int vertex, Point<Space>& sum) {
    auto one = left_.col(column(rod, vertex));
    sum += one;
    one.setZero();
  }

  const Layout<Space>& layout_;
  StateItems<Space> state_;
  Points nodes_, left_;
  std::vector<int> first_{0};
  std::vector<std::pair<int, bool>> order_;
};

}  // namespace pyrod
