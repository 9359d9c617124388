// SPDX-License-Identifier: BSD-3-Clause
#include "statics.hpp"

namespace pyrod::bind {

py::dict record(const std::vector<Iteration>& lines) {
  const auto column = [&](auto&& value) {
    using T = std::decay_t<decltype(value(lines[0]))>;
    py::array_t<T> out{py::ssize_t(lines.size())};
    for (std::size_t i = 0; i < lines.size(); ++i) out.mutable_at(py::ssize_t(i)) = value(lines[i]);
    return out;
  };
  using I = Iteration;
  py::dict out;
  out["exact"] = column([](const I& i) { return i.curvature == Curvature::exact; });
  out["energy"] = column([](const I& i) { return i.energy; });
  out["residual"] = column([](const I& i) { return i.residual; });
  out["step"] = column([](const I& i) { return i.step; });
  out["fraction"] = column([](const I& i) { return i.fraction; });
  out["shift"] = column([](const I& i) { return i.shift; });
  out["factorisations"] = column([](const I& i) { return i.factorisations; });
  return out;
}

py::dict rod_results(const Grid& grid, const RodSolution<Spatial>& s) {
  py::dict out;
  out["positions"] = array<3>(s.curve.positions);
  out["frames"] = array(s.curve.frames);
  out["vertex_frames"] = array(vertex_frames(grid, s.curve));
  out["K"] = array<3>(s.strains.K);
  out["Gamma"] = array<3>(s.strains.Γ);
  out["force"] = array<3>(s.force);
  out["material_force"] = array<3>(s.material_force);
  out["moment"] = array<3>(s.moment);
  out["material_moment"] = array<3>(s.material_moment);
  out["load"] = array<3>(s.load);
  out["load_moment"] = array<3>(s.load_moment);
  out["bend_twist_energy"] = s.bend_twist_energy;
  out["stretch_shear_energy"] = s.stretch_shear_energy;
  return out;
}

void add_status(py::dict& out, Status status, const std::vector<Iteration>& lines) {
  out["status"] = std::string(name(status));
  out["advice"] = std::string(advice(status));
  out["record"] = record(lines);
}

/// Looks for Ctrl-C once per iteration and shows the iteration to Python, if that is wanted.
Trace python_trace(const std::optional<py::function>& show) {
  return [&show](const Iteration& i) {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!show) return true;
    const auto go_on = (*show)(i.energy, i.residual, i.step, i.fraction, i.shift);
    return go_on.is_none() || go_on.cast<bool>();
  };
}

namespace {

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
      auto& member = out.*field.member;
      member = values[field.name].template cast<std::decay_t<decltype(member)>>();
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
  type.def(py::init([from](const py::kwargs& values) { return from(values); }));
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

py::dict solve_rod(const Rod<Spatial>& rod, Dimension dimension, ModelKind model,
                   const Array& position, const Array& frame, const GridLoads& loads,
                   const std::optional<Array>& start, const Options& options,
                   const std::optional<py::function>& trace) {
  const Clamp clamp{vector3(position, "position"), quaternion(frame, "frame")};
  std::vector<Quaternion> frames;
  if (start) {
    frames = quaternions(*start, "start");
    require_count(Eigen::Index(frames.size()), rod.edges(), "start", "one frame per edge");
  }
  const auto show = python_trace(trace);
  Solution<Spatial> solution;
  {
    const py::gil_scoped_release release;
    solution = solve(rod, dimension, model, clamp, loads.loads, frames, options, show);
  }
  py::dict out;
  out["rods"] = py::make_tuple(rod_results(rod.grid, solution));
  add_status(out, solution.status, solution.record);
  out["index"] = solution.index;
  out["residual"] = solution.residual;
  out["load_steps"] = solution.load_steps;
  return out;
}

/// One vector per edge.
std::vector<Vec3> per_edge(const GridLoads& self, const Array& values, const char* name) {
  auto out = vectors<3>(values, name);
  require_count(Eigen::Index(out.size()), self.grid.edges(), name, "one per edge");
  return out;
}

}  // namespace

void statics(py::module_& module) {
  bind_fields<Options>(module, "Options", "What may be tuned in a solve; keywords only.");

  py::enum_<Dimension>(module, "Dimension")
      .value("planar", Dimension::planar)
      .value("spatial", Dimension::spatial);

  py::class_<GridLoads>(module, "Loads")
      .def(py::init([](const Rod<Spatial>& rod) {
             return GridLoads{rod.grid, Loads<Spatial>(rod.edges())};
           }),
           py::arg("rod"))
      .def(
          "add_force",
          [](GridLoads& self, const Array& F, double s) {
            self.loads.add_force(self.grid, vector3(F, "force"), s);
          },
          py::arg("force"), py::arg("at"))
      .def(
          "add_moment",
          [](GridLoads& self, const Array& M, double s) {
            self.loads.add_couple(self.grid, vector3(M, "moment"), s);
          },
          py::arg("moment"), py::arg("at"))
      .def(
          "add_distributed_force",
          [](GridLoads& self, const Array& f) {
            self.loads.add_force_per_length(self.grid, per_edge(self, f, "force_per_length"));
          },
          py::arg("force_per_length"))
      .def(
          "add_distributed_moment",
          [](GridLoads& self, const Array& l) {
            self.loads.add_couple_per_length(self.grid, per_edge(self, l, "moment_per_length"));
          },
          py::arg("moment_per_length"))
      .def(
          "add_following_force",
          [](GridLoads& self, const Array& F, double s) {
            self.loads.add_following_force(self.grid, vector3(F, "force"), s);
          },
          py::arg("force"), py::arg("at"))
      .def(
          "add_following_moment",
          [](GridLoads& self, const Array& M, double s) {
            self.loads.add_following_couple(self.grid, vector3(M, "moment"), s);
          },
          py::arg("moment"), py::arg("at"))
      .def(
          "add_following_distributed_force",
          [](GridLoads& self, const Array& f) {
            self.loads.add_following_force_per_length(self.grid,
                                                      per_edge(self, f, "force_per_length"));
          },
          py::arg("force_per_length"))
      .def(
          "add_following_distributed_moment",
          [](GridLoads& self, const Array& l) {
            self.loads.add_following_couple_per_length(self.grid,
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
          "start_moment", [](const GridLoads& self) { return array<3>(self.loads.start_couple); })
      .def_property_readonly("start_share",
                             [](const GridLoads& self) { return array<3>(self.loads.start_share); })
      .def_property_readonly("end_share",
                             [](const GridLoads& self) { return array<3>(self.loads.end_share); });

  module.def("solve", &solve_rod, py::arg("rod"), py::arg("dimension"), py::arg("model"),
             py::arg("position"), py::arg("frame"), py::arg("loads"), py::arg("start"),
             py::arg("options"), py::arg("trace"));
}

}  // namespace pyrod::bind
