// SPDX-License-Identifier: BSD-3-Clause
/// \file Rods, loads and frames brought to the plane that a planar computation is in.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/point_loads.hpp>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace pyrod {

/// The planar rod in the a1–a3 plane, or the rod itself. What leaves the plane is refused.
template <class Space>
Rod<Space> restricted(const Rod<Spatial>& rod) {
  Rod<Space> out{rod.grid, {}, {}, {}};
  out.bending.reserve(rod.bending.size()), out.K0.reserve(rod.K0.size());
  out.stretching.reserve(rod.stretching.size());
  for (const auto& C : rod.bending) out.bending.push_back(restrict_spin<Space>(C));
  for (const auto& C : rod.stretching) out.stretching.push_back(restrict_point<Space>(C));
  for (std::size_t j = 0; j < rod.K0.size(); ++j) {
    out.K0.push_back(restrict_spin<Space>(rod.K0[j]));
    require(embed_spin(out.K0[j]) == rod.K0[j], "K0[", j,
            "]: a planar rod bends about director 2 "
            "only, got (",
            rod.K0[j].transpose(), "); choose the spatial rod");
  }
  for (const auto& jump : rod.jumps)
    out.jumps.push_back({jump.vertex, restrict_spin<Space>(jump.bending_before),
                         restrict_spin<Space>(jump.K0_before),
                         restrict_spin<Space>(jump.bending_behind),
                         restrict_spin<Space>(jump.K0_behind)});
  return out;
}

/// Material components of what follows a frame, restricted to the space.
template <class Space>
Point<Space> in_plane(const Vec3& F) {
  const Point<Space> kept = restrict_point<Space>(F);
  require(embed(kept) == F, "loads: a following force (", F.transpose(),
          ") leaves the plane of the directors a1 and a3; choose the spatial rod");
  return kept;
}
template <class Space>
Spin<Space> about_normal(const Vec3& m) {
  const Spin<Space> kept = restrict_spin<Space>(m);
  require(embed_spin(kept) == m, "loads: a following moment (", m.transpose(),
          ") is not about director a2; choose the spatial rod");
  return kept;
}

/// Loads in the clamp's frame, restricted to the space; what leaves it by more than rounding is
/// refused.
template <class Space>
Loads<Space> restricted(const Loads<Spatial>& loads, const Quaternion& frame) {
  loads.check();
  double scale = 0;
  for (const auto& F : loads.force)
    if (F != Vec3::Zero()) scale = std::max(scale, F.norm());
  double spin_scale = std::max(loads.end_moment.norm(), loads.start_moment.norm());
  for (const auto& m : loads.moment)
    if (m != Vec3::Zero()) spin_scale = std::max(spin_scale, m.norm());
  for (const auto& c : loads.vertex_moments)  // which may cancel on the edges
    if (!c.follows) spin_scale = std::max(spin_scale, c.moment.norm());

  Loads<Space> out(int(loads.moment.size()));
  const auto point = [&](const Vec3& F) {
    const Vec3 local = unrotate(frame, F);
    const Point<Space> kept = restrict_point<Space>(local);
    require((local - embed(kept)).norm() <= 1e-12 * scale, "loads: a force (", F.transpose(),
            ") leaves the plane of the clamp's directors a1 and a3; choose the spatial rod");
    return kept;
  };
  const auto spin = [&](const Vec3& m) {
    const Vec3 local = unrotate(frame, m);
    const Spin<Space> kept = restrict_spin<Space>(local);
    require((local - embed_spin(kept)).norm() <= 1e-12 * spin_scale, "loads: a moment (",
            m.transpose(), ") is not about the clamp's director a2; choose the spatial rod");
    return kept;
  };
  for (const auto& f : loads.shares) out.shares.push_back(point(f));
  for (const auto& f : loads.follower_shares) out.follower_shares.push_back(in_plane<Space>(f));
  for (std::size_t j = 0; j < loads.force.size(); ++j)
    if (loads.force[j] != Vec3::Zero()) out.force[j] = point(loads.force[j]);
  for (std::size_t j = 0; j < loads.moment.size(); ++j)
    if (loads.moment[j] != Vec3::Zero()) out.moment[j] = spin(loads.moment[j]);
  out.end_moment = spin(loads.end_moment);
  out.start_moment = spin(loads.start_moment);
  for (const auto& f : loads.follower_forces)
    out.follower_forces.push_back({f.edge, f.vertex, in_plane<Space>(f.force)});
  for (const auto& c : loads.follower_moments)
    out.follower_moments.push_back({c.edge, about_normal<Space>(c.moment)});
  out.follower_end_moment = about_normal<Space>(loads.follower_end_moment);
  out.pushed = loads.pushed;
  for (const auto& c : loads.vertex_moments)
    out.vertex_moments.push_back(
        c.follows
            ? VertexMoment<Space>{c.vertex, about_normal<Space>(c.moment),
                                  about_normal<Space>(c.before), about_normal<Space>(c.behind),
                                  true}
            : VertexMoment<Space>{c.vertex, spin(c.moment), spin(c.before), spin(c.behind), false});
  return out;
}

/// Frames of a rod seen from the frame `at`. In the plane each angle goes on from the one before,
/// so that a rod may go round as often as it likes.
template <class Space>
std::vector<typename Space::Rotation> restricted(const std::vector<Quaternion>& frames,
                                                 const Quaternion& at) {
  std::vector<typename Space::Rotation> out;
  out.reserve(frames.size());
  for (const auto& q : frames) {
    auto local = restrict_rotation<Space>(at.conjugate() * q);
    if constexpr (Space::spin == 1)
      if (!out.empty()) local = out.back() * principal(out.back().conjugate() * local);
    out.push_back(local);
  }
  return out;
}

}  // namespace pyrod
