// SPDX-License-Identifier: BSD-3-Clause
#include "parts.hpp"

#include <pyrod/scene/plane.hpp>
#include <pyrod/statics/known_start.hpp>
#include <pyrod/statics/solver.hpp>

namespace pyrod::bind {

namespace {

Solver scene_of(const std::vector<const GivenRod*>& rods, std::vector<Support> supports,
                std::vector<Joint> joints, std::vector<Load> loads, std::vector<Actuator> actuators,
                const std::string& space) {
  std::vector<RodSpec> specs;
  for (const auto* rod : rods) specs.push_back(rod->spec);
  return Solver(Scene(std::move(specs), std::move(supports), std::move(loads), space_of(space),
                      std::move(joints), std::move(actuators)));
}

/// Others may find it just now, and ask functions of Python for it: the lock must be free.
const ReadyScene& climbing(const Solver& scene) {
  const py::gil_scoped_release release;
  return scene.climbing();
}

/// The rods of a scene that is ready; None for those that are as `given`.
py::list rods_of(const ReadyScene& ready, const std::vector<const GivenRod*>& given) {
  py::list out;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const auto& now = ready.scene().rods[i];
    out.append(same_grid(now, given[i]->spec) ? py::object(py::none()) : py::cast(GivenRod(now)));
  }
  return out;
}

py::tuple placement(const Placement<Spatial>& at) {
  return py::make_tuple(locked(array<3>(at.position)), locked(array(at.frame)));
}

/// Numbers of the rod and of its vertex.
py::tuple vertex(const Solver& scene, const py::object& at) {
  const Place there = place(at);
  const auto& rods = scene.plain().scene().rods;
  require(there.rod < int(rods.size()), "at: there is no rod ", there.rod, ", the scene has ",
          rods.size());
  return py::make_tuple(there.rod, scene.plain().grid().vertex(there));
}

/// Directions (k, 3) in which a support lets its point move, if its frame is the given one.
py::array free_directions(const Solver& scene, int support, const Array& frame) {
  const auto& supports = scene.plain().scene().supports;
  const auto free = hold(supports.at(std::size_t(support)), quaternion(frame, "frame")).free;
  std::vector<Vec3> rows;
  for (Eigen::Index i = 0; i < free.cols(); ++i) rows.emplace_back(free.col(i));
  return array<3>(rows);
}

/// Whether finer grids ask more of the rods than what is linear between their vertices.
bool rods_are_asked(const Solver& scene) {
  return scene.plain().corners() ||
         std::ranges::any_of(scene.plain().scene().rods, [](const RodSpec& rod) {
           return !rod.arrays && (rod.section.index() > 0 || is_function(rod.curvature));
         });
}

/// Frames of the edges without a tolerance, on those with one.
py::array on_climbing_edges(const Solver& scene, const Array& frames) {
  const auto more =
      detail::on_more_edges(quaternions(frames, "start"), scene.plain(), climbing(scene));
  return more.empty() ? py::array(frames) : py::array(array(more));
}

/// Dead forces on the vertices, and moments on the edges and at both ends.
py::tuple dead(const Loads<Spatial>& on) {
  return py::make_tuple(array<3>(on.force), array<3>(on.moment), array<3>(on.start_moment),
                        array<3>(on.end_moment));
}

/// A grid of a solve with a tolerance: edges of the rods, where they are held and joined, loads.
py::tuple level(const Solver& scene, int number) {
  const auto network = [&] {
    const py::gil_scoped_release release;
    return scene.climbing().network_on(number).network;
  }();
  py::list edges, attached, loads;
  for (const auto& rod : network.rods) edges.append(rod.edges());
  for (const auto& a : network.attachments) attached.append(py::make_tuple(a.rod, a.vertex));
  for (const auto& acting : network.loads) loads.append(dead(acting));
  return py::make_tuple(edges, attached, loads);
}

}  // namespace

void scene(py::module_& module) {
  py::class_<Solver> type(module, "Scene", "A scene that is ready to be solved.");
  type.def(py::init(&scene_of), py::arg("rods"), py::arg("supports"), py::arg("joints"),
           py::arg("loads"), py::arg("actuators"), py::arg("space"))
      .def(
          "rods",
          [](const Solver& s, const std::vector<const GivenRod*>& given) {
            return rods_of(s.plain(), given);
          },
          py::arg("given"), "As they are solved; None for those that are as given.")
      .def(
          "climbing_rods",
          [](const Solver& s, const std::vector<const GivenRod*>& given) {
            return rods_of(climbing(s), given);
          },
          py::arg("given"), "The same of a solve with a tolerance.")
      .def("on_climbing_edges", &on_climbing_edges, py::arg("frames"))
      .def("vertex", &vertex, py::arg("at"))
      .def(
          "held",
          [](const Solver& s, int i) {
            return placement(s.plain().network().held.at(std::size_t(i)));
          },
          py::arg("support"))
      .def_property_readonly("plane",
                             [](const Solver& s) { return placement(s.plain().network().plane); })
      .def(
          "leaving_plane",
          [](const Solver& s, int across) {
            return leaving_plane(s.plain().grid(), s.plain().network(), across);
          },
          py::arg("across"), "What leaves the plane across a1 (0) or a2 (1), in words.")
      .def(
          "dead_loads", [](const Solver& s, int rod) { return dead(s.plain().grid().loads(rod)); },
          py::arg("rod"))
      .def("free_directions", &free_directions, py::arg("support"), py::arg("frame"))
      .def_property_readonly("rods_are_asked", &rods_are_asked)
      .def("level", &level, py::arg("number"));
  solving(module, type);
}

}  // namespace pyrod::bind
