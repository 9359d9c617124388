// SPDX-License-Identifier: BSD-3-Clause
/// \file The unknowns of a network: which there are, and how they are numbered.
#pragma once

#include <pyrod/scene/network.hpp>
#include <pyrod/sparse/block_pattern.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/unknowns/known_forces.hpp>
#include <pyrod/statics/unknowns/same_unknowns.hpp>
#include <pyrod/statics/unknowns/separators.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
class Layout {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  explicit Layout(Network<Space> network);

  /// Of a network that may differ from that of `like` in its numbers only: then it takes over how
  /// the unknowns are numbered.
  Layout(Network<Space> network, Layout&& like);

  /// See `KnownForces`.
  bool take_loads(std::vector<Loads<Space>>& loads) { return known_.take_loads(loads); }

  /// Nodes, and rods at rest, at other places.
  void move_nodes(const Network<Space>& to) {
    auto& cut = known_.cut();
    cut.network.placements = to.placements;
    for (std::size_t v = 0; v < to.nodes.size(); ++v) {
      cut.network.nodes[v].position = to.nodes[v].position;
      cut.network.nodes[v].frame = to.nodes[v].frame;
    }
    cut.check_reach();
  }

  const KnownForces<Space>& known() const { return known_; }
  const Network<Space>& network() const { return known_.cut().network; }
  const std::vector<Span<Space>>& spans() const { return known_.cut().spans; }
  /// Attachments of a rod, in the order of its vertices.
  const std::vector<Attachment<Space>>& attached(int rod) const {
    return known_.cut().attached[rod];
  }
  /// The spans at a node, with whether they end there.
  const std::vector<std::pair<int, bool>>& spans_at(int node) const {
    return known_.cut().spans_at[node];
  }
  int edges() const { return known_.cut().edges(); }
  /// Number of edge j of a rod among all edges.
  int edge(int rod, int j) const { return known_.cut().edge(rod, j); }
  int hinges() const { return known_.cut().hinges; }
  /// The position of the node follows from that of others.
  bool derived(int node) const { return known_.derived(node); }

  int frame_block(int e) const { return frame_block_[e]; }
  /// −1: the frame, or the position, of the node is no unknown.
  int turn_block(int node) const { return turn_block_[node]; }
  int place_block(int node) const { return place_block_[node]; }
  int hinge_block(int hinge) const { return hinge_block_[hinge]; }
  /// −1: its tension is given.
  int tendon_block(int tendon) const { return tendon_block_[tendon]; }
  /// The unit of its tension: what bends its rod by about a radian.
  double unit_tension(int tendon) const {
    const auto& one = network().tendons[tendon];
    return rod_moment_[one.rod] / one.largest_offset();
  }
  /// Number of the first unknown of a block, and of the frame of an edge.
  int row(int block) const { return rows_[block]; }
  int frame_row(int e) const { return rows_[frame_block_[e]]; }
  int unknowns() const { return rows_.back(); }
  /// Those of the unknowns that are section forces.
  int multipliers() const {
    int sum = 0;
    for (const auto& span : spans()) sum += int(span.open.cols());
    for (const int block : tendon_block_) sum += block >= 0;
    return sum;
  }
  /// Numbers of the first and the last edge of a span among all edges.
  int first_edge(int p) const { return edge(spans()[p].rod, spans()[p].first); }
  int last_edge(int p) const { return edge(spans()[p].rod, spans()[p].last - 1); }
  /// Whether the attachment holds the rod in a frame that is no unknown.
  bool clamps(const Attachment<Space>& a) const {
    return a.rigid && !a.hinge && network().nodes[a.node].turns.cols() == 0;
  }
  /// 1 if the first frame of a span stands by itself, behind all spans; else 0. The others, and
  /// behind them its force, follow each other.
  int apart(int p) const { return frame_block_[first_edge(p)] >= first_node_block_; }
  /// The attachment that clamps the start of a span, or null.
  const Attachment<Space>* clamp_of(const Span<Space>& span) const {
    const auto& a = attached(span.rod)[span.attachment];
    return clamps(a) ? &a : nullptr;
  }
  /// Every rod is clamped, and the loads tell all section forces: only frames of edges are unknown,
  /// and they have a potential of their own without any multiplier, Linn B.5.
  bool determinate() const { return determinate_; }
  /// Blocks before it belong to spans, and those from it on to tendons, then to nodes, or to frames
  /// that stand by themselves.
  int first_node_block() const { return first_node_block_; }
  const BlockPattern& pattern() const { return pattern_; }
  /// Of the blocks.
  const std::vector<int>& sizes() const { return pattern_.sizes; }
  /// The length of the free directions of a node: that of the longest rod on it.
  double unit_length(int node) const { return node_length_[node]; }
  /// EI/L² of a span, the length of its open directions.
  double unit_force(int span) const { return span_moment_[span] / span_length_[span]; }
  /// EI/L of a span, of a rod, and of all rods in the geometric mean.
  double span_moment(int span) const { return span_moment_[span]; }
  double span_length(int span) const { return span_length_[span]; }
  double rod_moment(int rod) const { return rod_moment_[rod]; }
  double unit_moment() const { return moment_; }

 private:
  using Couplings = std::vector<std::pair<int, int>>;

  void take_numbers(Layout&& from);
  void see_whether_determinate();

  /// Each part is measured by itself: what is stiff or long elsewhere does not count.
  void set_units(Spans<Space>& cut) {
    double stiffness = 0, length = 0;
    std::vector<double> bending;  // geometric means
    for (const auto& rod : cut.network.rods) {
      double sum = 0;
      for (const auto& C : rod.bending) sum += std::log(C.maxCoeff());
      bending.push_back(std::exp(sum / double(rod.bending.size())));
      rod_moment_.push_back(bending.back() / rod.grid.length());
      stiffness += sum / double(rod.bending.size());
      length = std::max(length, rod.grid.length());
    }
    moment_ = std::exp(stiffness / double(cut.network.rods.size())) / length;
    node_length_.assign(cut.network.nodes.size(), 0);
    for (auto& span : cut.spans) {
      const auto& grid = cut.network.rods[span.rod].grid;
      span_length_.push_back(grid.s(span.last) - grid.s(span.first));
      span_moment_.push_back(bending[span.rod] / span_length_.back());
      for (const int v : {span.start, span.end})
        node_length_[v] = std::max(node_length_[v], grid.length());
    }
    for (int p = 0; p < int(cut.spans.size()); ++p) cut.spans[p].open *= unit_force(p);
    for (std::size_t v = 0; v < cut.network.nodes.size(); ++v) {
      if (node_length_[v] == 0) node_length_[v] = length;  // no rod is there
      cut.network.nodes[v].free *= node_length_[v];
    }
  }

  /// Span by span along each rod: the frames, then the force, so that nothing of it fills the
  /// frames that follow; the nodes last, and frames at which rods are parted.
  void number(Spans<Space>& cut) {
    const Separators<Space> separators(known_);
    turn_block_.assign(cut.network.nodes.size(), -1);
    place_block_ = turn_block_;
    hinge_block_.assign(cut.hinges, -1);
    frame_block_.assign(edges(), -1);
    pattern_.sizes.reserve(std::size_t(edges()) + cut.spans.size() + 2 * cut.network.nodes.size());
    for (int p = 0; p < int(cut.spans.size()); ++p) {
      auto& span = cut.spans[p];
      for (int j = span.first + separators.part(p); j < span.last; ++j)
        frame_block_[edge(span.rod, j)] = new_block(spin);
      if (span.open.cols() > 0) span.block = new_block(int(span.open.cols()));
    }
    first_node_block_ = pattern_.blocks();
    for (const auto& tendon : cut.network.tendons)
      tendon_block_.push_back(tendon.length ? new_block(1) : -1);
    const int nodes = int(cut.network.nodes.size());
    for (const int i : separators.order())
      if (i < nodes)
        number_node(cut, i);
      else
        frame_block_[first_edge(i - nodes)] = new_block(spin);
    Couplings couplings;
    couplings.reserve(std::size_t(2 * edges()));
    couple_in_spans(cut, couplings);
    couple_through_nodes(cut, couplings);
    couple_with_nodes(cut, couplings);
    couple_tendons(cut, couplings);
    pattern_ = BlockPattern(std::move(pattern_.sizes), couplings);
    rows_.assign(1, 0);
    for (const int size : pattern_.sizes) rows_.push_back(rows_.back() + size);
  }

  int new_block(int size) {
    pattern_.sizes.push_back(size);
    return last_block();
  }
  int last_block() const { return pattern_.blocks() - 1; }

  void couple_in_spans(const Spans<Space>& cut, Couplings& couplings) const {
    for (const auto& span : cut.spans)
      for (int j = span.first; j < span.last; ++j) {
        const int here = frame_block_[edge(span.rod, j)];
        if (j > span.first)
          couplings.push_back(std::minmax(frame_block_[edge(span.rod, j - 1)], here));
        if (span.block >= 0) couplings.push_back(std::minmax(here, span.block));
      }
  }

  void couple_through_nodes(const Spans<Space>& cut, Couplings& couplings) const {
    for (const auto& on : cut.attached)
      for (const auto& a : on) {
        const auto [before, behind] = cut.edges_at(a);
        if (a.rigid || before < 0 || behind < 0 || before == behind) continue;
        couplings.push_back(std::minmax(frame_block_[before], frame_block_[behind]));
      }
  }

  void number_node(const Spans<Space>& cut, int v) {
    const auto& node = cut.network.nodes[v];
    if (v < int(cut.hinged.size()))
      for (const int h : cut.hinged[v]) hinge_block_[h] = new_block(1);
    if (cut.has_frame[v] && node.turns.cols() > 0)
      turn_block_[v] = new_block(int(node.turns.cols()));
    if (node.free.cols() > 0 && !derived(v)) place_block_[v] = new_block(int(node.free.cols()));
  }

  void couple_with_nodes(const Spans<Space>& cut, Couplings& couplings) const {
    const auto add = [&](int I, int J) {
      if (I >= 0) couplings.push_back(std::minmax(I, J));
    };
    for (const auto& on : cut.attached)
      for (const auto& a : on) {
        if (!a.rigid) continue;
        const auto [before, behind] = cut.edges_at(a);
        if (a.hinge) {
          const int hinge = hinge_block_[a.hinge_number];
          for (const int e : {before, behind})
            if (e >= 0) add(frame_block_[e], hinge);
          if (turn_block_[a.node] >= 0) add(hinge, turn_block_[a.node]);
        }
        if (turn_block_[a.node] < 0) continue;
        if (before >= 0) add(frame_block_[before], turn_block_[a.node]);
        if (behind >= 0) add(frame_block_[behind], turn_block_[a.node]);
      }
    for (const auto& span : cut.spans)
      for (const int v : {span.start, span.end})
        if (place_block_[v] >= 0) add(span.block, place_block_[v]);
  }

  /// With all frames along them, and with each other.
  void couple_tendons(const Spans<Space>& cut, Couplings& couplings) const {
    const auto add = [&](int I, int J) {
      if (I >= 0 && J >= 0 && I != J) couplings.push_back(std::minmax(I, J));
    };
    for (std::size_t i = 0; i < tendon_block_.size(); ++i) {
      const int block = tendon_block_[i];
      const auto& tendon = cut.network.tendons[i];
      for (int j = tendon.first; block >= 0 && j < tendon.last; ++j)
        add(frame_block_[edge(tendon.rod, j)], block);
      for (const auto& a : cut.attached[tendon.rod]) {
        if (!a.rigid || a.vertex < tendon.first || a.vertex > tendon.last) continue;
        add(turn_block_[a.node], block);
        if (a.hinge) add(hinge_block_[a.hinge_number], block);
      }
      for (std::size_t k = 0; k < i; ++k)
        if (cut.network.tendons[k].rod == tendon.rod) add(tendon_block_[k], block);
    }
  }

  KnownForces<Space> known_;
  std::vector<int> hinge_block_, frame_block_, turn_block_, place_block_, tendon_block_;
  std::vector<int> rows_;  ///< first of each block, and behind the last
  BlockPattern pattern_;
  int first_node_block_ = 0;
  std::vector<double> span_moment_, span_length_, rod_moment_, node_length_;
  double moment_ = 1;
  bool determinate_ = false;
};

template <class Space>
Layout<Space>::Layout(Network<Space> network) : known_(std::move(network)) {
  set_units(known_.cut());
  number(known_.cut());
  see_whether_determinate();
}

template <class Space>
Layout<Space>::Layout(Network<Space> network, Layout&& like) : known_(std::move(network)) {
  set_units(known_.cut());
  if (same_unknowns(known_, like.known_))
    take_numbers(std::move(like));
  else
    number(known_.cut());
  see_whether_determinate();
}

template <class Space>
void Layout<Space>::see_whether_determinate() {
  determinate_ = unknowns() == spin * edges();
  for (const auto& on : known_.cut().attached)
    determinate_ =
        determinate_ && std::ranges::any_of(on, [&](const auto& a) { return clamps(a); });
}

template <class Space>
void Layout<Space>::take_numbers(Layout&& from) {
  auto& spans = known_.cut().spans;
  for (std::size_t p = 0; p < spans.size(); ++p) spans[p].block = from.spans()[p].block;
  hinge_block_ = std::move(from.hinge_block_);
  frame_block_ = std::move(from.frame_block_);
  turn_block_ = std::move(from.turn_block_);
  place_block_ = std::move(from.place_block_);
  tendon_block_ = std::move(from.tendon_block_);
  rows_ = std::move(from.rows_);
  pattern_ = std::move(from.pattern_);
  first_node_block_ = from.first_node_block_;
}

}  // namespace pyrod
