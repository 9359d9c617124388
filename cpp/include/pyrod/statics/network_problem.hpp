// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibrium of a network as a problem for the solver.
///
/// Unknown are the frames of the edges, what is not known of the section forces of the spans, and
/// the frames and positions of nodes where they are needed (docs/theory.md, "Networks").
#pragma once

#include <pyrod/statics/network_spans.hpp>

namespace pyrod {

template <class Space>
class NetworkProblem : public NetworkSpans<Space> {
 public:
  using Base = NetworkSpans<Space>;
  using Base::dim, Base::spin, Base::first_row, Base::forces;
  using typename Base::Rotation, typename Base::State, typename Base::Storage;

  explicit NetworkProblem(const Layout<Space>& layout) : Base(layout) {
    weigh_rows();
    find_units();
    find_softness();
  }

  Storage linearisation() const {
    BlockSymmetric H(layout_.sizes(), layout_.above());
    const int size = H.size();
    return {0, 0, Vector::Zero(size), std::move(H)};
  }

  bool fits(const Storage& made) const {
    return made.hessian.has(layout_.sizes(), layout_.above());
  }

  void linearise(const State& x, Curvature curvature, Storage& out) const {
    if (curvature == Curvature::exact)
      linearise<Curvature::exact>(x, out);
    else
      linearise<Curvature::convex>(x, out);
  }

  void move(const State& x, const Vector& δ, State& out) const {
    out.frames.resize(x.frames.size());
    out.forces = x.forces;
    out.hinge_angles = x.hinge_angles;
    out.node_frames = x.node_frames;
    out.positions = x.positions;
    for (int p = 0; p < int(x.forces.size()); ++p) {
      const auto& span = layout_.spans()[p];
      const int e = layout_.edge(span.rod, span.first), edges = span.last - span.first;
      dispatch(MoveFrames<Space>{edges, x.frames.data() + e, δ.data() + first_row(e),
                                 out.frames.data() + e});
      if (span.block >= 0)
        out.forces[p] += span.open * δ.segment(first_[span.block], span.open.cols());
    }
    for (int i = 0; i < layout_.hinges(); ++i)
      out.hinge_angles[i] += δ[first_[layout_.hinge_block(i)]];
    for (int v = 0; v < int(net_.nodes.size()); ++v) {
      const auto& node = net_.nodes[v];
      if (const int b = layout_.turn_block(v); b >= 0)
        out.node_frames[v] = moved(
            x.node_frames[v], Spin<Space>(node.turns * δ.segment(first_[b], node.turns.cols())));
      if (const int b = layout_.place_block(v); b >= 0)
        out.positions[v] += node.free * δ.segment(first_[b], node.free.cols());
    }
  }

  /// Share of each unknown in the length of the rods; zero for multipliers.
  const Vector& weights() const { return weights_; }
  /// EI/L of the rod of each frame, of the softest rod at a node, and of the span of a multiplier.
  const Vector& units() const { return units_; }
  /// What the bending of each frame's own rod gives it; zero for multipliers.
  const Vector& stiffness() const { return stiffness_; }
  /// Where a span can neither stretch nor shear, and for rounding elsewhere.
  const Vector& softness() const { return softness_; }
  double unit_energy() const { return layout_.unit_moment(); }

  /// 1 + n L²/EI of the spans, in the rows of their multipliers.
  void multiplier_sizes(const State& x, Vector& out) const {
    Acting changed;
    const Acting& now = acting(x, changed);
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      if (const int b = layout_.spans()[p].block; b >= 0)
        out.segment(first_[b], layout_.sizes()[b]).setConstant(1 + force_size(x, now, p));
  }

  /// Turns carry errors of a few ulp, which the stiffest cell and the force make moments of; a
  /// span's reach is the sum of its edges, whose errors add up at random.
  void rounding(const State& x, Vector& out) const {
    constexpr double ε = 16 * std::numeric_limits<double>::epsilon();
    out.resize(weights_.size());
    Acting changed;
    const Acting& now = acting(x, changed);
    double most = 0;
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      const double n = force_size(x, now, p), unit = layout_.span_moment(p);
      const int edges = span.last - span.first;
      const double row = ε * (stiffest_[span.rod] + unit * n / (4 * edges));
      most = std::max(most, row);
      out.segment(first_row(layout_.edge(span.rod, span.first)), spin * edges).setConstant(row);
      if (span.block >= 0)
        out.segment(first_[span.block], layout_.sizes()[span.block])
            .setConstant(ε * unit * (1 + std::sqrt(edges) / 8));
    }
    for (int k = first_[layout_.first_node_block()]; k < first_.back(); ++k) out[k] = most;
  }

 private:
  using Base::acting, Base::add_energy, Base::add_to_rows;
  using Base::following_couples_, Base::node_moment_, Base::node_following_;
  using Base::layout_, Base::net_, Base::first_, Base::edge_couples_;
  using typename Base::Acting;

  void weigh_rows() {
    double length = 0;
    for (const auto& rod : net_.rods) length += rod.grid.length();
    weights_ = Vector::Zero(first_.back());
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (int j = 0; j < net_.rods[rod].edges(); ++j)
        weights_.segment<spin>(first_[layout_.frame_block(layout_.edge(rod, j))])
            .setConstant(net_.rods[rod].grid.h(j) / length);
    const double least = weights_.sum() / double(spin * layout_.edges());
    for (int i = 0; i < layout_.hinges(); ++i) weights_[first_[layout_.hinge_block(i)]] = least;
    for (int v = 0; v < int(net_.nodes.size()); ++v)
      for (const int b : {layout_.turn_block(v), layout_.place_block(v)})
        if (b >= 0) weights_.segment(first_[b], layout_.sizes()[b]).setConstant(least);
  }

  void find_units() {
    units_ = Vector::Constant(first_.back(), layout_.unit_moment());
    stiffness_ = Vector::Zero(first_.back());
    std::vector<double> at_node(net_.nodes.size(), std::numeric_limits<double>::infinity());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      const double unit = layout_.rod_moment(span.rod);
      const auto& grid = net_.rods[span.rod].grid;
      for (int j = span.first; j < span.last; ++j) {
        const int row = first_row(layout_.edge(span.rod, j));
        units_.segment<spin>(row).setConstant(unit);
        stiffness_.segment<spin>(row).setConstant(unit * grid.h(j) / grid.length());
      }
      if (span.block >= 0)
        units_.segment(first_[span.block], layout_.sizes()[span.block])
            .setConstant(layout_.span_moment(p));
      for (const int v : {span.start, span.end}) at_node[v] = std::min(at_node[v], unit);
    }
    const double share = weights_.sum() / double(spin * layout_.edges());
    const auto set = [&](int block, int v) {
      if (block < 0 || !std::isfinite(at_node[v])) return;
      units_.segment(first_[block], layout_.sizes()[block]).setConstant(at_node[v]);
    };
    for (int v = 0; v < int(net_.nodes.size()); ++v)
      set(layout_.turn_block(v), v), set(layout_.place_block(v), v);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod))
        if (a.hinge) set(layout_.hinge_block(a.hinge_number), a.node);
    for (int k = first_[layout_.first_node_block()]; k < first_.back(); ++k)
      stiffness_[k] = share * units_[k];
  }

  /// A span that gives way along itself needs none. One that does not can be straight, so that to
  /// first order nothing gives.
  void find_softness() {
    softness_ = Vector::Zero(first_.back());
    for (int p = 0; p < int(layout_.spans().size()); ++p) {
      const auto& span = layout_.spans()[p];
      if (span.block < 0) continue;
      const auto& rod = net_.rods[span.rod];
      double give = 0;
      for (int j = span.first; j < span.last; ++j)
        give += rod.grid.h(j) / rod.stretching[j][dim - 1];
      const double unit = layout_.span_moment(p), force = layout_.unit_force(p);
      const bool gives = give * force * force >= 1e-14 * unit;
      softness_.segment(first_[span.block], layout_.sizes()[span.block])
          .setConstant(gives ? 0 : 1e-10 * unit);
    }
    stiffest_.assign(net_.rods.size(), 0);
    for (std::size_t i = 0; i < net_.rods.size(); ++i)
      for (int j = 0; j < int(net_.rods[i].bending.size()); ++j)
        stiffest_[i] =
            std::max(stiffest_[i], net_.rods[i].bending[j].maxCoeff() / net_.rods[i].grid.Δs(j));
  }

  /// The largest section force of a span over its unit.
  double force_size(const State& x, const Acting& now, int p) const {
    const Point<Space> first = x.forces[p] + now.told[this->first_edge(p)],
                       last = x.forces[p] + now.told[this->last_edge(p)];
    return std::max(first.norm(), last.norm()) / layout_.unit_force(p);
  }

  template <Curvature kind>
  void linearise(const State& x, Storage& out) const {
    out.energy = out.magnitude = 0;
    Acting changed;
    const Acting& now = acting(x, changed);
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      this->template set_span<kind>(x, now, p, out);
    const int nodes = first_[layout_.first_node_block()], end = first_.back();
    out.hessian.set_zero(nodes, end);
    out.gradient.tail(end - nodes).setZero();
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod)) this->template add_attached<kind>(x, a, out);
    for (int v = 0; v < int(net_.nodes.size()); ++v) add_node<kind>(x, now, v, out);
    for (const auto& [edge, m] : edge_couples_)
      add_couple(x.frames[edge], m, first_[layout_.frame_block(edge)], out);
    for (const auto& [edge, m] : following_couples_)
      out.gradient.template segment<spin>(first_[layout_.frame_block(edge)]) -= m;
  }

  template <Curvature kind>
  void add_node(const State& x, const Acting& now, int v, Storage& out) const {
    const auto& node = net_.nodes[v];
    if (const int b = layout_.place_block(v); b >= 0) add_place(x, now, v, b, out);
    const int b = layout_.turn_block(v);
    if (b < 0) return;
    const Mat<spin> T = Base::template padded<spin>(node.turns);
    if (node.torsion_spring > 0) {
      const Spin<Space> u = log(principal(node.frame.conjugate() * x.node_frames[v]));
      const Spin<Space> C = Spin<Space>::Constant(node.torsion_spring);
      const auto jet = bend_twist<kind>(u, typename Space::Differential(u), C,
                                        Spin<Space>(Spin<Space>::Zero()), 1.);
      add_energy(jet.energy, out);
      add_to_rows(b, Spin<Space>(T.transpose() * jet.b), out);
      out.hessian.add_diagonal(b, Mat<spin>(T.transpose() * jet.bb * T));
    }
    const Spin<Space> m =
        rotate_spin(x.node_frames[v].conjugate(), node_moment_[v]) + node_following_[v];
    add_to_rows(b, Spin<Space>(-T.transpose() * m), out);
    if constexpr (spin == 1) out.energy -= node_moment_[v][0] * x.node_frames[v].radians;
  }

  /// Balance of forces at a node: Σ n of the spans that end there − Σ n of those that start there
  /// − what acts on it.
  void add_place(const State& x, const Acting& now, int v, int b, Storage& out) const {
    const auto& node = net_.nodes[v];
    const Mat<dim> F = Base::template padded<dim>(node.free);
    Point<Space> told = -now.nodes[v],
                 asked = Point<Space>::Zero();  // what is known of the balance, or not
    for (const auto& [p, end] : layout_.spans_at(v)) {
      const auto& span = layout_.spans()[p];
      const double sign = end ? 1 : -1;
      told += sign * now.told[end ? this->last_edge(p) : this->first_edge(p)];
      asked += sign * x.forces[p];
      if (span.block >= 0) {
        const Mat<dim> C = Base::template padded<dim>(span.open);
        out.hessian.add(span.block, b, Mat<dim>(sign * C.transpose() * F));
      }
    }
    const Point<Space> stretch = x.positions[v] - node.position;
    add_energy(node.spring * stretch.squaredNorm() / 2 + told.dot(x.positions[v]), out);
    add_to_rows(b, Point<Space>(F.transpose() * (told + asked + node.spring * stretch)), out);
    out.hessian.add_diagonal(b, Mat<dim>(node.spring * F.transpose() * F));
  }

  void add_couple(const Rotation& q, const Spin<Space>& m, int first, Storage& out) const {
    out.gradient.template segment<spin>(first) -= rotate_spin(q.conjugate(), m);
    if constexpr (spin == 1) out.energy -= m[0] * q.radians;
  }

  Vector weights_, units_, stiffness_, softness_;
  std::vector<double> stiffest_;  ///< of the cells of each rod [N m]
};

}  // namespace pyrod
