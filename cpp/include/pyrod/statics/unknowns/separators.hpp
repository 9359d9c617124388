// SPDX-License-Identifier: BSD-3-Clause
/// \file What of a network is eliminated last, and in which order: nodes, and frames at which rods
/// are parted.
///
/// A rod that runs through moving nodes would tie all of them together if it were eliminated as a
/// whole. So the first frame behind each such node waits: without it the spans are on their own.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/sparse/elimination_order.hpp>
#include <pyrod/statics/unknowns/known_forces.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

template <class Space>
class Separators {
 public:
  explicit Separators(const KnownForces<Space>& known) : known_(known), cut_(known.cut()) {
    for (const auto& span : cut_.spans) parted_.push_back(is_parted(span));
  }

  /// Whether the first frame of the span is among them.
  bool part(int span) const { return parted_[span]; }

  /// Numbers of nodes, and behind them of spans whose first frames are meant.
  std::vector<int> order() const {
    BlockGraph graph;
    const int nodes = int(cut_.network.nodes.size());
    for (int v = 0; v < nodes; ++v) graph.add(size_of(v), place_of(v));
    for (std::size_t p = 0; p < cut_.spans.size(); ++p)
      graph.add(parted_[p] ? Space::spin : 0, place_of(cut_.spans[p].start));
    if (std::ranges::all_of(graph.sizes, [](int size) { return size == 0; })) return {};
    couple_along_rods(graph);
    graph.compress();
    auto order = elimination_order(graph);
    std::erase_if(order, [&](int i) { return graph.sizes[i] == 0; });
    return order;
  }

 private:
  /// Where a span has fewer edges, what is left without one tells little of how its ends give way:
  /// the pivots of its force would be small.
  static constexpr int fewest = 4;

  bool is_parted(const Span<Space>& span) const {
    const auto& a = cut_.attached[span.rod][span.attachment];
    return !a.rigid && cut_.edges_at(a).first >= 0 && moves(a.node) &&
           span.last - span.first >= fewest;
  }

  bool moves(int v) const { return cut_.network.nodes[v].free.cols() > 0 && !known_.derived(v); }

  int size_of(int v) const {
    const auto& node = cut_.network.nodes[v];
    int size = v < int(cut_.hinged.size()) ? int(cut_.hinged[v].size()) : 0;
    if (cut_.has_frame[v]) size += int(node.turns.cols());
    if (moves(v)) size += int(node.free.cols());
    return size;
  }

  Vec3 place_of(int v) const {
    Vec3 out = Vec3::Zero();
    out.head<Space::dim>() = cut_.network.nodes[v].position;
    return out;
  }

  /// Eliminating spans that are not parted couples all nodes at them, and the frames that part
  /// them from what is before and behind. (That the last span of a closed rod may go on in the
  /// first is left out.)
  void couple_along_rods(BlockGraph& graph) const {
    std::vector<int> group;
    const int nodes = int(cut_.network.nodes.size()), spans = int(cut_.spans.size());
    int first = 0;  // of the rod
    for (int p = 0; p < spans; ++p) {
      const auto& span = cut_.spans[p];
      if (cut_.spans[first].rod != span.rod) first = p;
      if (p == first || parted_[p] || cut_.attached[span.rod][span.attachment].rigid)
        graph.couple(group), group.clear();
      group.insert(group.end(), {span.start, span.end, nodes + p});
      const bool last = p + 1 == spans || cut_.spans[p + 1].rod != span.rod;
      if (!last || cut_.closed(span.rod)) group.push_back(nodes + (last ? first : p + 1));
    }
    graph.couple(group);
  }

  const KnownForces<Space>& known_;
  const Spans<Space>& cut_;
  std::vector<char> parted_;
};

}  // namespace pyrod
