// SPDX-License-Identifier: BSD-3-Clause
/// \file Shapes to start from: at rest where the supports allow it, else bent into them.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/start/bow.hpp>
#include <pyrod/statics/start/over_supports.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

namespace pyrod {

template <class Space>
class Start {
 public:
  using Rotation = typename Space::Rotation;
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `level`: whether rods pass their inner supports on the level, rather than as bows beside
  /// would have it.
  explicit Start(const Layout<Space>& layout, bool level = false);

  /// Whether a rod goes on over supports, so that starts differ by how it passes them.
  bool has_choice() const;

  NetworkState<Space> state() const;

  /// The shapes at rest where they are at rest, whatever the supports say.
  NetworkState<Space> at_rest() const;

  /// The same with the supports of each rod drawn apart until it is nearly straight between them;
  /// nothing where rods share them.
  std::optional<Start> drawn_taut() const;

 private:
  using Shape = Bow<Space>;
  using Over = OverSupports<Space>;
  using Anchor = typename Shape::Anchor;

  std::vector<Anchor> anchors(int rod) const {
    std::vector<Anchor> out;
    for (const auto& a : layout_.attached(rod)) {
      const auto& node = net_.nodes[a.node];
      const bool held = node.free.cols() < dim;
      const bool clamped = a.rigid && node.turns.cols() < spin;
      if (held || clamped)
        out.push_back({a.vertex, places_[a.node], clamped, node.frame * a.relative, a.turns});
    }
    if (net_.rods[rod].grid.closed() && !out.empty()) {
      out.push_back(out.front());
      out.back().vertex = net_.rods[rod].edges();
    }
    return out;
  }

  void add_rod(int rod, NetworkState<Space>& x) const {
    const auto& place = net_.placements[rod];
    auto rest = net_.rods[rod].at_rest(place.position, place.frame);
    const auto held = anchors(rod);
    if (held.size() == 1 && held[0].clamped) rest = Shape::carried(net_.rods[rod], rest, held[0]);
    std::vector<Rotation> frames = rest.frames;
    if (const auto ends = ring_ends(rod, rest); !ends.empty())
      bend(rod, ends, frames);
    else if (Shape::fits(net_.rods[rod], rest, held))
      twist(rod, frames);
    else
      bend(rod, held, frames);
    x.frames.insert(x.frames.end(), frames.begin(), frames.end());
    // free nodes start where the shape at rest has them
    for (const auto& a : layout_.attached(rod)) {
      const auto& node = net_.nodes[a.node];
      if (node.free.cols() == dim && node.spring == 0)
        x.positions[a.node] = rest.positions[a.vertex];
      if (a.rigid && node.turns.cols() == spin)
        x.node_frames[a.node] =
            vertex_frame(net_.rods[rod].grid, rest, a.vertex) * a.relative.conjugate();
    }
  }

  /// Both ends of a rod that is joined to itself but does not close at rest, as if held there.
  std::vector<Anchor> ring_ends(int rod, const CosseratCurve<Space>& rest) const {
    const auto& on = layout_.attached(rod);
    if (on.size() != 2 || on[0].node != on[1].node || net_.rods[rod].grid.closed()) return {};
    if ((rest.positions.front() - rest.positions.back()).norm() <
        1e-9 * net_.rods[rod].grid.length())
      return {};
    const Rotation node = rest.start_frame * on[0].relative.conjugate();
    return {{0, rest.positions[0], true, rest.start_frame, 0},
            {net_.rods[rod].edges(), rest.positions[0], true, node * on[1].relative, on[1].turns}};
  }

  /// Full turns that are put into the shape at rest, evenly from each attachment to the next.
  void twist(int rod, std::vector<Rotation>& frames) const {
    if constexpr (spin == 3) {
      const auto& grid = net_.rods[rod].grid;
      const auto& on = layout_.attached(rod);
      double turned = 0;
      for (std::size_t i = 1; i < on.size(); ++i) {
        const double start = grid.s(on[i - 1].vertex), length = grid.s(on[i].vertex) - start;
        const double ψ = 2 * std::numbers::pi * on[i].turns;
        for (int j = on[i - 1].vertex; j < on[i].vertex; ++j)
          frames[j] = moved(frames[j], Vec3(0, 0, turned + ψ * (grid.centre(j) - start) / length));
        turned += ψ;
      }
      for (int j = on.back().vertex; j < grid.edges(); ++j)
        frames[j] = moved(frames[j], Vec3(0, 0, turned));
    }
  }

  /// Lays the frames of the edges through the held points; beyond the first and the last, the shape
  /// at rest goes on.
  void bend(int rod, const std::vector<Anchor>& held, std::vector<Rotation>& frames) const {
    const auto& r = net_.rods[rod];
    if (Over::goes_on(r, held)) {
      const Rotation& first =
          held[0].clamped ? held[0].frame : frames[std::min(held[0].vertex, r.edges() - 1)];
      const Point<Space> up = Over::up(r, net_.loads[rod], held, frames);
      const Over over(r, net_.loads[rod], held, first, up, level_);
      return extend(r, held, over.lay(frames), frames);
    }
    std::vector<Rotation> at;  // the frame at each held point
    for (std::size_t i = 0; i < held.size(); ++i) at.push_back(frame_at(r, held, frames, i));
    for (std::size_t i = 1; i < held.size(); ++i) {
      Anchor a = held[i - 1], b = held[i];  // where the rod goes on, its frame is one
      a.clamped = a.clamped || i > 1, b.clamped = b.clamped || i + 1 < held.size();
      at[i] = bow(r, a, b, at[i - 1], at[i], rod, frames);
    }
    extend(r, held, at, frames);
  }

  /// A held frame, or for a point held by its position the frame at rest turned towards its
  /// neighbours.
  Rotation frame_at(const Rod<Space>& r, const std::vector<Anchor>& held,
                    const std::vector<Rotation>& rest, std::size_t i) const {
    if (held[i].clamped) return held[i].frame;
    const std::size_t before = i == 0 ? 0 : i - 1, behind = i + 1 == held.size() ? i : i + 1;
    const Point<Space> chord = held[behind].position - held[before].position;
    const Rotation& there = rest[std::min(held[i].vertex, r.edges() - 1)];
    if (chord.norm() < 1e-9 * r.grid.length()) return there;
    return Shape::turned_towards(there, chord);
  }

  /// Returns the frame at the end, with the sign that leads on from the last edge.
  Rotation bow(const Rod<Space>& r, const Anchor& a, const Anchor& b, const Rotation& from,
               const Rotation& to, int rod, std::vector<Rotation>& frames) const {
    const auto base = Shape::between_anchors(r, a, b, from, to);
    const double start = r.grid.s(a.vertex), length = r.grid.s(b.vertex) - start;
    Point<Space> reach = Point<Space>::Zero();
    for (int j = a.vertex; j < b.vertex; ++j)
      reach += r.grid.h(j) * rotate(base[j - a.vertex], axis<Space>());
    const Point<Space> chord = b.position - a.position;
    const bool closes = reach.norm() < 1e-9 * length;  // and needs no bow
    const double shortening = closes ? 1 : std::min(1., chord.norm() / reach.norm());
    const double A = 2 * std::sqrt(1 - shortening);
    const bool ring = chord.norm() < 1e-9 * length && reach.norm() > (1 - 1e-9) * length;
    const Rotation& middle = base[base.size() / 2];
    const Point<Space> t = reach.norm() > 1e-9 * length ? Point<Space>(reach.normalized())
                                                        : rotate(middle, axis<Space>());
    const Spin<Space> about = bow_axis(rod, a, b, middle, t);
    const Spin<Space> tilt = Shape::tilt_towards(t, chord, length);
    for (int j = a.vertex; j < b.vertex; ++j) {
      const double x = (r.grid.centre(j) - start) / length;
      const double θ =
          ring ? 2 * std::numbers::pi * x : A * Shape::profile(x, a.clamped, b.clamped);
      const double τ =
          a.clamped || b.clamped ? std::numbers::pi / 2 * std::sin(std::numbers::pi * x) : 1;
      frames[j] = exp(Spin<Space>(θ * about)) * exp(Spin<Space>(τ * tilt)) * base[j - a.vertex];
    }
    return Shape::continued(frames[b.vertex - 1], to);
  }

  /// The axis of the bow: so that it goes with the loads, else the way the rod is bent at rest,
  /// else the way it is softest.
  Spin<Space> bow_axis(int rod, const Anchor& a, const Anchor& b, const Rotation& middle,
                       const Point<Space>& t) const {
    const auto& loads = net_.loads[rod];
    Point<Space> across = Point<Space>::Zero();
    double size = 0;
    for (int j = a.vertex; j <= b.vertex; ++j)
      across += loads.force[j], size += loads.force[j].norm();
    across -= across.dot(t) * t;
    const int j = (a.vertex + b.vertex) / 2;
    if (across.norm() < 1e-6 * size || size == 0) {
      const Spin<Space> κ =
          rotate_spin(middle, net_.rods[rod].K0[std::min(j, net_.rods[rod].grid.vertices() - 1)]);
      across = -Shape::lever(κ, t);
      if (across.norm() * net_.rods[rod].grid.length() < 1e-6)
        across = rotate(
            middle, Shape::soft_direction(
                        net_.rods[rod].bending[std::min(j, net_.rods[rod].grid.vertices() - 1)]));
      across -= across.dot(t) * t;
    }
    if (across.norm() == 0) return Spin<Space>::Zero();
    return cross(t, Point<Space>(across.normalized()));
  }

  static void extend(const Rod<Space>& r, const std::vector<Anchor>& held,
                     const std::vector<Rotation>& at, std::vector<Rotation>& frames) {
    const auto half = [&](int j) { return Spin<Space>(r.grid.Δs(j) * r.K0[j]); };
    for (int j = held.front().vertex - 1; j >= 0; --j)
      frames[j] = j == held.front().vertex - 1 ? at.front()
                                               : moved(frames[j + 1], Spin<Space>(-half(j + 1)));
    for (int j = held.back().vertex; j < r.edges(); ++j)
      frames[j] = j == held.back().vertex ? at.back() : moved(frames[j - 1], half(j));
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
  bool level_;
  std::vector<Point<Space>> places_;  ///< of the nodes, where they are held
};

template <class Space>
Start<Space>::Start(const Layout<Space>& layout, bool level)
    : layout_(layout), net_(layout.network()), level_(level) {
  for (const auto& node : net_.nodes) places_.push_back(node.position);
}

template <class Space>
bool Start<Space>::has_choice() const {
  for (int rod = 0; rod < int(net_.rods.size()); ++rod)
    if (Over::goes_on(net_.rods[rod], anchors(rod))) return true;
  return false;
}

template <class Space>
auto Start<Space>::state() const -> NetworkState<Space> {
  NetworkState<Space> x;
  x.positions = places_;
  for (const auto& node : net_.nodes) x.node_frames.push_back(node.frame);
  x.forces.assign(layout_.spans().size(), Point<Space>::Zero());
  x.hinge_angles.assign(layout_.hinges(), 0.);
  for (int rod = 0; rod < int(net_.rods.size()); ++rod) add_rod(rod, x);
  return x;
}

template <class Space>
auto Start<Space>::at_rest() const -> NetworkState<Space> {
  NetworkState<Space> x = state();
  x.frames.clear();
  for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
    const auto& place = net_.placements[rod];
    const auto rest = net_.rods[rod].at_rest(place.position, place.frame);
    x.frames.insert(x.frames.end(), rest.frames.begin(), rest.frames.end());
    for (const auto& a : layout_.attached(rod)) {
      x.positions[a.node] = rest.positions[a.vertex];
      if (a.rigid)
        x.node_frames[a.node] =
            vertex_frame(net_.rods[rod].grid, rest, a.vertex) * a.relative.conjugate();
    }
  }
  return x;
}

template <class Space>
auto Start<Space>::drawn_taut() const -> std::optional<Start> {
  Start out = *this;
  std::vector<char> moved(places_.size(), false);
  for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
    int before = -1, from = 0;
    for (const auto& a : layout_.attached(rod)) {
      if (net_.nodes[a.node].free.cols() == dim) continue;
      if (moved[a.node]) return std::nullopt;
      moved[a.node] = true;
      if (before >= 0) {
        const auto& grid = net_.rods[rod].grid;
        const Point<Space> chord = places_[a.node] - places_[before];
        const double taut = 0.97 * (grid.s(a.vertex) - grid.s(from)), apart = chord.norm();
        out.places_[a.node] =
            out.places_[before] + (apart > 0 ? std::max(1., taut / apart) : 1.) * chord;
      }
      before = a.node, from = a.vertex;
    }
  }
  return out;
}

}  // namespace pyrod
