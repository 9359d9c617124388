// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/statics/equilibrium.hpp>

namespace pyrod::bind {

namespace {

/// Read-only array of vectors that belong to `owner`, or of a copy.
py::array view(const std::vector<Vec3>& rows, const py::object& owner) {
  const auto* data = reinterpret_cast<const double*>(rows.data());
  return locked(py::array_t<double>({py::ssize_t(rows.size()), py::ssize_t(3)}, data, owner));
}
template <class Rows>
py::array copied(const Rows& rows) {
  return locked(array(rows));
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
    return locked(std::move(out));
  };
  using I = Iteration;
  py::dict out;
  out["exact"] = column([](const I& i) { return i.kind == Hessian::exact; });
  out["energy"] = column([](const I& i) { return i.energy; });
  out["residual"] = column([](const I& i) { return i.residual; });
  out["step"] = column([](const I& i) { return i.step; });
  out["fraction"] = column([](const I& i) { return i.fraction; });
  out["shift"] = column([](const I& i) { return i.shift; });
  out["factorisations"] = column([](const I& i) { return i.factorisations; });
  out["unknowns"] = column([](const I& i) { return i.unknowns; });
  return out;
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
      .def_readonly("stretch_shear_energy", &S::stretch_shear_energy);
}

py::object accuracy(const Equilibrium& e) {
  if (!e.accuracy) return py::none();
  const auto& r = e.accuracy->reached;
  py::dict errors;
  for (int i = 0; i < quantities; ++i) errors[quantity_names[std::size_t(i)]] = r.errors[i];
  return py::make_tuple(e.accuracy->tol, errors, r.order, r.regular, r.levels, r.edges,
                        std::string(name(r.ended)), e.accuracy->reason);
}

py::list doubts(const Equilibrium& e) {
  constexpr const char* kinds[] = {"unstable", "accuracy", "strain"};
  py::list out;
  for (const auto& doubt : e.doubts)
    out.append(py::make_tuple(kinds[std::size_t(doubt.kind)], doubt.words));
  return out;
}

py::tuple reactions(const Equilibrium& e) {
  py::tuple out(e.reactions.size());
  for (std::size_t i = 0; i < e.reactions.size(); ++i)
    out[i] =
        py::make_tuple(copied<Vec3>(e.reactions[i].force), copied<Vec3>(e.reactions[i].moment));
  return out;
}

/// Each keeps the whole equilibrium alive.
py::tuple rods(const std::shared_ptr<Equilibrium>& e) {
  py::tuple out(e->found.rods.size());
  for (std::size_t i = 0; i < e->found.rods.size(); ++i)
    out[i] = std::shared_ptr<RodSolution<Spatial>>(e, &e->found.rods[i]);
  return out;
}

}  // namespace

void equilibrium(py::module_& module) {
  bind_rod_solution(module);
  using E = Equilibrium;
  py::class_<E, std::shared_ptr<E>> type(module, "Equilibrium", "A scene, solved.");
  const auto field = [&](const char* name, auto Course::* member) {
    type.def_property_readonly(name, [member](const E& e) { return e.found.*member; });
  };
  field("index", &Course::index);
  field("residual", &Course::residual);
  field("load_steps", &Course::load_steps);
  field("descents", &Course::descents);
  field("unknowns", &Course::unknowns);
  field("multipliers", &Course::multipliers);
  field("fill", &Course::fill);
  field("neutral", &Course::neutral);
  field("lowest_eigenvalue", &Course::lowest_eigenvalue);
  type.def_property_readonly("rods", &rods)
      .def_property_readonly("status", [](const E& e) { return std::string(name(e.status())); })
      .def_property_readonly("advice", [](const E& e) { return std::string(e.advice()); })
      .def_property_readonly("record", [](const E& e) { return record(e.found.record); })
      .def_property_readonly("mode",
                             [](const E& e) {
                               return e.found.mode.empty() ? py::object(py::none())
                                                           : copied(e.found.mode);
                             })
      .def_property_readonly("reactions", &reactions)
      .def_property_readonly("accuracy", &accuracy)
      .def_property_readonly("doubts", &doubts);
}

}  // namespace pyrod::bind
