// SPDX-License-Identifier: BSD-3-Clause
/// \file From the unknowns of a network to all that there is to know of its rods and nodes.
#pragma once

#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/extremes.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/vertices.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <map>
#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
struct NetworkSolution {
  std::vector<RodSolution<Space>> rods;
  std::vector<NodeSolution<Space>> nodes;
};

template <class Space>
class Recovery {
 public:
  using Rotation = typename Space::Rotation;

  Recovery(const NetworkProblem<Space>& problem, const NetworkState<Space>& x)
      : problem_(problem),
        layout_(problem.layout()),
        net_(layout_.network()),
        x_(x),
        now_(problem.forces(x)) {}

  NetworkSolution<Space> solution() {
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) begin(rod);
    place();
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) weigh(rod);
    react();
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) see(rod);
    for (auto& rod : out_.rods)
      if (rod.curve.positions.size() > rod.moment.size()) rod.curve.positions.pop_back();
    return std::move(out_);
  }

 private:
  /// Frames, forces and stretches; positions come later.
  void begin(int rod) {
    const auto& r = net_.rods[rod];
    RodSolution<Space> s;
    for (int j = 0; j < r.edges(); ++j) {
      const int e = layout_.edge(rod, j);
      s.curve.frames.push_back(x_.frames[e]);
      s.force.push_back(now_.sections[e]);
      s.material_force.push_back(unrotate(x_.frames[e], now_.sections[e]));
      s.strains.Γ.push_back(axis<Space>() +
                            problem_.compliance(e).cwiseProduct(s.material_force[j]));
      s.stretch_shear_energy +=
          r.grid.h(j) / 2 * (s.strains.Γ[j] - axis<Space>()).dot(s.material_force[j]);
    }
    s.curve.positions.assign(r.edges() + 1, Point<Space>::Zero());
    s.load = now_.vertices[rod];
    end_frames(rod, s.curve);
    s.load_moment = load_moment(rod, s.curve);
    out_.rods.push_back(std::move(s));
  }

  /// The frames that hold the ends; of a free end, the one that its last half cell turns to.
  void end_frames(int rod, CosseratCurve<Space>& curve) const {
    const auto& r = net_.rods[rod];
    const auto& on = layout_.attached(rod);
    const int n = r.edges();
    const Rotation &first = curve.frames.front(), &last = curve.frames.back();
    if (r.grid.closed()) {
      curve.start_frame = first * principal(last.conjugate() * first).conjugate();
      curve.end_frame = last;
      return;
    }
    const auto& loads = net_.loads[rod];
    if (on.front().rigid)
      curve.start_frame = first * principal(held(on.front()).conjugate() * first).conjugate();
    else
      curve.start_frame =
          moved(first, turn_under_moment<Space>(rotate_spin(first.conjugate(), loads.start_moment),
                                                r.bending[0], Spin<Space>(-r.K0[0]), r.grid.Δs(0)));
    if (on.back().rigid)
      curve.end_frame = last * principal(last.conjugate() * held(on.back()));
    else if (!loads.follower_end_moment.isZero(0))
      curve.end_frame =
          moved(last, turn_under_moment_behind<Space>(loads.follower_end_moment, r.bending[n],
                                                      r.K0[n], r.grid.Δs(n)));
    else
      curve.end_frame =
          moved(last, turn_under_moment<Space>(rotate_spin(last.conjugate(), loads.end_moment),
                                               r.bending[n], r.K0[n], r.grid.Δs(n)));
  }

  Spin<Space> load_moment(int rod, const CosseratCurve<Space>& curve) const {
    const auto& loads = net_.loads[rod];
    Spin<Space> sum =
        loads.total_moment() + rotate_spin(curve.end_frame, loads.follower_end_moment);
    for (const auto& c : loads.follower_moments) sum += rotate_spin(curve.frames[c.edge], c.moment);
    for (const auto& a : layout_.attached(rod))
      for (const auto& c : loads.vertex_moments)
        if (c.on_node && c.vertex == a.vertex)
          sum += c.follows ? rotate_spin(held(a), c.moment) : c.moment;
    return sum;
  }

  Rotation held(const Attachment<Space>& a) const { return held_frame(x_, a); }

  /// Positions span by span, from nodes whose position is known to those that it tells.
  void place() {
    for (const auto& q : x_.node_frames)
      out_.nodes.push_back({Point<Space>::Zero(), Point<Space>::Zero(), q, Spin<Space>::Zero()});
    std::vector<char> known(net_.nodes.size()), placed(layout_.spans().size(), false);
    for (int v = 0; v < int(known.size()); ++v) {
      known[v] = !layout_.derived(v);
      if (known[v]) out_.nodes[v].position = x_.positions[v];
    }
    for (bool more = true; more;) {
      more = false;
      for (int p = 0; p < int(placed.size()); ++p) {
        const auto& span = layout_.spans()[p];
        if (placed[p] || !(known[span.start] || known[span.end])) continue;
        place(span, known[span.start]);
        known[span.start] = known[span.end] = placed[p] = more = true;
      }
    }
  }

  void place(const Span<Space>& span, bool forwards) {
    auto& s = out_.rods[span.rod];
    auto& r = s.curve.positions;
    const auto& grid = net_.rods[span.rod].grid;
    const auto edge = [&](int j) -> Point<Space> {
      return grid.h(j) * rotate(s.curve.frames[j], s.strains.Γ[j]);
    };
    auto &start = out_.nodes[span.start].position, &end = out_.nodes[span.end].position;
    if (forwards) {
      r[span.first] = start;
      for (int j = span.first; j < span.last; ++j) r[j + 1] = r[j] + edge(j);
      if (layout_.derived(span.end)) end = r[span.last];
    } else {
      r[span.last] = end;
      for (int j = span.last - 1; j >= span.first; --j) r[j] = r[j + 1] - edge(j);
      start = r[span.first];
    }
  }

  /// Curvatures, moments and energies.
  void weigh(int rod) {
    auto& s = out_.rods[rod];
    const auto& r = net_.rods[rod];
    std::vector<const Attachment<Space>*> cut(r.grid.vertices(), nullptr);
    for (const auto& a : layout_.attached(rod))
      if (a.rigid && a.vertex > 0 && a.vertex < r.edges()) cut[a.vertex] = &a;
    for (int j = 0; j < r.grid.vertices(); ++j) {
      if (cut[j] || (r.grid.closed() && j == 0 && layout_.attached(rod).front().rigid))
        add_halves(rod, j, cut[j] ? *cut[j] : layout_.attached(rod).front());
      else
        add_cell(s, r, j, s.curve.frame_before(j), turn(s.curve, j), r.grid.Δs(j));
    }
  }

  void add_cell(RodSolution<Space>& s, const Rod<Space>& r, int j, const Rotation& before,
                const Spin<Space>& u, double Δs) {
    const Spin<Space> ΔK = u / Δs - r.K0[j], M = r.bending[j].cwiseProduct(ΔK);
    s.strains.K.push_back(u / Δs);
    s.material_moment.push_back(M);
    s.moment.push_back(
        rotate_spin(before, transmitted_moment<Space>(u, r.bending[j], r.K0[j], Δs)));
    s.bend_twist_energy += Δs * ΔK.dot(M) / 2;
  }

  /// A vertex that is held: the halves of its cell turn by themselves. What is told here is their
  /// mean, of inner vertices of an open rod in the end both sides.
  void add_halves(int rod, int j, const Attachment<Space>& a) {
    auto& s = out_.rods[rod];
    const auto& r = net_.rods[rod];
    const Rotation h = held(a);
    const int before = j == 0 ? r.edges() - 1 : j - 1;
    const Spin<Space> u = log(principal(s.curve.frames[before].conjugate() * h)),
                      v = log(principal(h.conjugate() * s.curve.frames[j]));
    const double du = r.grid.h(before) / 2, dv = r.grid.h(j) / 2;
    const auto on = r.sides(j);
    const Spin<Space>&C = on.bending_before, &D = on.bending_behind;
    const Spin<Space> ΔU = u / du - on.K0_before, ΔV = v / dv - on.K0_behind;
    s.strains.K.push_back((u + v) / (du + dv));
    s.material_moment.push_back(r.bending[j].cwiseProduct(s.strains.K.back() - r.K0[j]));
    s.moment.push_back(rotate_spin(h, transmitted_moment<Space>(v, D, on.K0_behind, dv)));
    s.bend_twist_energy += (du * ΔU.dot(C.cwiseProduct(ΔU)) + dv * ΔV.dot(D.cwiseProduct(ΔV))) / 2;
    before_[{rod, j}] =
        rotate_spin(s.curve.frames[before], transmitted_moment<Space>(u, C, on.K0_before, du));
  }

  /// What the supports exert: all that acts on a node adds up to zero with it.
  void react() {
    for (int v = 0; v < int(net_.nodes.size()); ++v) {
      Point<Space> sum = now_.nodes[v];
      for (const auto& [p, end] : layout_.spans_at(v)) {
        const auto& span = layout_.spans()[p];
        if (end)
          sum -= now_.sections[layout_.edge(span.rod, span.last - 1)];
        else
          sum += now_.sections[layout_.edge(span.rod, span.first)];
      }
      out_.nodes[v].reaction_force = -sum;
      out_.nodes[v].reaction_moment =
          -(net_.nodes[v].moment + rotate_spin(out_.nodes[v].frame, net_.nodes[v].follower_moment));
    }
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      for (const auto& a : layout_.attached(rod))
        if (a.rigid) react(rod, a);
  }

  void react(int rod, const Attachment<Space>& a) {
    auto& m = out_.nodes[a.node].reaction_moment;
    const auto& moment = out_.rods[rod].moment;
    const int n = net_.rods[rod].edges();
    const bool closed = net_.rods[rod].grid.closed();
    if (!closed && a.vertex == n) {
      const auto& loads = net_.loads[rod];
      m += moment[n] - loads.end_moment - rotate_spin(held(a), loads.follower_end_moment);
    } else {
      m -= moment[a.vertex];
      if (!closed && a.vertex == 0)
        m -= net_.loads[rod].start_moment;
      else
        m += before_[{rod, a.vertex}];
    }
  }

  /// What vertices say, when reactions have been told from what the halves of their cells exert.
  void see(int rod) {
    const auto& r = net_.rods[rod];
    if (r.grid.closed()) return;
    auto& s = out_.rods[rod];
    std::vector<HeldVertex<Space>> on;
    for (const auto& a : layout_.attached(rod)) {
      if (a.vertex == 0 || a.vertex == r.edges()) continue;
      on.push_back({a.vertex});
      if (a.rigid) on.back().frame = held(a), on.back().moment_before = before_[{rod, a.vertex}];
    }
    Extremes<Space> extremes(r);
    for (int j = 0; j <= r.edges(); ++j)
      extremes.add_cell(r.grid.Δs(j) * s.strains.K[j], s.material_moment[j]);
    Vertices<Space>(r, net_.loads[rod], std::move(on)).see(s, s.force);
    for (const auto& n : s.vertex_force) extremes.add_force(n);
    s.largest = extremes.largest(s, 1);
  }

  const NetworkProblem<Space>& problem_;
  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkState<Space>& x_;
  typename NetworkProblem<Space>::Forces now_;
  NetworkSolution<Space> out_;
  std::map<std::pair<int, int>, Spin<Space>> before_;
};

}  // namespace pyrod
