// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/level.hpp>
#include "job.hpp"

namespace pyrod::bind {

namespace {

/// k orthonormal directions, (k, 3), as columns.
Directions<3> directions(const Array& rows, const char* name) {
  Directions<3> out(3, rows.shape(0));
  const auto given = vectors<3>(rows, name);
  for (std::size_t i = 0; i < given.size(); ++i) out.col(Eigen::Index(i)) = given[i];
  return out;
}

int add_node(Network<Spatial>& net, const Array& position, const Array& free, const Array& frame,
             const Array& turns, double spring, double torsion_spring) {
  Node<Spatial> node;
  node.position = vector3(position, "position");
  node.free = directions(free, "free");
  node.frame = quaternion(frame, "frame");
  node.turns = directions(turns, "turns");
  node.spring = spring;
  node.torsion_spring = torsion_spring;
  net.nodes.push_back(node);
  return int(net.nodes.size()) - 1;
}

Job network_job(const py::object& self, Dimension dimension, const Array& origin,
                const Array& frame, const std::optional<py::tuple>& start, const Options& options,
                bool stable, bool eigenvalue) {
  const auto& net = self.cast<const Network<Spatial>&>();
  const Placement<Spatial> at{vector3(origin, "origin"), quaternion(frame, "frame")};
  const auto from = start_of(start);
  const NetworkOptions more{stable, eigenvalue};
  const auto work = [=, &net](const Trace& trace) -> Outcome {
    return in_space(dimension, [&]<class Space>(Space) -> Outcome {
      return {scene_solution(run<Space>(net, at, from, options, more, trace)), {}};
    });
  };
  return {work, {self}};
}

}  // namespace

void network(py::module_& module) {
  py::class_<Network<Spatial>>(module, "Network", "Rods that meet in nodes.")
      .def(py::init())
      .def(
          "add_rod",
          [](Network<Spatial>& net, const Rod<Spatial>& rod, ModelKind model,
             const GridLoads& loads, const Array& position, const Array& frame) {
            net.rods.push_back(in_model(rod, model));
            net.loads.push_back(loads.loads);
            net.placements.push_back({vector3(position, "position"), quaternion(frame, "frame")});
          },
          py::arg("rod"), py::arg("model"), py::arg("loads"), py::arg("position"), py::arg("frame"))
      .def("add_node", &add_node, py::arg("position"), py::arg("free"), py::arg("frame"),
           py::arg("turns"), py::arg("spring"), py::arg("torsion_spring"))
      .def(
          "attach",
          [](Network<Spatial>& net, int rod, int vertex, int node, bool rigid,
             const Array& relative, int turns, const std::optional<Array>& hinge) {
            net.attachments.push_back(
                {rod, vertex, node, rigid, quaternion(relative, "relative"), turns});
            if (hinge) net.attachments.back().hinge = vector3(*hinge, "hinge");
          },
          py::arg("rod"), py::arg("vertex"), py::arg("node"), py::arg("rigid"), py::arg("relative"),
          py::arg("turns"), py::arg("hinge"))
      .def("job", &network_job, py::arg("dimension"), py::arg("origin"), py::arg("frame"),
           py::arg("start"), py::arg("options"), py::arg("stable"), py::arg("eigenvalue"));
}

}  // namespace pyrod::bind
