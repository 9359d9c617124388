// SPDX-License-Identifier: BSD-3-Clause
/// \file What the unknowns of a network are measured by.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/network_loads.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace pyrod {

template <class Space>
class NetworkScales {
 public:
  using State = NetworkState<Space>;
  using Acting = typename NetworkLoads<Space>::Acting;
  static constexpr int dim = Space::dim, spin = Space::spin;

  explicit NetworkScales(const Layout<Space>& layout) : layout_(layout), net_(layout.network()) {
    weigh_rows();
    find_units();
    find_softness();
  }

  /// Share of each unknown in the length of the rods; zero for multipliers.
  const Vector& weights() const { return weights_; }
  /// EI/L of the rod of each frame, of the softest rod at a node, and of the span of a multiplier.
  const Vector& units() const { return units_; }
  /// What the bending of each frame's own rod gives it; zero for multipliers.
  const Vector& stiffness() const { return stiffness_; }
  /// Where a span can neither stretch nor shear, and for rounding elsewhere.
  const Vector& softness() const { return softness_; }
  /// 1 + n L²/EI of the spans, in the rows of their multipliers.
  void multiplier_sizes(const State& x, const Acting& now, Vector& out) const {
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const int b = layout_.spans()[p].block; b >= 0)
        out.segment(layout_.row(b), layout_.sizes()[b]).setConstant(1 + force_size(x, now, p));
    for_each_tendon_row([&](int k, int i) {
      const double T = x.tensions.empty() ? 0 : x.tensions[std::size_t(i)];
      out[k] = 1 + std::abs(T) / layout_.unit_tension(i);
    });
  }

  /// Turns carry errors of a few ulp, which the stiffest cell and the force make moments of; a
  /// span's reach is the sum of its edges, whose errors add up at random.
  void rounding(const State& x, const Acting& now, Vector& out) const {
    constexpr double ε = 16 * std::numeric_limits<double>::epsilon();
    out.resize(weights_.size());
    double most = 0;
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      const double n = force_size(x, now, p), unit = layout_.span_moment(p);
      const int edges = span.last - span.first;
      const double row = ε * (stiffest_[span.rod] + unit * n / (4 * edges));
      most = std::max(most, row);
      const int apart = layout_.apart(p);
      out.segment(layout_.frame_row(layout_.first_edge(p) + apart), spin * (edges - apart))
          .setConstant(row);
      if (span.block >= 0)
        out.segment(layout_.row(span.block), layout_.sizes()[span.block])
            .setConstant(ε * unit * (1 + std::sqrt(edges) / 8));
    }
    for (int k = layout_.row(layout_.first_node_block()); k < layout_.unknowns(); ++k)
      out[k] = most;
    for_each_tendon_row([&](int k, int i) {
      const auto& grid = net_.rods[net_.tendons[i].rod].grid;
      out[k] = ε * layout_.unit_tension(i) * grid.length() * (1 + std::sqrt(grid.edges()) / 8);
    });
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const int e = layout_.first_edge(p); layout_.apart(p))
        out.segment<spin>(layout_.frame_row(e)) = out.segment<spin>(layout_.frame_row(e + 1));
  }

 private:
  /// visit(row, number of the tendon) for those whose tension is unknown.
  template <class Visit>
  void for_each_tendon_row(const Visit& visit) const {
    for (int i = 0; i < int(net_.tendons.size()); ++i)
      if (const int b = layout_.tendon_block(i); b >= 0) visit(layout_.row(b), i);
  }

  void weigh_rows() {
    double length = 0;
    for (const auto& rod : net_.rods) length += rod.grid.length();
    weights_ = Vector::Zero(layout_.unknowns());
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (int j = 0; j < net_.rods[rod].edges(); ++j)
        weights_.segment<spin>(layout_.frame_row(layout_.edge(rod, j)))
            .setConstant(net_.rods[rod].grid.h(j) / length);
    const double least = weights_.sum() / double(spin * layout_.edges());
    for (int i = 0; i < layout_.hinges(); ++i)
      weights_[layout_.row(layout_.hinge_block(i))] = least;
    for (int v = 0; v < int(net_.nodes.size()); ++v)
      for (const int b : {layout_.turn_block(v), layout_.place_block(v)})
        if (b >= 0) weights_.segment(layout_.row(b), layout_.sizes()[b]).setConstant(least);
  }

  void find_units() {
    units_ = Vector::Constant(layout_.unknowns(), layout_.unit_moment());
    stiffness_ = Vector::Zero(layout_.unknowns());
    std::vector<double> at_node(net_.nodes.size(), std::numeric_limits<double>::infinity());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      const double unit = layout_.rod_moment(span.rod);
      const auto& grid = net_.rods[span.rod].grid;
      for (int j = span.first; j < span.last; ++j) {
        const int row = layout_.frame_row(layout_.edge(span.rod, j));
        units_.segment<spin>(row).setConstant(unit);
        stiffness_.segment<spin>(row).setConstant(unit * grid.h(j) / grid.length());
      }
      if (span.block >= 0)
        units_.segment(layout_.row(span.block), layout_.sizes()[span.block])
            .setConstant(layout_.span_moment(p));
      for (const int v : {span.start, span.end}) at_node[v] = std::min(at_node[v], unit);
    }
    const double share = weights_.sum() / double(spin * layout_.edges());
    const auto set = [&](int block, int v) {
      if (block < 0 || !std::isfinite(at_node[v])) return;
      units_.segment(layout_.row(block), layout_.sizes()[block]).setConstant(at_node[v]);
    };
    for (int v = 0; v < int(net_.nodes.size()); ++v)
      set(layout_.turn_block(v), v), set(layout_.place_block(v), v);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod))
        if (a.hinge) set(layout_.hinge_block(a.hinge_number), a.node);
    for_each_tendon_row([&](int k, int i) { units_[k] = layout_.rod_moment(net_.tendons[i].rod); });
    for (int k = layout_.row(layout_.first_node_block()); k < layout_.unknowns(); ++k)
      if (stiffness_[k] == 0 && weights_[k] > 0)
        stiffness_[k] = share * units_[k];  // else it is a frame's
  }

  /// A span that gives way along itself needs none. One that does not can be straight, so that to
  /// first order nothing gives.
  void find_softness() {
    softness_ = Vector::Zero(layout_.unknowns());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      if (span.block < 0) continue;
      const auto& rod = net_.rods[span.rod];
      double give = 0;
      for (int j = span.first; j < span.last; ++j)
        give += rod.grid.h(j) / rod.stretching[j][dim - 1];
      const double unit = layout_.span_moment(p), force = layout_.unit_force(p);
      const bool gives = give * force * force >= 1e-14 * unit;
      softness_.segment(layout_.row(span.block), layout_.sizes()[span.block])
          .setConstant(gives ? 0 : 1e-10 * unit);
    }
    for_each_tendon_row([&](int k, int i) {  // several that do not stretch may hold the same
      if (net_.tendons[i].softness == 0) softness_[k] = 1e-10 * units_[k];
    });
    stiffest_.assign(net_.rods.size(), 0);
    for (std::size_t i = 0; i < net_.rods.size(); ++i)
      for (int j = 0; j < int(net_.rods[i].bending.size()); ++j)
        stiffest_[i] =
            std::max(stiffest_[i], net_.rods[i].bending[j].maxCoeff() / net_.rods[i].grid.Δs(j));
  }

  /// The largest section force of a span over its unit.
  double force_size(const State& x, const Acting& now, int p) const {
    const Point<Space> first = x.forces[p] + now.known[layout_.first_edge(p)],
                       last = x.forces[p] + now.known[layout_.last_edge(p)];
    return std::max(first.norm(), last.norm()) / layout_.unit_force(p);
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  Vector weights_, units_, stiffness_, softness_;
  std::vector<double> stiffest_;  ///< of the cells of each rod [N m]
};

}  // namespace pyrod
