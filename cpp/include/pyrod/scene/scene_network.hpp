// SPDX-License-Identifier: BSD-3-Clause
/// \file A scene as rods that meet in nodes.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/rotation/frame_along.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/hold.hpp>
#include <pyrod/scene/joint.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/scene/rest.hpp>
#include <pyrod/scene/scene_on_grids.hpp>
#include <pyrod/scene/support_parts.hpp>
#include <pyrod/scene/supports.hpp>
#include <pyrod/scene/tendons_on_grids.hpp>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

/// The network of a scene, the plane it is in if its space is one, the node of each support and of
/// each joint, and where each support holds its point and its frame.
struct SceneNetwork {
  Network<Spatial> network;
  Placement<Spatial> plane;
  std::vector<int> support_nodes, joint_nodes;
  std::vector<Placement<Spatial>> held;
};

namespace detail {

class NetworkMaker {
 public:
  explicit NetworkMaker(const SceneOnGrids& on) : on_(on), scene_(on.scene()) {
    for (int i = 0; i < int(scene_.rods.size()); ++i) {
      const auto& placement = scene_.rods[std::size_t(i)].placement;
      rest_.emplace_back(on.rod(i), placement);
      const auto by = carrier(on, i);
      by ? carried_.emplace_back(on.rod(i), placement, *by)
         : carried_.emplace_back(on.rod(i), placement);
    }
    out_.plane = plane();
  }

  SceneNetwork make() {
    meet();
    for (int i = 0; i < int(scene_.rods.size()); ++i) {
      out_.network.rods.push_back(on_.rod(i));
      out_.network.loads.push_back(on_.loads(i));
    }
    for (const auto& actuator : scene_.actuators)
      out_.network.tendons.push_back(routed(std::get<Tendon>(actuator)));
    return std::move(out_);
  }

  /// Without rods and loads.
  SceneNetwork make_nodes() {
    meet();
    return std::move(out_);
  }

 private:
  using Point = std::pair<int, int>;  ///< numbers of a rod, and of a vertex of it

  void meet() {
    for (std::size_t i = 0; i < scene_.joints.size(); ++i) join(scene_.joints[i], i);
    for (const auto& support : scene_.supports) support_on(support);
    for (const auto& actuator : scene_.actuators) part_cells(std::get<Tendon>(actuator));
    for (int i = 0; i < int(scene_.rods.size()); ++i) place_rod(i);
    for (auto& meeting : nodes_) add(meeting);
    for (const auto& support : scene_.supports)
      note_held(nodes_[owner_.at(point(place_of(support)))]);
    for (const auto& joint : scene_.joints)
      out_.joint_nodes.push_back(nodes_[owner_.at(point(joint.points[0]))].number);
  }

  /// What meets in one point.
  struct Meeting {
    std::vector<Point> points;
    bool rigid = false, aligned = false;
    std::optional<Vec3> hinge = {};
    const Support* support = nullptr;
    Point held = {};
    std::map<Point, int> turns = {};
    int number = -1;
    Placement<Spatial> at = {};      ///< where its support holds it
    std::vector<Point> parted = {};  ///< where something ends inside a cell
  };

  void note_held(const Meeting& meeting) {
    out_.support_nodes.push_back(meeting.number);
    out_.held.push_back(meeting.at);
  }

  Point point(const Place& at) const { return {at.rod, on_.vertex(at)}; }

  Meeting& owned(const Point& at) {
    const auto [found, added] = owner_.try_emplace(at, nodes_.size());
    if (added) nodes_.push_back({{at}});
    return nodes_[found->second];
  }

  void join(const Joint& joint, std::size_t number) {
    require(joint.points.size() >= 2, "points: a joint needs two or more, got ",
            joint.points.size());
    require((joint.kind == JointKind::hinge) == joint.axis.has_value(),
            "axis: a hinge needs one, other joints have none");
    std::vector<Point> points;
    for (const auto& place : joint.points) points.push_back(point(place));
    const Point first = points[0];
    for (std::size_t i = 1; i < points.size(); ++i)
      require(std::find(points.begin(), points.begin() + std::ptrdiff_t(i), points[i]) ==
                  points.begin() + std::ptrdiff_t(i),
              "joints: the points of joint ", number, " are not different vertices: vertex ",
              points[i].second, " of rod ", points[i].first, " twice");
    owned(first);
    const std::size_t node = owner_.at(first);
    for (std::size_t i = 1; i < points.size(); ++i) {
      const auto [found, added] = owner_.try_emplace(points[i], node);
      require(added || found->second == node, "joints: vertex ", points[i].second, " of rod ",
              points[i].first, " is joined twice");
      nodes_[node].points.push_back(points[i]);
    }
    auto& meeting = nodes_[node];
    meeting.rigid = joint.kind != JointKind::ball;
    if (joint.axis) meeting.hinge = direction(*joint.axis, "axis");
    meeting.turns[points.back()] = checked_turns(joint.turns);
    meeting.aligned = joint.aligned.value_or(are_apart(points));
  }

  bool are_apart(const std::vector<Point>& points) {
    double size = 0, apart = 0;
    for (const auto& rod : scene_.rods) size = std::max(size, rod.length());
    const Vec3 first = at_rest(points[0]).position;
    for (const auto& p : points) apart = std::max(apart, (at_rest(p).position - first).norm());
    return apart > 1e-9 * size;
  }

  void support_on(const Support& support) {
    const Point at = point(place_of(support));
    auto& meeting = owned(at);
    require(!meeting.support, "supports: vertex ", at.second, " of rod ", at.first,
            " is held twice");
    meeting.support = &support;
    meeting.held = at;
    if (const auto* clamp = std::get_if<Clamp>(&support))
      meeting.turns[at] = checked_turns(clamp->turns);
  }

  RoutedTendon routed(const Tendon& tendon) const {
    return pyrod::routed(tendon, on_.rod(tendon.rod).grid,
                         [&](double s) { return on_.vertex({tendon.rod, s}); });
  }

  /// Where a tendon ends or has a kink, and where the rod or its moments jump along it, the halves
  /// of the cell turn each by its own law: a node holds them together.
  void part_cells(const Tendon& tendon) {
    const int rod = tendon.rod;
    const auto of = routed(tendon);
    std::vector<int> at = of.kinks;
    for (const auto& jump : on_.rod(rod).jumps) at.push_back(jump.vertex);
    for (const auto& moment : on_.loads(rod).vertex_moments) at.push_back(moment.vertex);
    std::erase_if(at, [&](int j) { return j < of.first || j > of.last; });
    for (const int j : {of.first, of.last})
      if (j > 0 && j < on_.rod(rod).edges()) at.push_back(j);
    for (const int j : at) part_cell({rod, j});
  }

  void part_cell(const Point& at) {
    auto& meeting = owned(at);
    if (std::ranges::find(meeting.parted, at) != meeting.parted.end()) return;
    require(meeting.rigid || meeting.parted.empty(),
            "actuators: tendons of two rods end, or have kinks, in one ball joint; let them end "
            "beside it");
    meeting.parted.push_back(at);
  }

  static int checked_turns(int turns) {
    constexpr int most = 1000000;
    require(turns >= -most && turns <= most, "turns: must be at most ", most, ", got ", turns);
    return turns;
  }

  void place_rod(int i) {
    auto placement = scene_.rods[std::size_t(i)].placement;
    const bool clamped = std::ranges::any_of(scene_.supports, [&](const Support& support) {
      return place_of(support).rod == i && hold(support, Quaternion::Identity()).frame;
    });
    if (clamped) placement = nearest(placement);
    out_.network.placements.push_back(placement);
  }

  void add(Meeting& meeting) {
    const Point first = meeting.support ? meeting.held : meeting.points[0];
    auto [position, frame] = carried_[std::size_t(first.first)].place(first.second);
    Quaternion own = at_rest(first).frame;  // where the axis of a hinge is told
    Hold held{.frame = false, .free = Hold::everywhere(), .turns = Hold::everywhere()};
    if (meeting.support) {
      position = position_of(*meeting.support).value_or(position);
      if (const auto told = frame_of(*meeting.support)) {
        require_rotation(*told, "supports: frame");
        frame = own = *told;
      }
      held = hold(*meeting.support, frame);
    }
    require(
        meeting.rigid || meeting.parted.empty() || meeting.parted[0] == meeting.held ||
            (!held.frame && held.turns.cols() == 3),
        "actuators: a tendon ends, or has a kink, in a ball joint where a support holds another "
        "rod; let it end beside it");
    require(position.allFinite(), "supports: position: expected finite numbers, got ",
            position.transpose());
    meeting.at = {position, frame};
    const auto near = nearest(meeting.at);
    Node<Spatial> node;
    node.position = meeting.support ? position : near.position;
    node.frame = held.frame || held.turns.cols() < 3 ? frame : near.frame;
    node.free = held.free;
    node.turns = held.turns;
    node.spring = held.spring;
    node.torsion_spring = held.torsion_spring;
    node.parts_cell = !meeting.parted.empty();
    meeting.number = int(out_.network.nodes.size());
    out_.network.nodes.push_back(node);
    for (const auto& at : meeting.points) attach(meeting, at, first, held.frame, own);
  }

  void attach(const Meeting& meeting, const Point& at, const Point& first, bool holds,
              const Quaternion& own) {
    const bool parted = std::ranges::find(meeting.parted, at) != meeting.parted.end();
    const bool rigid = meeting.rigid || parted || (holds && at == meeting.held);
    const auto turns = meeting.turns.find(at);
    Attachment<Spatial> a{at.first, at.second, meeting.number, rigid};
    if (at != first && !meeting.aligned)
      a.relative = at_rest(first).frame.conjugate() * at_rest(at).frame;
    if (turns != meeting.turns.end()) a.turns = turns->second;
    if (meeting.hinge && at != first) a.hinge = unrotate(own, *meeting.hinge);
    out_.network.attachments.push_back(a);
  }

  Placement<Spatial> at_rest(const Point& at) {
    return rest_[std::size_t(at.first)].place(at.second);
  }

  Placement<Spatial> plane() {
    const auto* clamp = scene_.supports.empty() ? nullptr : std::get_if<Clamp>(&scene_.supports[0]);
    if (!clamp) return scene_.rods[0].placement;
    const auto [rod, vertex] = point(clamp->at);
    const auto rest = carried_[std::size_t(rod)].place(vertex);
    return {clamp->position.value_or(rest.position), clamp->frame.value_or(rest.frame)};
  }

  /// The place in the plane of a planar scene, for what is but a start of the search.
  Placement<Spatial> nearest(const Placement<Spatial>& at) const {
    if (scene_.space == Dimension::spatial) return at;
    const auto& [origin, plane] = out_.plane;
    Vec3 local = unrotate(plane, Vec3(at.position - origin));
    local.y() = 0;
    const Quaternion turn = plane.conjugate() * at.frame;
    Quaternion kept(turn.w(), 0, turn.y(), 0);
    if (kept.norm() > 1e-9)
      kept.normalize();
    else
      kept.setIdentity();
    return {origin + rotate(plane, local), plane * kept};
  }

  const SceneOnGrids& on_;
  const Scene& scene_;
  std::vector<Rest> rest_, carried_;
  std::vector<Meeting> nodes_;
  std::map<Point, std::size_t> owner_;
  SceneNetwork out_;
};

}  // namespace detail

inline SceneNetwork network_of(const SceneOnGrids& on) { return detail::NetworkMaker(on).make(); }

/// The same without rods and loads, which an other scene has, too.
inline SceneNetwork nodes_of(const SceneOnGrids& on) {
  return detail::NetworkMaker(on).make_nodes();
}

}  // namespace pyrod
