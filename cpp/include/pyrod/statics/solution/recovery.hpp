// SPDX-License-Identifier: BSD-3-Clause
/// \file From the unknowns of a network to all that there is to know of its rods and nodes.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/equations/network_terms.hpp>
#include <pyrod/statics/solution/backbone.hpp>
#include <pyrod/statics/solution/edges_of_span.hpp>
#include <pyrod/statics/solution/extremes.hpp>
#include <pyrod/statics/solution/half_cells.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/solution/vertices.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace pyrod {

/// Of every `stride`-th vertex, and of the centre between two such: an edge if the stride is one,
/// else a vertex, so that another stride must be even, and nodes may be at such vertices only. Sums
/// go over all; with a stride, the moments of the forces are part of `load_moment`, about the
/// origin.
template <class Space>
class Recovery {
 public:
  using Rotation = typename Space::Rotation;

  /// `from_moments`: where there are tendons, too, K is told by moments as in theory (21).
  Recovery(const NetworkProblem<Space>& problem, const NetworkState<Space>& x, int stride = 1,
           bool from_moments = false)
      : problem_(problem),
        layout_(problem.layout()),
        net_(layout_.network()),
        terms_(problem.terms(x)),
        x_(x),
        acting_(problem.acting(x, changed_)),
        sections_(problem.sections(x, acting_)),
        stride_(stride),
        from_moments_(from_moments) {}

  /// Fills in the rods and the nodes.
  void fill(Solution<Space>& out);

 private:
  bool keeps(int vertex) const { return vertex % stride_ == 0; }

  /// Frames, curvatures and moments; positions come later.
  void begin(int rod, RodSolution<Space>& s) {
    const auto& r = net_.rods[rod];
    const auto frames = x_.frames.begin() + layout_.edge(rod, 0);
    s.curve.frames.assign(frames, frames + r.edges());
    HalfCells<Space> held(layout_, terms_, x_, rod);
    held.end_frames(s.curve);
    const auto vertices = std::size_t(r.grid.vertices()), kept = (vertices - 1) / stride_ + 1;
    const auto points = std::size_t(r.edges() / stride_) + 1;
    s.strains.K.reserve(kept), s.moment.reserve(kept), s.material_moment.reserve(kept);
    s.curve.positions.assign(points, Point<Space>::Zero());
    s.strains.Γ.resize(points - 1), s.force.resize(points - 1);
    if (stride_ == 1) s.material_force.resize(points - 1);
    extremes_.emplace_back(r);
    for (int j = 0; j < r.grid.vertices(); ++j) {
      if (const auto* a = held.inside(j))
        add_halves(s, held.cell(j, *a, s.curve));
      else
        add_cell(s, rod, j);
    }
    if (!terms_.none(rod)) measure_tendons(rod, s.curve);
    s.load_moment = load_moment(rod, s.curve);
  }

  void add_cell(RodSolution<Space>& s, int rod, int j) {
    const auto& r = net_.rods[rod];
    const double Δs = r.grid.Δs(j);
    const Spin<Space> u = turn(s.curve, j), ΔK = u / Δs - r.K0[j],
                      M = r.bending[j].cwiseProduct(ΔK);
    s.bend_twist_energy += Δs * ΔK.dot(M) / 2;
    Spin<Space> others = Spin<Space>::Zero();
    if (!terms_.none(rod))
      others = terms_
                   .at(rod, j,
                       j == 0           ? CellKind::behind
                       : j == r.edges() ? CellKind::before
                                        : CellKind::whole,
                       u)
                   .m;
    extremes_.back().add_cell(u, M, others);
    if (!keeps(j)) return;
    s.strains.K.push_back(u / Δs);
    s.material_moment.push_back(M);
    Spin<Space> transmitted = transmitted_moment<Space>(u, r.bending[j], r.K0[j], Δs);
    if (!terms_.none(rod)) transmitted += typename Space::Differential(u).T() * others;
    s.moment.push_back(rotate_spin(s.curve.frame_before(j), transmitted));
  }

  /// Cell by cell.
  void measure_tendons(int rod, const CosseratCurve<Space>& curve) {
    tendons_.resize(net_.tendons.size());
    const auto add = [&](int j, CellKind kind, const Spin<Space>& u) {
      terms_.for_each_tendon(rod, j, kind, u, [&](int i, double T, const auto& length) {
        auto& tendon = tendons_[std::size_t(i)];
        tendon.tension = T, tendon.length += length.length;
        tendon.slack = TendonRows<Space>::is_slack(x_, i);
      });
    };
    for_each_cell(layout_, rod, [&](int j, CellKind kind, const Attachment<Space>* a) {
      add(j, kind, turn_of_cell(layout_, x_, rod, j, kind, a));
    });
    const int n = net_.rods[rod].edges();
    if (!layout_.attached(rod).front().rigid) add(0, CellKind::behind, turn(curve, 0));
    if (!layout_.attached(rod).back().rigid) add(n, CellKind::before, turn(curve, n));
  }

  void add_halves(RodSolution<Space>& s, const HalvedCell<Space>& cell) {
    s.bend_twist_energy += cell.energy;
    extremes_.back().add_cell(cell.turn, cell.material_moment);
    s.strains.K.push_back(cell.K);
    s.material_moment.push_back(cell.material_moment);
    s.moment.push_back(cell.moment_behind);
    before_.push_back(cell);
  }

  Spin<Space> load_moment(int rod, const CosseratCurve<Space>& curve) const {
    const auto& loads = net_.loads[rod];
    Spin<Space> sum =
        loads.total_moment() + rotate_spin(curve.end_frame, loads.follower_end_moment);
    for (const auto& c : loads.follower_moments) sum += rotate_spin(curve.frames[c.edge], c.moment);
    for (const auto& a : layout_.attached(rod))
      for (const auto& c : loads.vertex_moments)
        if (c.on_node && c.vertex == a.vertex)
          sum += c.follows ? rotate_spin(held_frame(x_, a), c.moment) : c.moment;
    return sum;
  }

  /// Span by span, from nodes whose position is known to those that it tells.
  void place(Solution<Space>& out) {
    const auto& spans = layout_.spans();
    std::vector<char> known(net_.nodes.size()), done(spans.size(), false);
    for (int v = 0; v < int(known.size()); ++v) {
      known[v] = !layout_.derived(v);
      const Point<Space> r = known[v] ? x_.positions[v] : Point<Space>(Point<Space>::Zero());
      out.nodes.push_back({r, Point<Space>::Zero(), x_.node_frames[v], Spin<Space>::Zero()});
    }
    for (bool more = true; more;) {
      more = false;
      for (std::size_t p = 0; p < spans.size(); ++p) {
        if (done[p] || !(known[spans[p].start] || known[spans[p].end])) continue;
        place(spans[p], known[spans[p].start], out);
        known[spans[p].start] = known[spans[p].end] = done[p] = more = true;
      }
    }
  }

  void place(const Span<Space>& span, bool forwards, Solution<Space>& out) {
    auto &start = out.nodes[span.start].position, &end = out.nodes[span.end].position;
    EdgesOfSpan<Space> edges(problem_, span, stride_, acting_.vertices[span.rod], sections_);
    edges.fill(out.rods[span.rod], forwards ? &start : nullptr, end, extremes_[span.rod]);
    if (!forwards)
      start = edges.start();
    else if (layout_.derived(span.end))
      end = edges.end();
  }

  /// What the supports exert: all that acts on a node adds up to zero with it.
  void react(Solution<Space>& out) const {
    for (int v = 0; v < int(net_.nodes.size()); ++v) {
      Point<Space> sum = acting_.nodes[v];
      for (const auto& [p, end] : layout_.spans_at(v)) {
        if (end)
          sum -= sections_[layout_.last_edge(p)];
        else
          sum += sections_[layout_.first_edge(p)];
      }
      out.nodes[v].reaction_force = -sum;
      out.nodes[v].reaction_moment =
          -(net_.nodes[v].moment + rotate_spin(out.nodes[v].frame, net_.nodes[v].follower_moment));
    }
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod))
        if (a.rigid) react(rod, a, out);
  }

  void react(int rod, const Attachment<Space>& a, Solution<Space>& out) const {
    auto& m = out.nodes[a.node].reaction_moment;
    const auto& moment = out.rods[rod].moment;
    const auto& loads = net_.loads[rod];
    const int n = net_.rods[rod].edges();
    const bool closed = net_.rods[rod].grid.closed();
    if (!closed && a.vertex == n) {
      m += moment.back() - loads.end_moment -
           rotate_spin(held_frame(x_, a), loads.follower_end_moment);
      return;
    }
    m -= moment[a.vertex / stride_];
    if (!closed && a.vertex == 0)
      m -= loads.start_moment;
    else
      m += before(rod, a.vertex);
  }

  /// What the half cell before a held vertex exerts.
  const Spin<Space>& before(int rod, int vertex) const {
    const auto number = [](const auto& cell) { return std::pair(cell.rod, cell.vertex); };
    return std::ranges::lower_bound(before_, std::pair(rod, vertex), {}, number)->moment_before;
  }

  /// What vertices say, when reactions have been told from what the halves of their cells exert.
  void finish(int rod, RodSolution<Space>& s) {
    const auto& r = net_.rods[rod];
    s.load = lumped(acting_.vertices[rod], stride_);
    if (r.grid.closed()) {
      s.curve.positions.pop_back();
      return;
    }
    std::vector<HeldVertex<Space>> on;
    for (const auto& a : layout_.attached(rod)) {
      if (a.vertex == 0 || a.vertex == r.edges()) continue;
      on.push_back({a.vertex});
      if (a.rigid)
        on.back().frame = held_frame(x_, a), on.back().moment_before = before(rod, a.vertex);
    }
    const std::span force(sections_.data() + layout_.edge(rod, 0), std::size_t(r.edges()));
    const auto& loads = net_.loads[rod];
    Vertices<Space>(r, loads, std::move(on), stride_).see(s, force);
    if (!terms_.none(rod)) tell_tendons(rod, s);
    s.largest = extremes_[rod].largest(s, stride_);
    if (stride_ > 1) s.curve.frames = centre_frames(r.grid, s.curve, stride_);
  }

  void tell_tendons(int rod, RodSolution<Space>& s) {
    const Backbone<Space> backbone(terms_, net_.rods[rod], rod, stride_);
    backbone.tell(s, from_moments_);
    for (int i = 0; i < int(net_.tendons.size()); ++i)
      if (const auto& tendon = net_.tendons[std::size_t(i)]; tendon.rod == rod)
        tendons_[std::size_t(i)].force_on_base = backbone.pull(s, i, tendon.first);
  }

  const NetworkProblem<Space>& problem_;
  const Layout<Space>& layout_;
  const Network<Space>& net_;
  CellTerms<Space> terms_;
  const NetworkState<Space>& x_;
  typename NetworkProblem<Space>::Acting changed_;
  const typename NetworkProblem<Space>::Acting& acting_;
  std::vector<Point<Space>> sections_;  ///< n on all edges
  int stride_;
  bool from_moments_;
  std::vector<TendonSolution<Space>> tendons_;
  std::vector<Extremes<Space>> extremes_;  ///< of each rod
  std::vector<HalvedCell<Space>> before_;  ///< rod by rod, along each
};

template <class Space>
void Recovery<Space>::fill(Solution<Space>& out) {
  const std::size_t rods = net_.rods.size();
  out.rods.clear(), out.nodes.clear();
  out.rods.resize(rods), out.nodes.reserve(net_.nodes.size()), extremes_.reserve(rods);
  for (std::size_t rod = 0; rod < rods; ++rod) begin(int(rod), out.rods[rod]);
  place(out);
  react(out);
  for (std::size_t rod = 0; rod < rods; ++rod) finish(int(rod), out.rods[rod]);
  out.tendons = std::move(tendons_);
}

}  // namespace pyrod
