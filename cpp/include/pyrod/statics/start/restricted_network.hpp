// SPDX-License-Identifier: BSD-3-Clause
/// \file A network brought to the plane that a planar computation is in.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/statics/start/restricted.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <string_view>

namespace pyrod {

namespace detail {

/// The directions of span(A) that lie in the space, in the frame `at`.
template <class Space>
Directions<Space::dim> in_space(const Directions<3>& A, const Placement<Spatial>& at) {
  if constexpr (Space::dim == 3) {
    return A;
  } else {
    Directions<3> normal(3, 1);
    normal = rotate(at.frame, Vec3::UnitY());
    const Directions<3> kept = kernel_within<3>(A, normal.transpose());
    Directions<2> out(2, kept.cols());
    for (Eigen::Index i = 0; i < kept.cols(); ++i)
      out.col(i) = restrict_point<Space>(unrotate(at.frame, Vec3(kept.col(i))));
    return out;
  }
}

/// Material axes about which a node may turn; in the plane, a2 or none.
template <class Space>
Directions<Space::spin> axes_in_space(const Directions<3>& turns) {
  if constexpr (Space::spin == 3) {
    return turns;
  } else {
    const bool about_normal =
        (turns * (turns.transpose() * Vec3::UnitY()) - Vec3::UnitY()).norm() < 1e-9;
    return turns.cols() > 0 && about_normal ? Directions<1>(Mat<1>::Identity())
                                            : Directions<1>(1, 0);
  }
}

template <class Space>
typename Space::Rotation frame_in_space(const Quaternion& q, const Placement<Spatial>& at,
                                        std::string_view what) {
  if constexpr (Space::spin == 3) {
    return q;
  } else {
    const Quaternion local = at.frame.conjugate() * q;
    require(std::abs(local.x()) + std::abs(local.z()) < 1e-9, what,
            ": a frame leaves the plane of the directors a1 and a3; choose the spatial scene");
    return restrict_rotation<Space>(local);
  }
}

template <class Space>
Point<Space> point_in_space(const Vec3& r, const Placement<Spatial>& at, double length,
                            std::string_view what) {
  if constexpr (Space::dim == 3) {
    return r;
  } else {
    const Vec3 local = unrotate(at.frame, Vec3(r - at.position));
    require(std::abs(local.y()) <= 1e-9 * length, what,
            ": a point leaves the plane of the directors a1 and a3 by ", local.y(),
            "; choose the spatial scene");
    return restrict_point<Space>(local);
  }
}

/// In the plane a hinge is a ball joint, or if its axis lies in the plane, none.
inline void add_hinge(Attachment<Spatial>& a, const Vec3& axis) { a.hinge = axis; }
inline void add_hinge(Attachment<Planar>& a, const Vec3& axis) {
  const double normal = std::abs(axis.y());
  require(normal < 1e-9 || normal > 1 - 1e-9,
          "joints: a hinge lets rods turn out of the plane of the directors a1 and a3; choose the "
          "spatial scene");
  if (normal > 0.5) a.rigid = false;
}

}  // namespace detail

/// The network in the plane of `at`, or as it is. What leaves the plane is refused.
template <class Space>
Network<Space> restricted(const Network<Spatial>& net, const Placement<Spatial>& at) {
  if constexpr (Space::dim == 3)
    net.check_places();  // the rest is looked at by the solver
  else
    net.check();
  const Quaternion turn = Space::dim == 3 ? Quaternion::Identity() : at.frame;
  double length = 0;
  for (const auto& rod : net.rods) length = std::max(length, rod.grid.length());
  Network<Space> out;
  for (std::size_t i = 0; i < net.rods.size(); ++i) {
    out.rods.push_back(restricted<Space>(net.rods[i]));
    out.loads.push_back(restricted<Space>(net.loads[i], turn));
    out.placements.push_back(
        {detail::point_in_space<Space>(net.placements[i].position, at, length, "rod"),
         detail::frame_in_space<Space>(net.placements[i].frame, at, "rod")});
  }
  for (const auto& node : net.nodes) {
    Node<Space> v;
    v.position = detail::point_in_space<Space>(node.position, at, length, "supports");
    v.free = detail::in_space<Space>(node.free, at);
    v.frame = detail::frame_in_space<Space>(node.frame, at, "supports");
    v.turns = detail::axes_in_space<Space>(node.turns);
    v.force = restrict_point<Space>(unrotate(turn, node.force));
    v.moment = restrict_spin<Space>(unrotate(turn, node.moment));
    v.follower_moment = about_normal<Space>(node.follower_moment);
    v.spring = node.spring;
    v.torsion_spring = node.torsion_spring;
    v.parts_cell = node.parts_cell;
    out.nodes.push_back(v);
  }
  for (const auto& tendon : net.tendons)
    require(Space::dim == 3 || tendon.off_plane() <= 1e-12 * tendon.largest_offset(),
            "actuators: a tendon is ", tendon.off_plane(),
            " off the plane of the directors a1 and a3; choose the spatial scene");
  out.tendons = net.tendons;
  const Placement<Spatial> origin;
  for (const auto& a : net.attachments) {
    out.attachments.push_back({a.rod, a.vertex, a.node, a.rigid,
                               detail::frame_in_space<Space>(a.relative, origin, "joints"),
                               a.turns});
    if (a.hinge) detail::add_hinge(out.attachments.back(), *a.hinge);
  }
  return out;
}

}  // namespace pyrod
