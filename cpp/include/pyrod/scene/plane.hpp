// SPDX-License-Identifier: BSD-3-Clause
/// \file Whether a scene lies in one plane and looks the same in its mirror: what leaves the plane.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/directions.hpp>
#include <pyrod/scene/hold.hpp>
#include <pyrod/scene/joint.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/scene/supports.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iomanip>
#include <string>
#include <variant>
#include <vector>

namespace pyrod {

namespace detail {

/// Looks for what leaves the plane through the origin of the scene's, across a director of it.
class PlaneCheck {
 public:
  PlaneCheck(const SceneOnGrids& on, const SceneNetwork& network, int across)
      : on_(on),
        scene_(on.scene()),
        network_(network),
        at_(network.plane),
        across_(across),
        within_{across == 0 ? 1 : 0, 2},
        normal_(rotate(at_.frame, Vec3(Vec3::Unit(across)))) {
    for (const auto& rod : scene_.rods) length_ = std::max(length_, rod.length());
  }

  /// In words, the first that is found; empty: nothing does.
  std::string first() {
    for (int i = 0; i < int(scene_.rods.size()) && why_.empty(); ++i) look_at_rod(i);
    for (std::size_t i = 0; i < scene_.supports.size() && why_.empty(); ++i) look_at_support(i);
    for (std::size_t i = 0; i < scene_.joints.size() && why_.empty(); ++i) look_at_joint(i);
    for (std::size_t i = 0; i < scene_.loads.size() && why_.empty(); ++i) look_at_load(i);
    for (std::size_t i = 0; i < scene_.actuators.size() && why_.empty(); ++i) look_at_tendon(i);
    return why_;
  }

 private:
  template <class... T>
  void found(bool leaves, const T&... words) {
    if (leaves && why_.empty()) why_ = text(std::setprecision(3), words...);
  }
  std::string director(int i) const { return text("a", i + 1); }

  /// Of a point from the plane, 0 if it is rounding.
  double off(const Vec3& position) const {
    const double height = normal_.dot(position - at_.position);
    return std::abs(height) > 1e-9 * length_ ? height : 0;
  }
  /// Whether a rotation, seen from a frame in the plane, is about the normal.
  bool keeps(const Quaternion& turn) const {
    const Vec3 axis = turn.vec();
    return std::abs(axis[within_[0]]) + std::abs(axis[within_[1]]) < 1e-9;
  }
  bool holds(const Quaternion& frame) const { return keeps(at_.frame.conjugate() * frame); }
  /// Whether these directions span the same in the mirror: the normal is one of them, or across.
  static bool mirrors(const Directions<3>& directions, const Vec3& normal) {
    const Vec3 seen = directions * (directions.transpose() * normal);
    return (seen - normal * normal.dot(seen)).norm() < 1e-9;
  }

  void look_at_rod(int i) {
    for (const int k : within_) {
      double most = 0;
      for (const auto& K : on_.rod(i).K0)
        if (std::abs(K[k]) > std::abs(most)) most = K[k];
      found(most != 0, "rod ", i, k == 2 ? " is twisted" : " bends about " + director(k),
            " at rest, K0 = ", most);
    }
    const bool carried = std::ranges::any_of(scene_.supports, [i](const Support& support) {
      return place_of(support).rod == i && hold(support, Quaternion::Identity()).frame;
    });
    if (carried) return;
    const auto& [position, frame] = scene_.rods[std::size_t(i)].placement;
    found(!holds(frame), "the frame of rod ", i, " at rest is not one turned about ",
          director(across_));
    found(off(position) != 0, "rod ", i, " is ", off(position), " off the plane at rest");
  }

  void look_at_support(std::size_t i) {
    const auto& support = scene_.supports[i];
    const auto& [position, frame] = network_.held[i];
    const auto what = text("support ", i, " (", kind_of(support), ")");
    const Hold held = hold(support, frame);
    found(off(position) != 0, what, " is ", off(position), " off the plane");
    found(held.frame && !holds(frame), "the frame of ", what, " is not one turned about ",
          director(across_));
    found(!mirrors(held.free, normal_), what, " may move aslant to the plane");
    found(held.frame && !mirrors(held.turns, Vec3::Unit(across_)), what,
          " turns about an axis aslant to the plane");
    const auto* clamp = std::get_if<Clamp>(&support);
    if (clamp) found(clamp->turns != 0, what, " twists the rod, turns = ", clamp->turns);
  }

  void look_at_joint(std::size_t i) {
    for (const auto& a : network_.network.attachments) {
      if (a.node != network_.joint_nodes[i]) continue;
      const bool rigid = a.rigid && scene_.joints[i].kind != JointKind::ball;
      found(rigid && !keeps(a.relative), "joint ", i, " holds rod ", a.rod,
            " turned out of the plane");
      found(a.turns != 0, "joint ", i, " twists rod ", a.rod, ", turns = ", a.turns);
      const double normal = a.hinge ? std::abs((*a.hinge)[across_]) : 0;
      found(normal >= 1e-9 && normal <= 1 - 1e-9, "joint ", i, " has an axis aslant to the plane");
    }
  }

  void look_at_load(std::size_t number) {
    const auto& load = scene_.loads[number];
    for (int i = 0; i < int(scene_.rods.size()); ++i) {
      if (rod_of(load).value_or(i) != i) continue;
      const auto acting = on_.acting(load, i);
      for (const int k : {0, 1, 2}) {
        const bool leaves =
            k == across_ ? pushes(acting, on_.loads(i), k) : turns(acting, on_.loads(i), k);
        if (leaves)
          found(true, "load ", number, " (", kind_of(load), ") has a component ",
                largest(load, i, k), " along ", director(k));
      }
    }
  }

  void look_at_tendon(std::size_t i) {
    const auto& tendon = network_.network.tendons[i];
    double most = 0;
    for (const auto& d : tendon.samples()) most = std::max(most, std::abs(d[across_]));
    found(most > 1e-12 * tendon.largest_offset(), "tendon ", i, " has an offset ", most, " along ",
          director(across_));
  }

  /// Whether some of it has a part along a director, more than rounding of all that is dead.
  bool pushes(const Loads<Spatial>& acting, const Loads<Spatial>& all, int k) const {
    double scale = 0;
    for (const auto& F : all.force) scale = std::max(scale, F.norm());
    const auto is_dead = [&](const Vec3& F) { return part(F, k) > 1e-12 * scale; };
    return std::ranges::any_of(acting.force, is_dead) ||
           std::ranges::any_of(acting.follower_forces,
                               [k](const auto& f) { return f.force[k] != 0; });
  }
  bool turns(const Loads<Spatial>& acting, const Loads<Spatial>& all, int k) const {
    double scale = std::max(all.start_moment.norm(), all.end_moment.norm());
    for (const auto& M : all.moment) scale = std::max(scale, M.norm());
    const auto is_dead = [&](const Vec3& M) { return part(M, k) > 1e-12 * scale; };
    return std::ranges::any_of(acting.moment, is_dead) || is_dead(acting.start_moment) ||
           is_dead(acting.end_moment) || acting.follower_end_moment[k] != 0 ||
           std::ranges::any_of(acting.follower_moments,
                               [k](const auto& m) { return m.moment[k] != 0; });
  }
  double part(const Vec3& dead, int k) const { return std::abs(unrotate(at_.frame, dead)[k]); }

  /// The largest component of a load as it was given; of what is given by none, as it acts.
  double largest(const Load& load, int rod, int k) const {
    double most = 0;
    const auto take = [&](const Vec3& given) {
      const double value = follows(load) ? given[k] : unrotate(at_.frame, given)[k];
      if (std::abs(value) > std::abs(most)) most = value;
    };
    visit_vectors(load, take);
    visit_along(load, [&](const Along<Vec3>& along, int, const char* name) {
      const auto centred = centres(on_.rod(rod).grid.arc_lengths());
      for (const Vec3& given : sampled(along, centred, name, "edge")) take(given);
    });
    if (most == 0) std::ranges::for_each(on_.acting(load, rod).force, take);
    return most;
  }

  const SceneOnGrids& on_;
  const Scene& scene_;
  const SceneNetwork& network_;
  Placement<Spatial> at_;
  int across_;
  int within_[2];
  Vec3 normal_;
  double length_ = 0;
  std::string why_;
};

}  // namespace detail

/// What leaves the plane of a scene, in words; empty: nothing, and a planar solution is an
/// equilibrium in space, too. The plane is across the director a1 (0) or a2 (1) of the scene's
/// first clamp (else of the first rod at rest).
inline std::string leaving_plane(const SceneOnGrids& on, const SceneNetwork& network, int across) {
  return detail::PlaneCheck(on, network, across).first();
}

}  // namespace pyrod
