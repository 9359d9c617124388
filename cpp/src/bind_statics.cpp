// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/level.hpp>
#include "job.hpp"

namespace pyrod::bind {

namespace {

template <class T>
void assign(T& member, const py::handle& value, const char* name) {
  try {
    member = value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(text(name, ": expected a ", std::is_integral_v<T> ? "whole " : "",
                              "number, got ", py::cast<std::string>(py::repr(value))));
  }
}

/// Keyword constructor, attributes, repr and pickling of a struct that lists its fields.
template <class T>
void bind_fields(py::module_& module, const char* name, const char* doc) {
  auto type = py::class_<T>(module, name, doc);
  const auto each = [](auto&& f) {
    std::apply([&](const auto&... field) { (f(field), ...); }, T::fields());
  };
  const auto from = [each](const py::dict& values) {
    T out;
    std::size_t known = 0;
    each([&](const auto& field) {
      if (!values.contains(field.name)) return;
      ++known;
      assign(out.*field.member, values[field.name], field.name);
    });
    if (known != values.size()) {
      std::string names;
      each([&](const auto& field) {
        names += (names.empty() ? "" : ", ") + std::string(field.name);
      });
      throw py::type_error("unknown option among the keywords; there are: " + names);
    }
    out.check();
    return out;
  };
  const auto to_dict = [each](const T& self) {
    py::dict values;
    each([&](const auto& field) { values[field.name] = self.*field.member; });
    return values;
  };
  type.def(py::init([from, name](const py::args& given, const py::kwargs& values) {
    if (!given.empty()) throw py::type_error(std::string(name) + ": give them by keyword");
    return from(values);
  }));
  each([&](const auto& field) { type.def_readonly(field.name, field.member, field.doc); });
  type.def("__repr__", [to_dict, name](const T& self) {
    std::string inside;
    for (const auto& [key, value] : to_dict(self))
      inside += text(inside.empty() ? "" : ", ", py::cast<std::string>(key), "=",
                     py::cast<std::string>(py::repr(value)));
    return std::string(name) + "(" + inside + ")";
  });
  type.def("__eq__", [to_dict](const T& a, const py::object& b) {
    return py::isinstance<T>(b) && to_dict(a).equal(to_dict(b.cast<const T&>()));
  });
  type.def("__hash__", [](const py::object& self) { return py::hash(py::repr(self)); });
  type.def(py::pickle(to_dict, from));
}

/// The rod and its loads must not change while the job waits.
Job cantilever_job(const py::object& rod, Dimension dimension, ModelKind model,
                   const Array& position, const Array& frame, const py::object& loads,
                   const std::optional<py::tuple>& start, const Options& options) {
  const Placement<Spatial> clamp{vector3(position, "position"), quaternion(frame, "frame")};
  const auto& of = rod.cast<const Rod<Spatial>&>();
  const auto& under = loads.cast<const GridLoads&>().loads;
  const auto frames = start_frames(start, of.edges());
  const int unknowns = of.edges() * (dimension == Dimension::spatial ? 3 : 1);
  const auto work = [=, &of, &under](const Trace& trace) -> Outcome {
    auto found = in_space(dimension, [&]<class Space>(Space) {
      return solve<Space>(in_model(of, model), clamp, under, frames, options, trace);
    });
    return {scene_solution(std::move(found), unknowns), {}};
  };
  return {work, {rod, loads}};
}

/// One vector per edge.
std::vector<Vec3> per_edge(const GridLoads& self, const Array& values, const char* name) {
  auto out = vectors<3>(values, name);
  require_count(Eigen::Index(out.size()), self.grid.edges(), name, "one per edge");
  return out;
}

using L = Loads<Spatial>;

/// A load at a place, on this grid and on finer ones.
using AddAt = void (L::*)(const Grid&, const Vec3&, const Site&);
void add_at(GridLoads& self, AddAt add, const Vec3& value, double s) {
  self.add([=, at = Site::on(self.places, s)](L& loads, const Grid& grid, int parts) {
    (loads.*add)(grid, value, at.refined(parts));
  });
}

/// A load along the rod, the same all over each edge of this grid.
template <class Add>
void add_along(GridLoads& self, const Add& add, std::vector<Vec3> values) {
  self.add(
      [add, values = std::move(values), given = self.parts](L& loads, const Grid& grid, int all) {
        const int parts = all / given;
        if (parts == 1) return (loads.*add)(grid, values);
        std::vector<Vec3> repeated;
        repeated.reserve(values.size() * std::size_t(parts));
        for (const auto& value : values) repeated.insert(repeated.end(), std::size_t(parts), value);
        (loads.*add)(grid, repeated);
      });
}

}  // namespace

void statics(py::module_& module) {
  bind_fields<Options>(module, "Options", "What may be tuned in a solve; keywords only.");

  py::enum_<Dimension>(module, "Dimension")
      .value("planar", Dimension::planar)
      .value("spatial", Dimension::spatial);

  py::class_<GridLoads>(module, "Loads")
      .def(py::init<const Rod<Spatial>&>(), py::arg("rod"))
      .def(py::init([](const Rod<Spatial>& rod, const GridLoads& level0) {
             return GridLoads(rod, level0.grid);
           }),
           py::arg("rod"), py::arg("level0"),
           "level0: the loads of the coarsest grid, where places are found.")
      .def(
          "add_force",
          [](GridLoads& self, const Array& F, double s) {
            add_at(self, &L::add_force, vector3(F, "force"), s);
          },
          py::arg("force"), py::arg("at"))
      .def(
          "add_moment",
          [](GridLoads& self, const Array& M, double s) {
            add_at(self, &L::add_couple, vector3(M, "moment"), s);
          },
          py::arg("moment"), py::arg("at"))
      .def(
          "add_distributed_force",
          [](GridLoads& self, const Array& f) {
            add_along(self, &L::add_force_per_length, per_edge(self, f, "force_per_length"));
          },
          py::arg("force_per_length"))
      .def(
          "add_distributed_moment",
          [](GridLoads& self, const Array& l) {
            add_along(self, &L::add_couple_per_length, per_edge(self, l, "moment_per_length"));
          },
          py::arg("moment_per_length"))
      .def(
          "add_following_force",
          [](GridLoads& self, const Array& F, double s) {
            self.add([value = vector3(F, "force"), at = Site::on(self.places, s), K0 = self.K0](
                         L& loads, const Grid& grid, int parts) {
              loads.add_following_force(grid, value, at.refined(parts), K0);
            });
          },
          py::arg("force"), py::arg("at"))
      .def(
          "add_following_moment",
          [](GridLoads& self, const Array& M, double s) {
            const Site at = Site::on(self.places, s);
            self.add([value = vector3(M, "moment"), at, compliance = self.compliance(at)](
                         L& loads, const Grid& grid, int parts) {
              loads.add_following_couple(grid, value, at.refined(parts), compliance);
            });
          },
          py::arg("moment"), py::arg("at"))
      .def(
          "add_following_distributed_force",
          [](GridLoads& self, const Array& f) {
            add_along(self, &L::add_following_force_per_length,
                      per_edge(self, f, "force_per_length"));
          },
          py::arg("force_per_length"))
      .def(
          "add_following_distributed_moment",
          [](GridLoads& self, const Array& l) {
            add_along(self, &L::add_following_couple_per_length,
                      per_edge(self, l, "moment_per_length"));
          },
          py::arg("moment_per_length"))
      .def_property_readonly("force",
                             [](const GridLoads& self) { return array<3>(self.loads.force); })
      .def_property_readonly("moment",
                             [](const GridLoads& self) { return array<3>(self.loads.couple); })
      .def_property_readonly("end_moment",
                             [](const GridLoads& self) { return array<3>(self.loads.end_couple); })
      .def_property_readonly(
          "start_moment", [](const GridLoads& self) { return array<3>(self.loads.start_couple); });

  module.def("cantilever_job", &cantilever_job, py::arg("rod"), py::arg("dimension"),
             py::arg("model"), py::arg("position"), py::arg("frame"), py::arg("loads"),
             py::arg("start"), py::arg("options"));
}

}  // namespace pyrod::bind
