// SPDX-License-Identifier: BSD-3-Clause
#include "job.hpp"

#include <pyrod/core/parallel.hpp>

namespace pyrod::bind {

namespace {

using SharedOutcome = std::shared_ptr<const Outcome>;
using SharedRod = std::shared_ptr<const RodSolution<Spatial>>;

void lock(py::array& a) {
  py::detail::array_proxy(a.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

/// Read-only array of vectors that belong to `owner`, or of a copy.
py::array view(const std::vector<Vec3>& rows, const py::object& owner) {
  const auto* data = reinterpret_cast<const double*>(rows.data());
  py::array_t<double> out({py::ssize_t(rows.size()), py::ssize_t(3)}, data, owner);
  lock(out);
  return out;
}
template <class Rows>
py::array copied(const Rows& rows) {
  auto out = array(rows);
  lock(out);
  return out;
}

/// What holds just before every vertex: a copy of what holds behind, but where that differs.
template <class Get>
py::array before(const std::vector<Vec3>& behind, const std::vector<Before<Spatial>>& before,
                 Get&& get) {
  auto rows = behind;
  for (const auto& b : before) rows[std::size_t(b.vertex)] = get(b);
  return copied(rows);
}

/// The record of a solve as columns, one line per iteration.
py::dict record(const std::vector<Iteration>& lines) {
  const auto column = [&](auto&& value) {
    using T = std::decay_t<decltype(value(lines[0]))>;
    py::array_t<T> out{py::ssize_t(lines.size())};
    for (std::size_t i = 0; i < lines.size(); ++i) out.mutable_at(py::ssize_t(i)) = value(lines[i]);
    lock(out);
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

/// Largest turn from edge to edge [rad] and its vertex; least stretch and its edge; largest strain,
/// its edge, and whether it is a shear.
py::tuple doubts(const RodSolution<Spatial>& s, const Rod<Spatial>& rod) {
  double turn = 0, stretch = std::numeric_limits<double>::infinity();
  double strain = 0;
  int vertex = 0, edge = 0, strained = 0, component = 0;
  for (int j = 0; j < int(s.strains.K.size()); ++j)
    if (const double u = rod.grid.Δs(j) * s.strains.K[j].norm(); !(u <= turn)) turn = u, vertex = j;
  for (int j = 0; j < int(s.strains.Γ.size()); ++j) {
    if (const double Γ = s.strains.Γ[j].z(); !(Γ >= stretch)) stretch = Γ, edge = j;
    Eigen::Index most = 0;
    const double here = (s.strains.Γ[j] - Vec3::UnitZ()).cwiseAbs().maxCoeff(&most);
    if (here > strain) strain = here, strained = j, component = int(most);
  }
  return py::make_tuple(turn, vertex, stretch, edge, strain, strained, component < 2);
}

void bind_rod_solution(py::module_& module) {
  using S = RodSolution<Spatial>;
  auto type = py::class_<S, std::shared_ptr<S>>(module, "RodSolution", "One rod in equilibrium.");
  const auto vectors = [&](const char* name, auto&& get) {
    type.def_property_readonly(
        name, [get](const py::object& self) { return view(get(self.cast<const S&>()), self); });
  };
  vectors("positions", [](const S& s) -> const auto& { return s.curve.positions; });
  vectors("K", [](const S& s) -> const auto& { return s.strains.K; });
  vectors("Gamma", [](const S& s) -> const auto& { return s.strains.Γ; });
  vectors("force", [](const S& s) -> const auto& { return s.force; });
  vectors("vertex_force", [](const S& s) -> const auto& { return s.vertex_force; });
  vectors("material_force", [](const S& s) -> const auto& { return s.material_force; });
  vectors("moment", [](const S& s) -> const auto& { return s.moment; });
  vectors("material_moment", [](const S& s) -> const auto& { return s.material_moment; });
  vectors("load", [](const S& s) -> const auto& { return s.load; });
  type.def_property_readonly("K_before",
                             [](const S& s) {
                               return before(s.strains.K, s.before,
                                             [](const auto& b) { return b.K; });
                             })
      .def_property_readonly("vertex_force_before",
                             [](const S& s) {
                               return before(s.vertex_force, s.before,
                                             [](const auto& b) { return b.force; });
                             })
      .def_property_readonly("moment_before", [](const S& s) {
        return before(s.moment, s.before, [](const auto& b) { return b.moment; });
      });
  type.def_property_readonly("largest_K", [](const S& s) { return s.largest.K; })
      .def_property_readonly("largest_force", [](const S& s) { return s.largest.force; })
      .def_property_readonly("largest_moment", [](const S& s) { return s.largest.moment; });
  type.def_property_readonly("frames", [](const S& s) { return copied(s.curve.frames); })
      .def_property_readonly("vertex_frames", [](const S& s) { return copied(s.vertex_frames); })
      .def_property_readonly("load_moment", [](const S& s) { return copied<Vec3>(s.load_moment); })
      .def_readonly("bend_twist_energy", &S::bend_twist_energy)
      .def_readonly("stretch_shear_energy", &S::stretch_shear_energy)
      .def("doubts", &doubts, py::arg("rod"));
}

template <class Get>
auto of_nodes(const Get& get) {
  return [get](const Outcome& o) {
    std::vector<std::decay_t<decltype(get(o.solution.nodes[0]))>> out;
    for (const auto& node : o.solution.nodes) out.push_back(get(node));
    return copied(out);
  };
}

py::object reached(const Outcome& o) {
  if (!o.reached) return py::none();
  const auto& r = *o.reached;
  py::dict errors;
  for (int i = 0; i < quantities; ++i) errors[quantity_names[std::size_t(i)]] = r.errors[i];
  return py::make_tuple(errors, r.order, r.regular, r.levels, r.edges, std::string(name(r.ended)));
}

void bind_outcome(py::module_& module) {
  using N = NodeSolution<Spatial>;
  py::class_<Outcome, std::shared_ptr<Outcome>> type(module, "Solution", "A scene, solved.");
  const auto field = [&](const char* name, auto SceneSolution::* member) {
    type.def_property_readonly(name, [member](const Outcome& o) { return o.solution.*member; });
  };
  field("index", &SceneSolution::index);
  field("residual", &SceneSolution::residual);
  field("load_steps", &SceneSolution::load_steps);
  field("descents", &SceneSolution::descents);
  field("unknowns", &SceneSolution::unknowns);
  field("multipliers", &SceneSolution::multipliers);
  field("fill", &SceneSolution::fill);
  field("neutral", &SceneSolution::neutral);
  field("lowest_eigenvalue", &SceneSolution::lowest_eigenvalue);
  type.def_property_readonly("rods",
                             [](const std::shared_ptr<Outcome>& o) {
                               py::tuple out(o->solution.rods.size());
                               for (std::size_t i = 0; i < o->solution.rods.size(); ++i)
                                 out[i] =
                                     std::shared_ptr<RodSolution<Spatial>>(o, &o->solution.rods[i]);
                               return out;
                             })
      .def_property_readonly("status",
                             [](const Outcome& o) { return std::string(name(o.solution.status)); })
      .def_property_readonly(
          "advice", [](const Outcome& o) { return std::string(advice(o.solution.status)); })
      .def_property_readonly("record", [](const Outcome& o) { return record(o.solution.record); })
      .def_property_readonly("mode",
                             [](const Outcome& o) {
                               return o.solution.mode.empty() ? py::object(py::none())
                                                              : copied(o.solution.mode);
                             })
      .def_property_readonly("node_positions", of_nodes([](const N& n) { return n.position; }))
      .def_property_readonly("node_frames", of_nodes([](const N& n) { return n.frame; }))
      .def_property_readonly("reaction_forces",
                             of_nodes([](const N& n) { return n.reaction_force; }))
      .def_property_readonly("reaction_moments",
                             of_nodes([](const N& n) { return n.reaction_moment; }))
      .def_property_readonly("reached", &reached);
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

std::shared_ptr<Outcome> run(const Job& job, const std::optional<py::function>& trace) {
  const auto show = python_trace(trace);
  const py::gil_scoped_release release;
  return std::make_shared<Outcome>(job.work(show));
}

/// The jobs on several threads; `progress` sees how many are done. What a job throws is thrown
/// here, with the number of its scene, when all threads have ended.
std::vector<std::shared_ptr<Outcome>> run_all(const std::vector<const Job*>& jobs,
                                              const std::vector<int>& numbers, int threads,
                                              const std::optional<py::function>& progress) {
  std::vector<std::shared_ptr<Outcome>> out(jobs.size());
  std::atomic<int> done{0};
  const auto look = [&] {
    const py::gil_scoped_acquire gil;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (progress) (*progress)(done.load());
    return true;
  };
  {
    const py::gil_scoped_release release;
    for_each_row(int(jobs.size()), threads, look, [&](int i) {
      try {
        out[std::size_t(i)] = std::make_shared<Outcome>(jobs[std::size_t(i)]->work({}));
      } catch (const InvalidArgument& refused) {
        throw InvalidArgument(text("scene ", numbers[std::size_t(i)], ": ", refused.what()));
      }
      ++done;
    });
  }
  if (progress) (*progress)(done.load());
  return out;
}

}  // namespace

std::optional<NetworkStart> start_of(const std::optional<py::tuple>& given) {
  if (!given) return std::nullopt;
  return NetworkStart{quaternions((*given)[0].cast<Array>(), "start"),
                      vectors<3>((*given)[1].cast<Array>(), "start"),
                      quaternions((*given)[2].cast<Array>(), "start")};
}

std::vector<Quaternion> start_frames(const std::optional<py::tuple>& given, int edges) {
  if (!given) return {};
  auto frames = quaternions((*given)[0].cast<Array>(), "start");
  require_count(Eigen::Index(frames.size()), edges, "start", "one frame per edge");
  return frames;
}

void job(py::module_& module) {
  bind_rod_solution(module);
  bind_outcome(module);
  py::class_<Job>(module, "Job", "A solve that is ready to be run.")
      .def("run", &run, py::arg("trace"))
      .def_property_readonly(
          "so_far", [](const Job& job) { return job.so_far(); },
          "Of a climb that runs: grids, edges of the finest, largest error.");
  module.def("run_all", &run_all, py::arg("jobs"), py::arg("numbers"), py::arg("threads"),
             py::arg("progress"));
}

}  // namespace pyrod::bind
