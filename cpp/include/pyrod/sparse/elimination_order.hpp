// SPDX-License-Identifier: BSD-3-Clause
/// \file In which order the blocks of a sparse symmetric matrix are eliminated, so that its factor
/// stays small.
///
/// Two orders are made, and the one that takes less work is kept: approximate minimum degree, which
/// is good for trees and small graphs, and nested dissection, which large ones need where rods run
/// through all of the graph. As blocks stand in space, they are dissected by planes.
#pragma once

#include <pyrod/core/types.hpp>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pyrod {

/// Blocks, each with its size and where it is, and those that it is coupled to.
struct BlockGraph {
  std::vector<int> sizes;
  std::vector<Vec3> places;
  std::vector<std::vector<int>> neighbours;

  int blocks() const { return int(sizes.size()); }

  int add(int size, const Vec3& place) {
    sizes.push_back(size);
    places.push_back(place);
    neighbours.emplace_back();
    return blocks() - 1;
  }
  /// Couples each of these to all others, but for those without unknowns.
  void couple(const std::vector<int>& group) {
    for (const int a : group)
      for (const int b : group)
        if (a != b && sizes[a] > 0 && sizes[b] > 0) neighbours[a].push_back(b);
  }
  /// To be called when all are coupled: each pair is left once.
  void compress() {
    for (auto& near : neighbours) {
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
    }
  }
};

inline std::vector<int> by_minimum_degree(const BlockGraph& graph) {
  const int n = graph.blocks();
  std::vector<Eigen::Triplet<double>> entries;
  for (int a = 0; a < n; ++a) {
    entries.emplace_back(a, a, 1.);  // without it Eigen takes the column for a dense one
    for (const int b : graph.neighbours[a]) entries.emplace_back(b, a, 1.);
  }
  Eigen::SparseMatrix<double> pattern(n, n);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern, order);
  return {order.indices().begin(), order.indices().end()};
}

/// Cuts the graph by planes across its longest extent, again and again: first come the two sides of
/// a cut, last the blocks of one side that are coupled to the other.
class NestedDissection {
 public:
  explicit NestedDissection(const BlockGraph& graph) : graph_(graph), part_(graph.sizes.size(), 0) {
    std::vector<int> all(graph.sizes.size());
    std::iota(all.begin(), all.end(), 0);
    split(std::move(all));
  }

  std::vector<int> order() && { return std::move(order_); }

 private:
  using Blocks = std::vector<int>;
  static constexpr std::size_t smallest = 8;  ///< parts that are not cut

  void split(Blocks all) {
    Blocks here, there, between;
    if (all.size() > smallest) cut(all, here, there);
    if (here.empty() || there.empty()) return append(all);
    const int side = ++parts_, other = ++parts_;
    mark(here, side), mark(there, other);
    Blocks near_there = taken(here, other), near_here = taken(there, side);
    if (near_there.size() <= near_here.size()) {
      between = std::move(near_there);
      there.insert(there.end(), near_here.begin(), near_here.end());
    } else {
      between = std::move(near_here);
      here.insert(here.end(), near_there.begin(), near_there.end());
    }
    split(std::move(here));
    split(std::move(there));
    append(between);
  }

  void append(const Blocks& blocks) { order_.insert(order_.end(), blocks.begin(), blocks.end()); }
  void mark(const Blocks& blocks, int part) {
    for (const int b : blocks) part_[b] = part;
  }

  void cut(const Blocks& all, Blocks& here, Blocks& there) const {
    Vec3 low = graph_.places[all[0]], high = low;
    for (const int b : all) {
      low = low.cwiseMin(graph_.places[b]);
      high = high.cwiseMax(graph_.places[b]);
    }
    Eigen::Index axis = 0;
    (high - low).maxCoeff(&axis);
    std::vector<double> places;
    for (const int b : all) places.push_back(graph_.places[b][axis]);
    const auto middle = places.begin() + std::ptrdiff_t(places.size() / 2);
    std::nth_element(places.begin(), middle, places.end());
    const double at = *middle;
    const bool low_side = at > low[axis];  // else half of them are at the very end
    for (const int b : all) {
      const double x = graph_.places[b][axis];
      ((low_side ? x < at : x <= at) ? here : there).push_back(b);
    }
  }

  /// Takes the blocks that are coupled to a part out of `side`.
  Blocks taken(Blocks& side, int part) const {
    const auto apart = [&](int b) {
      return std::ranges::none_of(graph_.neighbours[b], [&](int c) { return part_[c] == part; });
    };
    const auto coupled = std::stable_partition(side.begin(), side.end(), apart);
    Blocks out(coupled, side.end());
    side.erase(coupled, side.end());
    return out;
  }

  const BlockGraph& graph_;
  Blocks part_, order_;
  int parts_ = 0;
};

/// What a factorisation in this order takes: the sum of the squares of the entries of its columns.
inline double elimination_work(const BlockGraph& graph, const std::vector<int>& order) {
  const int n = graph.blocks();
  std::vector<int> place(order.size()), parent(order.size(), -1), seen(order.size(), -1);
  std::vector<double> height(order.size(), 0);
  for (int i = 0; i < n; ++i) place[order[i]] = i;
  for (int i = 0; i < n; ++i) {
    seen[i] = i;
    for (const int b : graph.neighbours[order[i]])
      for (int j = place[b]; j < i && seen[j] != i; j = parent[j]) {  // up the elimination tree
        if (parent[j] < 0) parent[j] = i;
        height[j] += graph.sizes[order[i]];
        seen[j] = i;
      }
  }
  double work = 0;
  for (int i = 0; i < n; ++i) {
    const double size = graph.sizes[order[i]], column = height[i] + size;
    work += size * column * column;
  }
  return work;
}

/// The blocks of a graph in the order of their elimination.
inline std::vector<int> elimination_order(const BlockGraph& graph) {
  constexpr int few = 50;  // for them minimum degree does
  const auto count = std::ranges::count_if(graph.sizes, [](int size) { return size > 0; });
  if (count <= 2) {
    std::vector<int> order(std::size_t(graph.blocks()));
    std::iota(order.begin(), order.end(), 0);
    return order;
  }
  std::vector<int> order = by_minimum_degree(graph);
  if (graph.blocks() <= few) return order;
  std::vector<int> other = NestedDissection(graph).order();
  return elimination_work(graph, other) < elimination_work(graph, order) ? other : order;
}

}  // namespace pyrod
