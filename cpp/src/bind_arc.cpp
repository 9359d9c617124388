// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/curve/approach.hpp>
#include <pyrod/curve/averages.hpp>
#include <pyrod/curve/bishop.hpp>
#include <pyrod/curve/frenet.hpp>
#include <pyrod/curve/link.hpp>

#include <optional>

namespace pyrod::bind {

namespace {

/// A checked arc, the array that holds its vertices, and its grid.
struct HeldArc {
  Array positions;
  Arc arc;
  Grid grid;
};

std::optional<Vec3> tangent(const std::optional<Array>& given, const char* name) {
  return given ? std::optional(vector3(*given, name)) : std::nullopt;
}

HeldArc held_arc(const Array& positions, bool closed, const std::optional<Array>& start,
                 const std::optional<Array>& end) {
  const Arc arc{view3(positions, "positions"), closed ? Closure::closed : Closure::open,
                tangent(start, "start_tangent"), tangent(end, "end_tangent")};
  const auto checked = [&] {  // what is returned holds the array: not without the lock
    const py::gil_scoped_release release;
    arc.check();
    return arc_length(arc);
  };
  return {positions, arc, checked()};
}

/// Lets Ctrl-C end a long computation.
bool no_signal() {
  const py::gil_scoped_acquire gil;
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  return true;
}

/// One binormal per vertex.
std::vector<Vec3> binormals_of(const HeldArc& self, const Array& b) {
  auto out = vectors<3>(b, "binormals");
  require_count(Eigen::Index(out.size()), self.arc.vertices(), "binormals", "one per vertex");
  return out;
}

py::tuple tuple_of(const Approach& a) { return py::make_tuple(a.distance, a.edge, a.other); }

void bind_invariants(py::class_<HeldArc>& type) {
  type.def_property_readonly("edge_lengths",
                             [](const HeldArc& self) { return array(self.grid.edge_lengths()); })
      .def_property_readonly("cell_lengths",
                             [](const HeldArc& self) { return array(self.grid.cell_lengths()); })
      .def_property_readonly("arc_lengths",
                             [](const HeldArc& self) { return array(self.grid.arc_lengths()); })
      .def("tangents",
           [](const HeldArc& self) { return computed([&] { return tangents(self.arc); }); })
      .def("turning_angles",
           [](const HeldArc& self) { return computed([&] { return turning_angles(self.arc); }); })
      .def(
          "binormals",
          [](const HeldArc& self, const Array& straight) {
            const Vector angles = numbers(straight, "straight");
            return computed([&] { return binormals(self.arc, angles); });
          },
          py::arg("straight"))
      .def(
          "dihedral_angles",
          [](const HeldArc& self, const Array& b) {
            const auto axes = binormals_of(self, b);
            return computed([&] { return dihedral_angles(self.arc, axes); });
          },
          py::arg("binormals"));
}

void bind_frames(py::class_<HeldArc>& type) {
  type.def(
          "vertex_frenet_frames",
          [](const HeldArc& self, const Array& b) {
            const auto axes = binormals_of(self, b);
            return computed([&] { return vertex_frenet_frames(self.arc, axes); });
          },
          py::arg("binormals"))
      .def(
          "edge_frenet_frames",
          [](const HeldArc& self, const Array& b, const Array& α) {
            const auto axes = binormals_of(self, b);
            const Vector angles = numbers(α, "dihedral_angles");
            require_count(angles.size(), self.arc.edges(), "dihedral_angles", "one per edge");
            return computed([&] { return edge_frenet_frames(self.arc, axes, angles); });
          },
          py::arg("binormals"), py::arg("dihedral_angles"))
      .def(
          "bishop_frames",
          [](const HeldArc& self, const Array& start) {
            const Quaternion first =
                adapted(quaternion(start, "start"),
                        self.arc.closed() ? self.arc.edge(0) : self.arc.before(0));
            return py::make_tuple(array(first),
                                  computed([&] { return bishop_frames(self.arc, first); }));
          },
          py::arg("start"))
      .def("holonomy", [](const HeldArc& self) {
        const py::gil_scoped_release release;
        return holonomy(self.arc);
      });
}

void bind_pairs(py::class_<HeldArc>& type) {
  const py::call_guard<py::gil_scoped_release> released;
  type.def(
          "writhe",
          [](const HeldArc& self, int threads) { return writhe(self.arc, threads, no_signal); },
          py::arg("threads"), released)
      .def(
          "gauss_integral",
          [](const HeldArc& self, const HeldArc& other, int threads) {
            return gauss_integral(self.arc, other.arc, threads, no_signal);
          },
          py::arg("other"), py::arg("threads"), released)
      .def(
          "self_approach",
          [](const HeldArc& self, int threads) {
            const auto found = self_approach(self.arc, threads, no_signal);
            const py::gil_scoped_acquire gil;
            return tuple_of(found);
          },
          py::arg("threads"), released)
      .def(
          "approach",
          [](const HeldArc& self, const HeldArc& other, int threads) {
            const auto found = approach(self.arc, other.arc, threads, no_signal);
            const py::gil_scoped_acquire gil;
            return tuple_of(found);
          },
          py::arg("other"), py::arg("threads"), released);
}

}  // namespace

void arc(py::module_& module) {
  auto m = module.attr("curve").cast<py::module_>();
  auto type = py::class_<HeldArc>(m, "Arc", "A polygonal arc, checked.");
  type.def(py::init(&held_arc), py::arg("positions"), py::arg("closed"), py::arg("start_tangent"),
           py::arg("end_tangent"));
  bind_invariants(type);
  bind_frames(type);
  bind_pairs(type);
}

}  // namespace pyrod::bind
