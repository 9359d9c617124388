// SPDX-License-Identifier: BSD-3-Clause
/// \file Networks that depend on a number: what loads and supports are for each.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>
#include <pyrod/statics/unknowns/same_unknowns.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

namespace pyrod {

/// What a network family is made from.
template <class Space>
struct NetworkSource {
  virtual ~NetworkSource() = default;
  virtual void set(double λ) = 0;
  virtual const Layout<Space>& layout() const = 0;
  virtual const NetworkProblem<Space>& problem() const = 0;
  /// Puts supports where they are now.
  virtual void place(NetworkState<Space>& x) const = 0;
  /// w = ∂g/∂λ at x.
  virtual void slope(const NetworkState<Space>& x, Vector& w) = 0;
};

namespace detail {

/// The part of a point of a node that it is not free to choose.
template <class Space>
Point<Space> held_part(const Layout<Space>& layout, int v, const Point<Space>& r) {
  const auto& F = layout.network().nodes[v].free;
  const double unit = layout.unit_length(v);  // the length of its columns
  return r - F * (F.transpose() * r) / (unit * unit);
}

inline constexpr const char* other_unknowns =
    "family: scenes of all values must have the same rods, edges, supports and joints, of the same "
    "kinds at the same places";

}  // namespace detail

/// Between two networks that differ in loads and in positions of nodes: nothing is made anew, and
/// the slope is known.
template <class Space>
class BlendedNetwork final : public NetworkSource<Space> {
 public:
  using State = NetworkState<Space>;

  /// At 0 and at 1, in the plane of `at` or in space.
  BlendedNetwork(const Network<Spatial>& first, const Network<Spatial>& second,
                 const Placement<Spatial>& at)
      : first_(first, at), second_(second, at), problem_(first_.layout()), rate_(first_.layout()) {
    require(same_unknowns(layout().known(), second_.layout().known()), detail::other_unknowns);
    refuse_other_rods();
    refuse_other_tendons();
    rate_.blend(first_.problem(), -1, second_.problem(), 1);
    for (int v = 0; v < int(first_.network().nodes.size()); ++v) add_node(v);
  }

  void set(double λ) override {
    if (λ == λ_) return;
    λ_ = λ;
    problem_.blend(first_.problem(), 1, rate_, λ);
  }
  const Layout<Space>& layout() const override { return first_.layout(); }
  const NetworkProblem<Space>& problem() const override { return problem_; }

  void place(State& x) const override {
    for (const auto& [v, from, velocity] : moved_) {
      const Point<Space> off = from + λ_ * velocity - x.positions[v];
      x.positions[v] += detail::held_part(layout(), v, off);
    }
  }

  void slope(const State& x, Vector& w) override {
    problem_.slope(x, rate_, w);
    if (moved_.empty()) return;
    for (const auto& span : layout().spans()) {
      if (span.block < 0) continue;
      w.segment(layout().row(span.block), span.open.cols()) +=
          span.open.transpose() * (velocity(span.end) - velocity(span.start));
    }
  }

 private:
  struct Moved {
    int node;
    Point<Space> from, velocity;
  };

  Point<Space> velocity(int v) const {
    for (const auto& one : moved_)
      if (one.node == v) return one.velocity;
    return Point<Space>::Zero();
  }

  void add_node(int v) {
    const auto &a = first_.network().nodes[v], &b = second_.network().nodes[v];
    const Point<Space> d = b.position - a.position;
    const auto same = [](const auto& m, const auto& n) { return m.isApprox(n, 0); };
    require(same(a.free, b.free) && same(a.turns, b.turns) && a.spring == b.spring &&
                a.torsion_spring == b.torsion_spring &&
                log(a.frame.conjugate() * b.frame).norm() < 1e-12 && same(a.force, b.force) &&
                (d.isZero(0) || a.spring == 0),
            "family: the supports of the two scenes differ in more than positions, or springs in "
            "these; give a function of the parameter instead of two scenes");
    const Point<Space> held = detail::held_part(layout(), v, d);
    if (!held.isZero(0)) moved_.push_back({v, a.position, held});
  }

  void refuse_other_tendons() const {
    require(std::ranges::equal(first_.network().tendons, second_.network().tendons,
                               [](const auto& a, const auto& b) {
                                 return a.runs_like(b) && a.tension == b.tension &&
                                        a.length == b.length;
                               }),
            "family: the tendons of the two scenes differ; give a function of the parameter "
            "instead of two scenes");
  }

  void refuse_other_rods() const {
    const auto same = [](const auto& a, const auto& b) { return a == b; };
    for (std::size_t i = 0; i < first_.network().rods.size(); ++i) {
      const auto &a = first_.network().rods[i], &b = second_.network().rods[i];
      const auto &f = first_.network().loads[i], &g = second_.network().loads[i];
      const bool moments = f.follower_end_moment == g.follower_end_moment &&
                           std::ranges::equal(f.follower_moments, g.follower_moments,
                                              [](const auto& m, const auto& n) {
                                                return m.edge == n.edge && m.moment == n.moment;
                                              });
      require(a.grid.edge_lengths() == b.grid.edge_lengths() &&
                  std::ranges::equal(a.bending, b.bending, same) &&
                  std::ranges::equal(a.stretching, b.stretching, same) &&
                  std::ranges::equal(a.K0, b.K0, same) && moments,
              "family: the rods of the two scenes differ, or moments that follow them, which are "
              "not proportional to what is given; give a function of the parameter instead of two "
              "scenes");
    }
  }

  Posed<Space> first_, second_;
  NetworkProblem<Space> problem_, rate_;
  std::vector<Moved> moved_;
  double λ_ = 0;
};

/// Any: it is made anew for each value, on unknowns that are numbered once.
template <class Space>
class RemadeNetwork final : public NetworkSource<Space> {
 public:
  using State = NetworkState<Space>;
  using Make = std::function<Network<Spatial>(double)>;

  /// Differences are taken over `apart`, small enough that all is smooth there.
  RemadeNetwork(Make make, double λ, double apart, const Placement<Spatial>& at)
      : make_(std::move(make)),
        at_(at),
        apart_(apart),
        λ_(λ),
        here_(make_(λ), at),
        near_(make_(λ), at),
        given_(here_.layout()),
        other_(near_.problem().linearisation()) {}

  void set(double λ) override {
    if (λ == λ_) return;
    λ_ = std::numeric_limits<double>::quiet_NaN();  // until it is
    change(here_, λ);
    λ_ = λ;
  }
  const Layout<Space>& layout() const override { return here_.layout(); }
  const NetworkProblem<Space>& problem() const override { return here_.problem(); }
  void place(State& x) const override { place(here_, x); }

  void slope(const State& x, Vector& w) override {  // of fourth order
    w.setZero(x.frames.empty() ? 0 : layout().unknowns());
    for (const auto& [steps, weight] : {std::pair(1, 8.), std::pair(2, -1.)})
      for (const int side : {1, -1}) {
        change(near_, λ_ + side * steps * apart_);
        moved_ = x;
        place(near_, moved_);
        near_.problem().linearise(moved_, Hessian::exact, other_);
        w += side * weight / (12 * apart_) * other_.gradient;
      }
  }

 private:
  static constexpr int spin = Space::spin;

  void change(Posed<Space>& posed, double λ) const {
    posed.change(make_(λ), at_);
    require(same_unknowns(posed.layout().known(), given_.known()), detail::other_unknowns);
  }

  static void place(const Posed<Space>& posed, State& x) {
    for (int v = 0; v < int(posed.network().nodes.size()); ++v) {
      const auto& node = posed.layout().network().nodes[v];
      x.positions[v] +=
          detail::held_part(posed.layout(), v, Point<Space>(node.position - x.positions[v]));
      if (node.turns.cols() < spin) place_frame(node, x.node_frames[v]);
    }
  }

  /// Held, but for turns about the axes that it is free to turn about.
  static void place_frame(const Node<Space>& node, typename Space::Rotation& q) {
    const Spin<Space> u = log(principal(node.frame.conjugate() * q));
    const auto before = q;
    q = nearest(node.frame * exp(Spin<Space>(node.turns * (node.turns.transpose() * u))), before);
  }

  Make make_;
  Placement<Spatial> at_;
  double apart_, λ_;
  Posed<Space> here_, near_;
  Layout<Space> given_;
  Linearisation<BlockSymmetric> other_;
  State moved_;
};

}  // namespace pyrod
