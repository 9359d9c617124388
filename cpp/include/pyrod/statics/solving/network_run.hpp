// SPDX-License-Identifier: BSD-3-Clause
/// \file One call for every network: plane or space chosen at run time, results always in space.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/scene_solution.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/start/network_start.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <vector>

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
    out.nodes.push_back(v);
  }
  const Placement<Spatial> origin;
  for (const auto& a : net.attachments) {
    out.attachments.push_back({a.rod, a.vertex, a.node, a.rigid,
                               detail::frame_in_space<Space>(a.relative, origin, "joints"),
                               a.turns});
    if (a.hinge) detail::add_hinge(out.attachments.back(), *a.hinge);
  }
  return out;
}

template <class Space>
struct NetworkRun {
  NetworkResult<Space> result;
  std::vector<RodSolution<Spatial>> rods;
  std::vector<NodeSolution<Spatial>> nodes;
};

/// Equilibrium of a network, in the plane of `at` or in space. `start`: a shape that is trusted to
/// be near; none: see `Start`.
template <class Space>
NetworkRun<Space> run(const Network<Spatial>& net, const Placement<Spatial>& at,
                      const std::optional<NetworkStart>& start, const Options& options,
                      const NetworkOptions& more, const Trace& trace) {
  require_rotation(at.frame, "at.frame");
  const Placement<Spatial> here = Space::dim == 3 ? Placement<Spatial>{} : at;
  NetworkSolver<Space> solver(restricted<Space>(net, at), options, more, trace);
  NetworkRun<Space> out;
  if (start) {
    out.result =
        solver.solve(StateNear<Space>(solver.layout(), here, net.nodes.size()).state(*start));
  } else {
    out.result = solver.solve();
  }
  for (const auto& rod : out.result.solution.rods) out.rods.push_back(placed(rod, here));
  for (const auto& v : out.result.solution.nodes)
    out.nodes.push_back({here.position + rotate(here.frame, embed(v.position)),
                         rotate(here.frame, embed(v.reaction_force)), here.frame * embed(v.frame),
                         rotate(here.frame, embed_spin(v.reaction_moment))});
  return out;
}

template <class Space>
SceneSolution scene_solution(NetworkRun<Space>&& from) {
  const auto& r = from.result;
  SceneSolution out{std::move(from.rods),
                    std::move(from.nodes),
                    r.status,
                    r.index,
                    r.residual,
                    r.fill,
                    r.unknowns,
                    r.multipliers,
                    r.load_steps,
                    r.descents,
                    r.neutral,
                    {},
                    r.lowest_eigenvalue,
                    r.rounding,
                    std::move(from.result.record),
                    r.softness};
  for (const auto& φ : r.mode) out.mode.push_back(embed_spin(φ));
  return out;
}

}  // namespace pyrod
