// SPDX-License-Identifier: BSD-3-Clause
/// \file Where the last solve of a network came to, to start the next one of it from.
#pragma once

#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <type_traits>
#include <utility>
#include <variant>

namespace pyrod {

/// Keeps the unknowns, with the section forces that belong to them.
class WarmStart {
 public:
  WarmStart() = default;

  template <class Space>
  WarmStart(std::shared_ptr<const Found<Space>> found, const Placement<Spatial>& here)
      : found_(std::move(found)), here_(here) {}

  /// The state of a network that has the same unknowns, with supports where they are now; none if
  /// they are others, or the plane of the computation has been tilted.
  template <class Space>
  std::optional<NetworkState<Space>> state(const Posed<Space>& posed) const {
    const auto* found = std::get_if<std::shared_ptr<const Found<Space>>>(&found_);
    if (!found || !fits((*found)->state, posed.layout())) return std::nullopt;
    NetworkState<Space> near = (*found)->state;
    if constexpr (!std::is_same_v<Space, Spatial>)
      if (!move(near, posed.here())) return std::nullopt;
    const auto forces = near.forces;
    auto out = StateNear<Space>(posed.layout(), posed.here(), posed.network().nodes.size())
                   .state(std::move(near));
    for (std::size_t p = 0; p < forces.size(); ++p) {  // of which the loads may tell another part
      const auto& open = posed.layout().spans()[p].open;
      const double unit = posed.layout().unit_force(int(p));  // the length of its columns
      out.forces[p] = open * (open.transpose() * forces[p]) / (unit * unit);
    }
    return out;
  }

 private:
  template <class Space>
  static bool fits(const NetworkState<Space>& x, const Layout<Space>& layout) {
    return int(x.frames.size()) == layout.edges() && x.forces.size() == layout.spans().size() &&
           x.positions.size() == layout.network().nodes.size() &&
           int(x.hinge_angles.size()) == layout.hinges() &&
           (x.tensions.empty() || x.tensions.size() == layout.network().tendons.size());
  }

  /// From the place where the plane was to where it is now.
  bool move(NetworkState<Planar>& x, const Placement<Spatial>& to) const {
    const Quaternion turn = principal(to.frame.conjugate() * here_.frame);
    if (turn.coeffs() == Quaternion::Identity().coeffs() && to.position == here_.position)
      return true;
    const Vec3 shift = unrotate(to.frame, Vec3(here_.position - to.position));
    if (std::abs(turn.x()) + std::abs(turn.z()) > 1e-9) return false;
    const auto by = restrict_rotation<Planar>(turn);
    for (auto* frames : {&x.frames, &x.node_frames})
      for (auto& q : *frames) q = by * q;
    for (auto& r : x.positions) r = rotate(by, r) + restrict_point<Planar>(shift);
    for (auto& n : x.forces) n = rotate(by, n);
    return true;
  }

  std::variant<std::monostate, std::shared_ptr<const Found<Planar>>,
               std::shared_ptr<const Found<Spatial>>>
      found_;
  Placement<Spatial> here_;
};

}  // namespace pyrod
