// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibrium of a network as a problem for the solver.
///
/// Unknown are the frames of the edges, what is not known of the section forces of the spans, and
/// the frames and positions of nodes where they are needed (docs/theory.md, "Networks").
#pragma once

#include <pyrod/statics/network_cells.hpp>
#include <pyrod/statics/section_force.hpp>

namespace pyrod {

template <class Space>
class NetworkEquilibrium : public NetworkCells<Space> {
 public:
  using Base = NetworkCells<Space>;
  using Base::dim, Base::spin, Base::forces;
  using typename Base::Rotation, typename Base::State, typename Base::Forces;
  using typename Base::Storage;

  explicit NetworkEquilibrium(const Layout<Space>& layout) : Base(layout) { weigh_rows(); }

  Storage linearisation() const {
    BlockSymmetric H(layout_.sizes(), layout_.above());
    const int size = H.size();
    return {0, 0, Vector::Zero(size), std::move(H)};
  }

  void linearise(const State& x, Curvature curvature, Storage& out) const {
    if (curvature == Curvature::exact)
      linearise<Curvature::exact>(x, out);
    else
      linearise<Curvature::convex>(x, out);
  }

  void move(const State& x, const Vector& δ, State& out) const {
    out = x;
    for (int j = 0; j < int(x.frames.size()); ++j)
      out.frames[j] =
          moved(x.frames[j], Spin<Space>(δ.segment<spin>(first_[layout_.frame_block(j)])));
    for (int p = 0; p < int(x.forces.size()); ++p)
      if (const auto& span = layout_.spans()[p]; span.block >= 0)
        out.forces[p] += span.open * δ.segment(first_[span.block], span.open.cols());
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
  double unit_energy() const { return layout_.unit_moment(); }
  /// Turns carry errors of a few ulp, and the stiffest cell makes moments of them.
  double rounding() const {
    double stiffest = 0;
    for (const auto& rod : net_.rods)
      for (int j = 0; j < int(rod.bending.size()); ++j)
        stiffest = std::max(stiffest, rod.bending[j].maxCoeff() / rod.grid.Δs(j));
    return 16 * std::numeric_limits<double>::epsilon() * stiffest;
  }

 private:
  using Base::add_energy;
  using Base::following_couples_, Base::node_moment_, Base::node_following_;
  using Base::layout_, Base::net_, Base::compliance_, Base::first_, Base::edge_couples_;
  using Mixed = Eigen::Matrix<double, spin, Eigen::Dynamic,
                              spin == 1 ? Eigen::RowMajor : Eigen::ColMajor, spin, dim>;

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

  template <Curvature kind>
  void linearise(const State& x, Storage& out) const {
    out.energy = out.magnitude = 0;
    out.gradient.setZero();
    out.hessian.set_zero();
    const Forces now = forces(x);
    for (int p = 0; p < int(layout_.spans().size()); ++p) add_span<kind>(x, now.sections, p, out);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod)) this->template add_attached<kind>(x, a, out);
    for (int v = 0; v < int(net_.nodes.size()); ++v) add_node<kind>(x, now, v, out);
    for (const auto& [edge, m] : edge_couples_)
      add_couple(x.frames[edge], m, first_[layout_.frame_block(edge)], out);
    for (const auto& [edge, m] : following_couples_)
      out.gradient.template segment<spin>(first_[layout_.frame_block(edge)]) -= m;
  }

  template <Curvature kind>
  [[gnu::flatten]] void add_span(const State& x, const std::vector<Point<Space>>& n, int p,
                                 Storage& out) const {
    const auto& span = layout_.spans()[p];
    const auto& rod = net_.rods[span.rod];
    for (int j = span.first + 1; j < span.last; ++j)
      this->template add_turn<kind>(x, layout_.edge(span.rod, j - 1), layout_.edge(span.rod, j),
                                    rod, j, rod.grid.Δs(j), out);
    Point<Space> reach = Point<Space>::Zero();  // Σ h R Γ
    Mat<dim> give = Mat<dim>::Zero();           // Σ h R S Rᵀ
    for (int j = span.first; j < span.last; ++j) {
      const int e = layout_.edge(span.rod, j), b = layout_.frame_block(e);
      const auto jet = section_force_term<kind, Space, Cosserat>(x.frames[e], n[e], compliance_[e],
                                                                 rod.grid.h(j));
      out.energy += jet.energy;
      out.magnitude += std::abs(jet.energy);
      out.gradient.template segment<spin>(first_[b]) += jet.gradient;
      out.hessian.add_diagonal(b, jet.hessian);
      if (span.block >= 0) add_reach(x.frames[e], n[e], e, rod.grid.h(j), span, reach, give, out);
    }
    if (span.block < 0) return;
    const Point<Space> gap = x.positions[span.end] - x.positions[span.start] - reach;
    out.gradient.segment(first_[span.block], span.open.cols()) += span.open.transpose() * gap;
    out.hessian.add_diagonal(span.block,
                             Eigen::MatrixXd(-span.open.transpose() * give * span.open));
    const Point<Space> f = x.forces[p];
    out.energy += f.dot(x.positions[span.end] - x.positions[span.start]);
  }

  /// How the end of the span moves with the frame of an edge, and with the force in it.
  void add_reach(const Rotation& q, const Point<Space>& n, int e, double h, const Span<Space>& span,
                 Point<Space>& reach, Mat<dim>& give, Storage& out) const {
    const Point<Space> S = compliance_[e].diagonal(), b = unrotate(q, n);
    const Point<Space> Γ = axis<Space>() + S.cwiseProduct(b);
    reach += h * rotate(q, Γ);
    Mat<spin, dim> by_force;
    Mat<dim> RSRt;
    for (int i = 0; i < dim; ++i) {
      const Point<Space> db = unrotate(q, Point<Space>::Unit(i)), dΓ = S.cwiseProduct(db);
      by_force.col(i) = h * (cross(db, Γ) + cross(b, dΓ));
      RSRt.col(i) = rotate(q, dΓ);
    }
    give += h * RSRt;
    out.hessian.add(layout_.frame_block(e), span.block, Mixed(by_force * span.open));
  }

  template <Curvature kind>
  void add_node(const State& x, const Forces& now, int v, Storage& out) const {
    const auto& node = net_.nodes[v];
    if (const int b = layout_.place_block(v); b >= 0) add_place(x, now, v, b, out);
    const int b = layout_.turn_block(v);
    if (b < 0) return;
    if (node.torsion_spring > 0) {
      const Spin<Space> u = log(principal(node.frame.conjugate() * x.node_frames[v]));
      const Spin<Space> C = Spin<Space>::Constant(node.torsion_spring);
      const auto jet = bend_twist<kind>(u, typename Space::Differential(u), C,
                                        Spin<Space>(Spin<Space>::Zero()), 1.);
      add_energy(jet.energy, out);
      out.gradient.segment(first_[b], node.turns.cols()) += node.turns.transpose() * jet.b;
      out.hessian.add_diagonal(b, Eigen::MatrixXd(node.turns.transpose() * jet.bb * node.turns));
    }
    out.gradient.segment(first_[b], node.turns.cols()) -=
        node.turns.transpose() *
        (rotate_spin(x.node_frames[v].conjugate(), node_moment_[v]) + node_following_[v]);
    if constexpr (spin == 1) out.energy -= node_moment_[v][0] * x.node_frames[v].radians;
  }

  /// Balance of forces at a node: Σ n of the spans that end there − Σ n of those that start there
  /// − what acts on it.
  void add_place(const State& x, const Forces& now, int v, int b, Storage& out) const {
    const auto& node = net_.nodes[v];
    const Point<Space>& load = now.nodes[v];
    Point<Space> told = -load,
                 asked = Point<Space>::Zero();  // what is known of the balance, or not
    for (const auto& [p, end] : layout_.spans_at(v)) {
      const auto& span = layout_.spans()[p];
      const double sign = end ? 1 : -1;
      const Point<Space>& n =
          now.sections[layout_.edge(span.rod, end ? span.last - 1 : span.first)];
      told += sign * (n - x.forces[p]);
      asked += sign * x.forces[p];
      if (span.block >= 0)
        out.hessian.add(span.block, b, Eigen::MatrixXd(sign * span.open.transpose() * node.free));
    }
    const Point<Space> stretch = x.positions[v] - node.position;
    add_energy(node.spring * stretch.squaredNorm() / 2 + told.dot(x.positions[v]), out);
    out.gradient.segment(first_[b], node.free.cols()) +=
        node.free.transpose() * (told + asked + node.spring * stretch);
    out.hessian.add_diagonal(b, Eigen::MatrixXd(node.spring * node.free.transpose() * node.free));
  }

  void add_couple(const Rotation& q, const Spin<Space>& m, int first, Storage& out) const {
    out.gradient.template segment<spin>(first) -= rotate_spin(q.conjugate(), m);
    if constexpr (spin == 1) out.energy -= m[0] * q.radians;
  }

  Vector weights_;
};

}  // namespace pyrod
