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

/// One rod of an equilibrium, which it keeps alive. What it says is worked out when it is asked.
struct RodOf {
  std::shared_ptr<const Equilibrium> all;
  int number;

  const RodSolution<Spatial>& get() const { return all->rod(number); }
};

void bind_rod_solution(py::module_& module) {
  using S = RodSolution<Spatial>;
  py::class_<RodOf> type(module, "RodSolution", "One rod in equilibrium.");
  const auto property = [&](const char* name, auto&& get) {
    type.def_property_readonly(name, [get](const RodOf& rod) { return get(rod.get()); });
  };
  const auto vectors = [&](const char* name, auto&& get) {
    type.def_property_readonly(name, [get](const py::object& self) {
      return view(get(self.cast<const RodOf&>().get()), self);
    });
  };
  vectors("positions", [](const S& s) -> const auto& { return s.curve.positions; });
  vectors("K", [](const S& s) -> const auto& { return s.strains.K; });
  vectors("Gamma", [](const S& s) -> const auto& { return s.strains.Γ; });
  vectors("force", [](const S& s) -> const auto& { return s.force; });
  vectors("vertex_force", [](const S& s) -> const auto& { return s.vertex_force; });
  vectors("backbone_force", [](const S& s) -> const auto& {
    return s.backbone_force.empty() ? s.vertex_force : s.backbone_force;
  });
  vectors("material_force", [](const S& s) -> const auto& { return s.material_force; });
  vectors("moment", [](const S& s) -> const auto& { return s.moment; });
  vectors("material_moment", [](const S& s) -> const auto& { return s.material_moment; });
  vectors("load", [](const S& s) -> const auto& { return s.load; });
  property("K_before", [](const S& s) {
    return before(s.strains.K, s.before, [](const auto& b) { return b.K; });
  });
  property("vertex_force_before", [](const S& s) {
    return before(s.vertex_force, s.before, [](const auto& b) { return b.force; });
  });
  property("moment_before", [](const S& s) {
    return before(s.moment, s.before, [](const auto& b) { return b.moment; });
  });
  property("largest_K", [](const S& s) { return s.largest.K; });
  property("largest_force", [](const S& s) { return s.largest.force; });
  property("largest_moment", [](const S& s) { return s.largest.moment; });
  property("frames", [](const S& s) { return copied(s.curve.frames); });
  property("vertex_frames", [](const S& s) { return copied(s.vertex_frames); });
  property("load_moment", [](const S& s) { return copied<Vec3>(s.load_moment); });
  property("bend_twist_energy", [](const S& s) { return s.bend_twist_energy; });
  property("stretch_shear_energy", [](const S& s) { return s.stretch_shear_energy; });
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
  py::tuple out(e.reactions().size());
  for (std::size_t i = 0; i < e.reactions().size(); ++i)
    out[i] =
        py::make_tuple(copied<Vec3>(e.reactions()[i].force), copied<Vec3>(e.reactions()[i].moment));
  return out;
}

/// Tension, length, what it exerts where it begins, and whether it is slack.
py::tuple tendons(const Equilibrium& e) {
  py::tuple out(e.tendons().size());
  for (std::size_t i = 0; i < e.tendons().size(); ++i) {
    const auto& tendon = e.tendons()[i];
    out[i] = py::make_tuple(tendon.tension, tendon.length, copied<Vec3>(tendon.force_on_base),
                            tendon.slack);
  }
  return out;
}

}  // namespace

void equilibrium(py::module_& module) {
  bind_rod_solution(module);
  using E = Equilibrium;
  py::class_<E, std::shared_ptr<E>> type(module, "Equilibrium", "A scene, solved.");
  const auto field = [&](const char* name, auto Course::* member) {
    type.def_property_readonly(name, [member](const E& e) { return e.course.*member; });
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
  type.def(
          "rod", [](const std::shared_ptr<const E>& e, int number) { return RodOf{e, number}; },
          py::arg("number"))
      .def_property_readonly("status", [](const E& e) { return std::string(name(e.status())); })
      .def_property_readonly("advice", [](const E& e) { return std::string(e.advice()); })
      .def_property_readonly("record", [](const E& e) { return record(e.course.record); })
      .def_property_readonly(
          "mode",
          [](const E& e) { return e.mode.empty() ? py::object(py::none()) : copied(e.mode); })
      .def_property_readonly("reactions", &reactions)
      .def_property_readonly("tendons", &tendons)
      .def_property_readonly("accuracy", &accuracy)
      .def_property_readonly("doubts", &doubts);
}

}  // namespace pyrod::bind
