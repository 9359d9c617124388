// SPDX-License-Identifier: BSD-3-Clause
/// \file Dead loads on a vertex, as changes of a network's numbers.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/linear/items.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <algorithm>

namespace pyrod {

template <class Space>
class VertexLoads {
 public:
  VertexLoads(const Layout<Space>& layout, int rod, int vertex)
      : layout_(layout), numbers_(layout), rod_(rod), vertex_(vertex) {}

  void add_force(const Point<Space>& F, Items<Space>& out) const {
    add(numbers_.force(rod_, vertex_), F, out);
  }

  /// On the node that holds the frame, else on the edges beside, which share it as by a lever; at a
  /// free end also in the half cell behind the last one.
  void add_moment(const Spin<Space>& M, Items<Space>& out) const {
    const auto& grid = layout_.network().rods[rod_].grid;
    const int n = grid.edges(), j = grid.closed() ? vertex_ % n : vertex_;
    const auto& on = layout_.attached(rod_);
    const auto holder =
        std::ranges::find_if(on, [j](const auto& a) { return a.rigid && a.vertex == j; });
    if (holder != on.end()) return add(numbers_.node_moment(holder->node), M, out);
    const auto edge = [&](int i) { return numbers_.moment(layout_.edge(rod_, i)); };
    if (!grid.closed() && (j == 0 || j == n)) {
      add(edge(j == 0 ? 0 : n - 1), M, out);
      return add(numbers_.end_moment(rod_, j == 0 ? Side::before : Side::behind), M, out);
    }
    const int before = j == 0 ? n - 1 : j - 1;
    const double part = grid.h(before) / (grid.h(before) + grid.h(j));
    add(edge(before), (1 - part) * M, out), add(edge(j), part * M, out);
  }

 private:
  template <class Value>
  static void add(int item, const Value& value, Items<Space>& out) {
    out.col(item).head(value.size()) += value;
  }

  const Layout<Space>& layout_;
  NumberItems<Space> numbers_;
  int rod_, vertex_;
};

}  // namespace pyrod
