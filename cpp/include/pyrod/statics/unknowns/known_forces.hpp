// SPDX-License-Identifier: BSD-3-Clause
/// \file What the loads tell of the section forces, without any equation to be solved.
///
/// At a node that moves freely in a direction, and on which one unknown force acts, the balance in
/// that direction tells it. From the free ends inwards this goes on until nothing more is told.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <Eigen/QR>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace pyrod {

/// Forces on the vertices of every rod.
template <class Space>
using VertexForces = std::vector<std::vector<Point<Space>>>;

template <class Space>
class KnownForces {
 public:
  static constexpr int dim = Space::dim;

  explicit KnownForces(Network<Space> network) : cut_(std::move(network)) {
    hold_drifting_parts();
    strip_known_forces();
  }

  /// The network, in whose spans only what is not told is open.
  const Spans<Space>& cut() const { return cut_; }
  Spans<Space>& cut() { return cut_; }

  /// Other loads; false, and nothing has changed, where they decide more than numbers: what nodes
  /// feel, or whether what nothing holds stays where it is.
  bool take_loads(std::vector<Loads<Space>>& loads) {
    const auto on_nodes = [](const auto& one) { return !one.vertex_moments.empty(); };
    if (drifts_ || std::ranges::any_of(loads, on_nodes) ||
        std::ranges::any_of(cut_.network.loads, on_nodes))
      return false;
    cut_.network.loads = std::move(loads);
    return true;
  }

  /// The dead loads on the vertices.
  VertexForces<Space> dead_forces() const {
    VertexForces<Space> out;
    for (const auto& loads : cut_.network.loads) out.push_back(loads.force);
    return out;
  }

  /// What vertices carry and, multiplied by `own`, nodes; summed over each node.
  std::vector<Point<Space>> on_nodes(const VertexForces<Space>& force, double own = 1) const {
    std::vector<Point<Space>> out(cut_.network.nodes.size(), Point<Space>::Zero());
    for (std::size_t v = 0; v < out.size(); ++v) out[v] = own * cut_.network.nodes[v].force;
    for (const auto& on : cut_.attached)
      for (const auto& a : on) {
        out[a.node] += force[a.rod][a.vertex];
        if (cut_.closed(a.rod) && a.vertex == 0) out[a.node] += force[a.rod].back();
      }
    return out;
  }

  /// The sum of the forces between the ends of a span.
  Point<Space> inside(const Span<Space>& span, const VertexForces<Space>& force) const {
    Point<Space> sum = Point<Space>::Zero();
    for (int j = span.first + 1; j < span.last; ++j) sum += force[span.rod][j];
    return sum;
  }

  /// What these forces tell of f of theory (13), the force in the first edge of every span: zero
  /// where nothing is told. Linear in the forces.
  std::vector<Point<Space>> known_forces(const VertexForces<Space>& force, double own = 1) const {
    std::vector<Point<Space>> known(cut_.spans.size(), Point<Space>::Zero()), loads;
    const auto node_force = on_nodes(force, own);
    for (const auto& span : cut_.spans) loads.push_back(inside(span, force));
    for (const auto& step : steps_) {
      Point<Space> balance = -node_force[step.node];
      for (const auto& [s, end] : cut_.spans_at[step.node])
        balance += end ? Point<Space>(known[s] - loads[s]) : Point<Space>(-known[s]);
      known[step.span] += step.solve * balance;
    }
    return known;
  }

  /// The position of the node follows from that of others.
  bool derived(int node) const { return derived_[node]; }

  /// One step of telling forces: Σ n − P = 0 at the node, solved for the span's force.
  struct Step {
    int node, span;
    Mat<dim> solve;
  };
  /// In the order in which they tell.
  const std::vector<Step>& steps() const { return steps_; }

 private:
  using D = Directions<dim>;

  /// Parts that nothing holds along a direction stay where they are, if what acts on them balances.
  void hold_drifting_parts() {
    const auto part = parts();
    const auto dead = dead_forces();
    const auto node_force = on_nodes(dead);
    const int count = 1 + *std::max_element(part.begin(), part.end());
    for (int p = 0; p < count; ++p) {
      D drift = Mat<dim>::Identity();
      int first = -1;
      Point<Space> sum = Point<Space>::Zero();
      double size = 0;
      const auto act = [&](const Point<Space>& F) { sum += F, size += F.norm(); };
      for (std::size_t v = 0; v < cut_.network.nodes.size(); ++v) {
        if (part[v] != p) continue;
        if (first < 0) first = int(v);
        act(node_force[v]);
        if (cut_.network.nodes[v].spring > 0) drift.resize(dim, 0);
        if (const D& free = cut_.network.nodes[v].free; free.cols() == 0)
          drift.resize(dim, 0);
        else if (drift.cols() > 0 && free.cols() < dim)
          drift = detail::without<dim>(drift, detail::without<dim>(Mat<dim>::Identity(), free));
      }
      if (drift.cols() == 0) continue;
      drifts_ = true;
      for (const auto& span : cut_.spans)
        if (part[span.start] == p) act(inside(span, dead));
      const Point<Space> unbalanced = drift * (drift.transpose() * sum);
      require(unbalanced.norm() <= 1e-9 * size,
              "supports: nothing holds the rods against the force (", unbalanced.transpose(),
              "); hold a point of them, or let the loads balance");
      auto& node = cut_.network.nodes[first];
      node.free = detail::without<dim>(node.free, drift);
    }
  }

  /// A number for each node: the same for nodes that rods connect.
  std::vector<int> parts() const {
    std::vector<int> of(cut_.network.nodes.size());
    std::iota(of.begin(), of.end(), 0);
    const auto root = [&](int v) {
      while (of[v] != v) v = of[v] = of[of[v]];
      return v;
    };
    for (const auto& span : cut_.spans) of[root(span.start)] = root(span.end);
    std::vector<int> name(of.size(), -1), out;
    int count = 0;
    for (int v = 0; v < int(of.size()); ++v) {
      int& n = name[root(v)];
      if (n < 0) n = count++;
      out.push_back(n);
    }
    return out;
  }

  /// Forces that the loads tell: from the free ends inwards, until nothing more can be told.
  void strip_known_forces() {
    derived_.assign(cut_.network.nodes.size(), false);
    const auto part = parts();
    std::vector<int> left(cut_.network.nodes.size(), 0);  // of each part, which needs one of them
    for (const int p : part) ++left[p];
    std::vector<int> todo(cut_.network.nodes.size());
    std::iota(todo.begin(), todo.end(), 0);
    while (!todo.empty()) {
      const int v = todo.back();
      todo.pop_back();
      const int p = the_open_span(v);
      if (derived_[v] || p < 0 || cut_.network.nodes[v].free.cols() == 0 ||
          cut_.network.nodes[v].spring > 0 || left[part[v]] == 1)
        continue;
      if (!solve_at(v, p)) continue;
      derived_[v] = true;
      --left[part[v]];
      todo.push_back(cut_.spans[p].start);
      todo.push_back(cut_.spans[p].end);
    }
  }

  /// The one span at the node whose force is not known, −1 if there is none or several.
  int the_open_span(int v) const {
    int found = -1;
    for (const auto& [p, end] : cut_.spans_at[v]) {
      if (cut_.spans[p].open.cols() == 0) continue;
      if (found >= 0) return -1;
      found = p;
    }
    return found;
  }

  /// Tells the force of span p along the free directions F of node v: Fᵀ(Σ n − P) = 0, theory (16).
  bool solve_at(int v, int p) {
    Span<Space>& span = cut_.spans[p];
    const D& F = cut_.network.nodes[v].free;
    const double sign = span.end == v ? -1 : 1;
    if (F.cols() == dim && span.open.cols() == dim) {  // all directions, whatever their axes
      steps_.push_back({v, p, sign * Mat<dim>::Identity()});
      span.open.resize(dim, 0);
      return true;
    }
    const Eigen::MatrixXd M = F.transpose() * span.open;
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> qr(M);
    qr.setThreshold(1e-9);
    if (qr.rank() < F.cols()) return false;
    steps_.push_back({v, p, sign * span.open * qr.solve(Eigen::MatrixXd(F.transpose()))});
    span.open = detail::kernel_within<dim>(span.open, F.transpose());
    return true;
  }

  Spans<Space> cut_;
  std::vector<char> derived_;
  std::vector<Step> steps_;
  bool drifts_ = false;  ///< a part that nothing holds along some direction
};

}  // namespace pyrod
