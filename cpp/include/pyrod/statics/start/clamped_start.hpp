// SPDX-License-Identifier: BSD-3-Clause
/// \file Shapes to start rods from that are clamped, and whose section forces the loads tell.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/start/bow.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

/// At rest; where the moments on a rod outweigh its forces, in the shape that they alone give it,
/// which is a solution already if there are no forces.
template <class Space>
class ClampedStart {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;

  /// `layout`: determinate.
  explicit ClampedStart(const Layout<Space>& layout) : layout_(layout), net_(layout.network()) {}

  NetworkState<Space> state() const;

  /// Whether `state` is a solution: neither forces nor tendons act.
  bool exact() const;

  /// Without any force.
  NetworkState<Space> under_moments() const;

  /// The Hessian of the first step from `state`: exact, if that is near.
  Hessian first() const;

 private:
  template <class FramesOf>
  NetworkState<Space> with_frames(const FramesOf& frames_of) const {
    NetworkState<Space> x;
    x.forces.assign(layout_.spans().size(), Point<Space>::Zero());
    x.hinge_angles.assign(std::size_t(layout_.hinges()), 0.);
    for (const auto& node : net_.nodes) {
      x.positions.push_back(node.position);
      x.node_frames.push_back(node.frame);
    }
    x.frames.reserve(std::size_t(layout_.edges()));
    for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
      const Frames frames = frames_of(rod);
      x.frames.insert(x.frames.end(), frames.begin(), frames.end());
    }
    return x;
  }

  const Attachment<Space>& clamp(int rod) const {
    return *std::ranges::find_if(layout_.attached(rod),
                                 [this](const auto& a) { return layout_.clamps(a); });
  }
  Rotation frame(const Attachment<Space>& a) const { return net_.nodes[a.node].frame * a.relative; }

  Frames rest(int rod) const {
    const auto& a = clamp(rod);
    const auto& r = net_.rods[rod];
    if (a.vertex == 0 && !r.grid.closed()) return r.frames_at_rest(frame(a));
    const auto& place = net_.placements[rod];
    return Bow<Space>::carried(r, r.at_rest(place.position, place.frame),
                               {a.vertex, net_.nodes[a.node].position, true, frame(a), a.turns})
        .frames;
  }

  bool moments_lead(int rod) const {
    const auto& loads = net_.loads[rod];
    if (!loads.has_moments() || clamp(rod).vertex != 0) return false;
    double moments = 0, levers = 0;
    for (const auto& m : loads.moments_behind()) moments = std::max(moments, m.norm());
    for (const auto& n : loads.section_forces())
      levers = std::max(levers, n.norm() * net_.rods[rod].grid.length());
    return moments > levers;
  }

  /// The shape that the moments alone give a rod, marched along it from its clamp.
  Frames bent(int rod) const {
    const auto& a = clamp(rod);
    if (a.vertex != 0) return rest(rod);
    const auto& r = net_.rods[rod];
    const auto m = net_.loads[rod].moments_behind();
    Frames frames;
    frames.reserve(m.size());
    for (int j = 0; j < r.edges(); ++j) {
      const Rotation before = j == 0 ? frame(a) : frames[j - 1];
      const Spin<Space> M = rotate_spin(before.conjugate(), m[j]);
      frames.push_back(
          moved(before, turn_under_moment<Space>(M, r.bending[j], r.K0[j], r.grid.Δs(j))));
    }
    return frames;
  }

  const Layout<Space>& layout_;
  const Network<Space>& net_;
};

template <class Space>
auto ClampedStart<Space>::state() const -> NetworkState<Space> {
  return with_frames([this](int rod) { return moments_lead(rod) ? bent(rod) : rest(rod); });
}

template <class Space>
auto ClampedStart<Space>::under_moments() const -> NetworkState<Space> {
  return with_frames([this](int rod) { return bent(rod); });
}

template <class Space>
bool ClampedStart<Space>::exact() const {
  const auto none = [](const auto& F) { return F.isZero(0); };
  if (!net_.tendons.empty()) return false;
  for (int rod = 0; rod < int(net_.rods.size()); ++rod) {
    const auto& loads = net_.loads[rod];
    if (!std::ranges::all_of(loads.force, none)) return false;
    const bool turned = loads.has_moments() || !loads.start_moment.isZero(0);
    if (turned && clamp(rod).vertex != 0) return false;
  }
  return std::ranges::all_of(net_.nodes, none, &Node<Space>::force);
}

template <class Space>
auto ClampedStart<Space>::first() const -> Hessian {
  for (int rod = 0; rod < int(net_.rods.size()); ++rod)
    if (!moments_lead(rod)) return Hessian::convex;
  return Hessian::exact;
}

}  // namespace pyrod
