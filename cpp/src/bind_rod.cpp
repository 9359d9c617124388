// SPDX-License-Identifier: BSD-3-Clause
#include "curve.hpp"
#include "function.hpp"
#include "parts.hpp"

#include <pyrod/rod/energy.hpp>
#include <pyrod/scene/rod_spec.hpp>

namespace pyrod::bind {

namespace {

/// The full Hessian as compressed columns: data, row numbers, column starts.
py::tuple columns(Eigen::SparseMatrix<double> H) {
  H.makeCompressed();
  const py::ssize_t entries = H.nonZeros(), starts = H.cols() + 1;
  return py::make_tuple(py::array_t<double>(entries, H.valuePtr()),
                        py::array_t<int>(entries, H.innerIndexPtr()),
                        py::array_t<int>(starts, H.outerIndexPtr()));
}

py::tuple energy_at(const GivenRod& given, const Array& r, const Array& q,
                    const std::optional<Array>& start, const std::optional<Array>& end) {
  const auto& rod = given.made.rod;
  const auto curve = framed_curve(rod.grid, r, q, start, end);
  const HeldEnds held{start.has_value(), end.has_value()};
  const auto jet = energy<Spatial>(in_model(rod, given.model()), curve, held);
  return py::make_tuple(jet.bend_twist, jet.stretch_shear, array(jet.gradient),
                        columns(jet.hessian));
}

/// (EI1, EI2, GJ, GA1, GA2, EA, mass per length)
Section section_of(const double* row) {
  return {row[0], row[1], row[2], row[3], row[4], row[5], row[6]};
}

/// One row, one per edge, or a function of arc length that returns one.
Along<Section> sections_of(const py::object& given) {
  if (PyCallable_Check(given.ptr()))
    return [f = Function(given)](double s) {
      return f(s, [](const py::object& row) { return section_of(row.cast<Array>().data()); });
    };
  const auto rows = given.cast<Array>();
  if (rows.ndim() == 1) return section_of(rows.data());
  std::vector<Section> out;
  for (py::ssize_t i = 0; i < rows.shape(0); ++i) out.push_back(section_of(rows.data(i, 0)));
  return out;
}

Along<Vec3> curvature_of(const py::object& given) {
  if (PyCallable_Check(given.ptr()))
    return [f = Function(given)](double s) {
      return f(s, [](const py::object& K) {
        return Vec3(Eigen::Map<const Vec3>(K.cast<Array>().data()));
      });
    };
  const auto a = given.cast<Array>();
  if (a.ndim() == 1) return Vec3(Eigen::Map<const Vec3>(a.data()));
  const auto rows = view3(a, "curvature");
  return std::vector<Vec3>(rows.begin(), rows.end());
}

std::vector<double> list_of(const Array& a) { return {a.data(), a.data() + a.size()}; }

Placement<Spatial> placement_of(const Array& r0, const Array& q0) {
  return {vector3(r0, "position"), quaternion(q0, "frame")};
}

GivenRod of_sections(const Array& h, const py::object& section, const py::object& curvature,
                     bool corners, const std::optional<std::string>& model, bool chooses,
                     const Array& r0, const Array& q0) {
  auto spec = precurved(numbers(h, "edge_lengths"), sections_of(section), curvature_of(curvature),
                        model ? std::optional(model_of(*model)) : std::nullopt);
  spec.corners = corners;
  spec.chooses = chooses;
  if (chooses) spec.kept = detail::steps(spec);
  spec.placement = placement_of(r0, q0);
  return GivenRod(std::move(spec));
}

/// `sides`: one (4, 3) for each jump, stiffness and rest curvature before the vertex, and behind.
GivenRod of_arrays(const Array& h, const Array& bending, const Array& stretching, const Array& K0,
                   const Array& mass, bool corners, const std::vector<int>& jumps,
                   const Array& sides, const std::string& model, const Array& r0, const Array& q0) {
  require(sides.ndim() == 3 && sides.shape(0) == py::ssize_t(jumps.size()) && sides.shape(1) == 4 &&
              sides.shape(2) == 3,
          "sides: expected shape (", jumps.size(), ", 4, 3), got ", shape_of(sides));
  const auto rigid = view3(stretching, "stretching");  // may be infinite
  RodArrays arrays{vectors<3>(bending, "bending"), {rigid.begin(), rigid.end()}, list_of(mass)};
  for (std::size_t i = 0; i < jumps.size(); ++i) {
    const auto side = [&](int k) { return Vec3(sides.data(py::ssize_t(i), k, 0)); };
    arrays.jumps.push_back({jumps[i], side(0), side(1), side(2), side(3)});
  }
  auto spec = discrete(numbers(h, "edge_lengths"), std::move(arrays), vectors<3>(K0, "K0"),
                       model_of(model));
  spec.corners = corners;
  spec.placement = placement_of(r0, q0);
  return GivenRod(std::move(spec));
}

/// On other edges; `kept`: the solver chooses them, but for these vertices. `marks`: where
/// functions may jump.
GivenRod on(const GivenRod& rod, const Array& h, const std::optional<std::vector<double>>& kept,
            const std::vector<double>& marks) {
  RodSpec spec = rod.spec;
  spec.marks = marks;
  spec.edge_lengths = numbers(h, "edge_lengths");
  spec.chooses = kept.has_value();
  spec.kept = kept.value_or(std::vector<double>{});
  return GivenRod(std::move(spec));
}

GivenRod replaced(const GivenRod& rod, const std::string& model, const Array& r0, const Array& q0) {
  GivenRod out = rod;
  out.spec.model = model_of(model);
  out.spec.placement = placement_of(r0, q0);
  return out;
}

/// Numbers of the vertices, and what is on both sides of each, as `of_arrays` takes it.
py::tuple jumps(const GivenRod& given) {
  const auto& list = given.made.rod.jumps;
  std::vector<int> at;
  py::array_t<double> sides({py::ssize_t(list.size()), py::ssize_t(4), py::ssize_t(3)});
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto& jump = list[i];
    at.push_back(jump.vertex);
    const Vec3* parts[] = {&jump.bending_before, &jump.K0_before, &jump.bending_behind,
                           &jump.K0_behind};
    for (int k = 0; k < 4; ++k)
      Eigen::Map<Vec3>(sides.mutable_data(py::ssize_t(i), k, 0)) = *parts[k];
  }
  return py::make_tuple(at, sides);
}

/// Vertices that are kept; None: the solver does not choose the edges.
std::optional<std::vector<double>> kept(const GivenRod& given) {
  return given.spec.chooses ? std::optional(given.spec.kept) : std::nullopt;
}

}  // namespace

void rod(py::module_& module) {
  py::class_<GivenRod> type(module, "Rod", "A rod as it was given, and on its grid.");
  type.def_static("of_sections", &of_sections, py::arg("edge_lengths"), py::arg("section"),
                  py::arg("curvature"), py::arg("corners"), py::arg("model"), py::arg("chooses"),
                  py::arg("position"), py::arg("frame"))
      .def_static("of_arrays", &of_arrays, py::arg("edge_lengths"), py::arg("bending"),
                  py::arg("stretching"), py::arg("K0"), py::arg("mass"), py::arg("corners"),
                  py::arg("jumps"), py::arg("sides"), py::arg("model"), py::arg("position"),
                  py::arg("frame"))
      .def("on", &on, py::arg("edge_lengths"), py::arg("kept"), py::arg("marks"))
      .def(
          "with_vertices",
          [](const GivenRod& rod, const Array& at) {
            auto spec = with_vertices(rod.spec, list_of(at));
            return same_grid(spec, rod.spec) ? std::nullopt
                                             : std::optional(GivenRod(std::move(spec)));
          },
          py::arg("at"), "None: they are there.")
      .def("replaced", &replaced, py::arg("model"), py::arg("position"), py::arg("frame"))
      .def(
          "at_rest",
          [](const GivenRod& given, const Array& r0, const Array& q0) {
            const auto curve =
                given.made.rod.at_rest(vector3(r0, "position"), quaternion(q0, "frame"));
            return py::make_tuple(array<3>(curve.positions), array(curve.frames));
          },
          py::arg("position"), py::arg("frame"))
      .def("energy", &energy_at, py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
           py::arg("end_frame"))
      .def_property_readonly("jumps", &jumps)
      .def_property_readonly("kept", &kept)
      .def_property_readonly("marks", [](const GivenRod& g) { return g.spec.marks; })
      .def_property_readonly("edges", [](const GivenRod& g) { return g.spec.edges(); })
      .def_property_readonly("length", [](const GivenRod& g) { return g.made.rod.grid.length(); });
  const auto given = [&type](const char* name, auto&& get) {
    type.def_property_readonly(name, [get](const GivenRod& g) { return locked(array(get(g))); });
  };
  given("edge_lengths", [](const GivenRod& g) { return g.spec.edge_lengths; });
  given("bending", [](const GivenRod& g) { return g.made.rod.bending; });
  given("stretching", [](const GivenRod& g) { return g.made.rod.stretching; });
  given("K0", [](const GivenRod& g) { return g.made.rod.K0; });
  given("arc_lengths", [](const GivenRod& g) { return g.made.rod.grid.arc_lengths(); });
  given("mass_per_length", [](const GivenRod& g) {
    return Vector(Eigen::Map<const Vector>(g.made.mass.data(), std::ssize(g.made.mass)));
  });
  type.def_property_readonly("model", [](const GivenRod& g) { return name(g.model()); });

  module.def(
      "natural_edges",
      [](double length, const py::object& curvature) {
        return detail::natural_edges(length, curvature_of(curvature));
      },
      py::arg("length"), py::arg("curvature"));
}

}  // namespace pyrod::bind
