// SPDX-License-Identifier: BSD-3-Clause
/// \file Equilibrium of a network as a problem for the solver.
///
/// Unknown are the frames of the edges, what is not known of the section forces of the spans, and
/// the frames and positions of nodes where they are needed (theory (15)).
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/differential.hpp>
#include <pyrod/rotation/frames.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/cell_terms.hpp>
#include <pyrod/statics/equations/network_cells.hpp>
#include <pyrod/statics/equations/network_scales.hpp>
#include <pyrod/statics/equations/network_skew.hpp>
#include <pyrod/statics/equations/network_slope.hpp>
#include <pyrod/statics/equations/network_spans.hpp>
#include <pyrod/statics/equations/network_terms.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
class NetworkProblem {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;
  using Storage = Linearisation<BlockSymmetric>;
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `layout` must stay where it is.
  explicit NetworkProblem(const Layout<Space>& layout);

  const Layout<Space>& layout() const { return layout_; }

  /// The loads of the layout have changed.
  void renew_loads() { loads_.renew(); }

  /// Lets only a part of all loads act, or of the forces and of the moments.
  void load(double part) { load(part, part); }
  void load(double forces, double moments) {
    loads_.load(forces, moments);
    terms_.load(forces);
  }
  /// Lets α times what acts in the one problem act together with β times what acts in the other,
  /// both of networks that have the same unknowns as this one; tendons stay as they are.
  void blend(const NetworkProblem& a, double α, const NetworkProblem& b, double β) {
    loads_.blend(a.loads_, α, b.loads_, β);
  }
  /// out = ∂g/∂t at x, as t times what acts in `rate` is added to what acts.
  void slope(const State& x, const NetworkProblem& rate, Vector& out) const {
    find_slope(layout_, columns_, loads_, rate.loads_, x, out);
  }

  bool conservative() const { return loads_.conservative(); }
  bool dead_loads() const { return !loads_.follow(); }

  using Acting = typename NetworkLoads<Space>::Acting;
  /// What acts at x: it is kept in `changed` if it is more than the dead loads.
  const Acting& acting(const State& x, Acting& changed) const { return loads_.acting(x, changed); }
  std::vector<Point<Space>> sections(const State& x, const Acting& now) const {
    return loads_.sections(x, now);
  }
  /// What acts in cells besides the diagonal law.
  CellTerms<Space> terms(const State& x) const { return terms_.under(x.tensions); }
  bool has_terms() const { return !terms_.none(); }
  /// The diagonal of the compliance of an edge.
  Point<Space> compliance(int edge) const { return columns_.compliance[edge]; }

  Storage linearisation() const;

  bool fits(const Storage& made) const { return made.hessian.pattern() == layout_.pattern(); }

  void linearise(const State& x, Hessian kind, Storage& out) const;

  void move(const State& x, const Vector& δ, State& out) const;

  /// w = (tangent − its symmetric part) v.
  void multiply_skew(const State& x, const Vector& v, Vector& out) const;

  const Vector& weights() const { return scales_.weights(); }
  const Vector& units() const { return scales_.units(); }
  const Vector& stiffness() const { return scales_.stiffness(); }
  const Vector& softness() const { return scales_.softness(); }

  void multiplier_sizes(const State& x, Vector& out) const;
  void rounding(const State& x, Vector& out) const;
  double unit_energy() const { return layout_.unit_moment(); }
  /// None where all rods are clamped and the loads tell all forces: only a mode without stiffness
  /// can make the factor break.
  double least_shift() const { return layout_.determinate() && dead_loads() ? 0 : 1e-6; }

 private:
  template <Hessian kind>
  void linearise(const State& x, Storage& out) const {
    out.energy = out.magnitude = 0;
    Acting changed;
    const Acting& now = loads_.acting(x, changed);
    const int nodes = layout_.row(layout_.first_node_block()), end = layout_.unknowns();
    out.hessian.set_zero(nodes, end);
    out.gradient.tail(end - nodes).setZero();
    const NetworkSpans<Space> spans(layout_, columns_, now.columns);
    for (int p = 0; p < int(layout_.spans().size()); ++p) spans.template set<kind>(x, p, out);
    const NetworkCells<Space> cells(layout_);
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod)) cells.template add<kind>(x, a, out);
    if (has_terms()) NetworkTerms<Space>(layout_, terms(x)).template add<kind>(x, out);
    for (int v = 0; v < int(net_.nodes.size()); ++v) add_node<kind>(x, now, v, out);
    for (const auto& [edge, m] : loads_.edge_moments())
      add_moment(x.frames[edge], m, layout_.frame_row(edge), out);
    for (const auto& [edge, m] : loads_.follower_moments())
      out.gradient.template segment<spin>(layout_.frame_row(edge)) -= m;
  }

  template <Hessian kind>
  void add_node(const State& x, const Acting& now, int v, Storage& out) const {
    const auto& node = net_.nodes[v];
    if (const int b = layout_.place_block(v); b >= 0) add_place(x, now, v, b, out);
    const int b = layout_.turn_block(v);
    if (b < 0) return;
    const Mat<spin> T = padded(node.turns);
    if (node.torsion_spring > 0) {
      const Spin<Space> u = log(principal(node.frame.conjugate() * x.node_frames[v]));
      const Spin<Space> C = Spin<Space>::Constant(node.torsion_spring);
      const auto jet = bend_twist<kind>(u, typename Space::Differential(u), C,
                                        Spin<Space>(Spin<Space>::Zero()), 1.);
      add_energy(jet.energy, out);
      add_to_rows(layout_, b, Spin<Space>(T.transpose() * jet.b), out);
      out.hessian.add_diagonal(b, Mat<spin>(T.transpose() * jet.bb * T));
    }
    const Spin<Space> m = rotate_spin(x.node_frames[v].conjugate(), loads_.node_moments()[v]) +
                          loads_.node_follower_moments()[v];
    add_to_rows(layout_, b, Spin<Space>(-T.transpose() * m), out);
    if constexpr (spin == 1) out.energy -= loads_.node_moments()[v][0] * x.node_frames[v].radians;
  }

  /// Balance of forces at a node: Σ n of the spans that end there − Σ n of those that start there
  /// − what acts on it.
  void add_place(const State& x, const Acting& now, int v, int b, Storage& out) const {
    const auto& node = net_.nodes[v];
    const Mat<dim> F = padded(node.free);
    Point<Space> known = -now.nodes[v],
                 open = Point<Space>::Zero();  // what the loads tell of the balance, or not
    for (const auto& [p, end] : layout_.spans_at(v)) {
      const auto& span = layout_.spans()[p];
      const double sign = end ? 1 : -1;
      known += sign * now.known[end ? layout_.last_edge(p) : layout_.first_edge(p)];
      open += sign * x.forces[p];
      if (span.block >= 0) {
        const Mat<dim> C = padded(span.open);
        out.hessian.add(span.block, b, Mat<dim>(sign * C.transpose() * F));
      }
    }
    const Point<Space> stretch = x.positions[v] - node.position;
    add_energy(node.spring * stretch.squaredNorm() / 2 + known.dot(x.positions[v]), out);
    add_to_rows(layout_, b, Point<Space>(F.transpose() * (known + open + node.spring * stretch)),
                out);
    out.hessian.add_diagonal(b, Mat<dim>(node.spring * F.transpose() * F));
  }

  void add_moment(const Rotation& q, const Spin<Space>& m, int first, Storage& out) const {
    out.gradient.template segment<spin>(first) -= rotate_spin(q.conjugate(), m);
    if constexpr (spin == 1) out.energy -= m[0] * q.radians;
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  NetworkLoads<Space> loads_;
  EdgeColumns<Space> columns_;
  NetworkScales<Space> scales_;
  CellTerms<Space> terms_;
};

template <class Space>
NetworkProblem<Space>::NetworkProblem(const Layout<Space>& layout)
    : layout_(layout),
      net_(layout.network()),
      loads_(layout),
      columns_(edge_columns(layout)),
      scales_(layout),
      terms_(layout.network()) {}

template <class Space>
void NetworkProblem<Space>::linearise(const State& x, Hessian kind, Storage& out) const {
  if (kind == Hessian::exact)
    linearise<Hessian::exact>(x, out);
  else
    linearise<Hessian::convex>(x, out);
}

template <class Space>
auto NetworkProblem<Space>::linearisation() const -> Storage {
  BlockSymmetric H(layout_.pattern());
  const int size = H.size();
  return {0, 0, Vector::Zero(size), std::move(H)};
}

template <class Space>
void NetworkProblem<Space>::move(const State& x, const Vector& δ, State& out) const {
  out.frames.resize(x.frames.size());
  out.forces = x.forces;
  out.hinge_angles = x.hinge_angles;
  out.node_frames = x.node_frames;
  out.positions = x.positions;
  for (int p = 0; p < int(x.forces.size()); ++p) {
    const auto& span = layout_.spans()[p];
    const int first = layout_.first_edge(p), apart = layout_.apart(p), e = first + apart;
    if (apart)
      out.frames[first] =
          moved(x.frames[first], Spin<Space>(δ.template segment<spin>(layout_.frame_row(first))));
    dispatch(MoveFrames<Space>{span.last - span.first - apart, x.frames.data() + e,
                               δ.data() + layout_.frame_row(e), out.frames.data() + e});
    if (span.block >= 0)
      out.forces[p] += span.open * δ.segment(layout_.row(span.block), span.open.cols());
  }
  for (int i = 0; i < layout_.hinges(); ++i)
    out.hinge_angles[i] += δ[layout_.row(layout_.hinge_block(i))];
  out.tensions = x.tensions, out.slack = x.slack;
  for (int i = 0; i < int(net_.tendons.size()); ++i)
    if (const int b = layout_.tendon_block(i); b >= 0) {
      out.tensions.resize(net_.tendons.size());
      out.tensions[std::size_t(i)] += layout_.unit_tension(i) * δ[layout_.row(b)];
    }
  for (int v = 0; v < int(net_.nodes.size()); ++v) {
    const auto& node = net_.nodes[v];
    if (const int b = layout_.turn_block(v); b >= 0)
      out.node_frames[v] = moved(
          x.node_frames[v], Spin<Space>(node.turns * δ.segment(layout_.row(b), node.turns.cols())));
    if (const int b = layout_.place_block(v); b >= 0)
      out.positions[v] += node.free * δ.segment(layout_.row(b), node.free.cols());
  }
}

template <class Space>
void NetworkProblem<Space>::multiply_skew(const State& x, const Vector& v, Vector& out) const {
  NetworkSkew<Space>(layout_, loads_, columns_).multiply(x, v, out);
}

template <class Space>
void NetworkProblem<Space>::multiplier_sizes(const State& x, Vector& out) const {
  Acting changed;
  scales_.multiplier_sizes(x, loads_.acting(x, changed), out);
}

template <class Space>
void NetworkProblem<Space>::rounding(const State& x, Vector& out) const {
  Acting changed;
  scales_.rounding(x, loads_.acting(x, changed), out);
}

}  // namespace pyrod
