// SPDX-License-Identifier: BSD-3-Clause
/// \file How equilibria answer to small changes.
#include "parts.hpp"

#include <pyrod/linear/linearised.hpp>
#include <pyrod/solve/extrapolation.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>

namespace pyrod::bind {

namespace {

/// Names of what is told of a rod, and where it is.
constexpr std::pair<const char*, std::vector<Vec3> RodChange::*> of_rods[] = {
    {"positions", &RodChange::positions},
    {"frames", &RodChange::frames},
    {"vertex_frames", &RodChange::vertex_frames},
    {"rotations", &RodChange::rotations},
    {"K", &RodChange::K},
    {"moment", &RodChange::moment},
    {"Gamma", &RodChange::Γ},
    {"force", &RodChange::force}};

/// By paths: "rods.0.positions", "reactions.1.force", "energy".
py::dict told(const SceneChange& change) {
  py::dict out;
  for (std::size_t i = 0; i < change.rods.size(); ++i)
    for (const auto& [name, member] : of_rods)
      out[py::str(text("rods.", i, ".", name))] = array(change.rods[i].*member);
  for (std::size_t i = 0; i < change.reaction_forces.size(); ++i) {
    out[py::str(text("reactions.", i, ".force"))] = array<3>(change.reaction_forces[i]);
    out[py::str(text("reactions.", i, ".moment"))] = array<3>(change.reaction_moments[i]);
  }
  out["multipliers"] = array(change.multipliers);
  for (std::size_t i = 0; i < change.tensions.size(); ++i) {
    out[py::str(text("tendons.", i, ".length"))] = change.tendon_lengths[i];
    out[py::str(text("tendons.", i, ".tension"))] = change.tensions[i];
  }
  out["energy"] = change.energy;
  return out;
}

/// The same back, on top of zeros; all names are known.
SceneChange weights(const py::dict& given, SceneChange out) {
  const auto take = [&](const std::string& name, std::vector<Vec3>& to) {
    if (!given.contains(name.c_str())) return;
    to = vectors<3>(given[name.c_str()].cast<Array>(), name.c_str());
  };
  const auto take_one = [&](const std::string& name, Vec3& to) {
    if (given.contains(name.c_str())) to = vector3(given[name.c_str()].cast<Array>(), name.c_str());
  };
  for (std::size_t i = 0; i < out.rods.size(); ++i)
    for (const auto& [name, member] : of_rods)
      take(text("rods.", i, ".", name), out.rods[i].*member);
  for (std::size_t i = 0; i < out.reaction_forces.size(); ++i) {
    take_one(text("reactions.", i, ".force"), out.reaction_forces[i]);
    take_one(text("reactions.", i, ".moment"), out.reaction_moments[i]);
  }
  take("multipliers", out.multipliers);
  const auto take_number = [&](const std::string& name, double& to) {
    if (given.contains(name.c_str())) to = given[name.c_str()].cast<double>();
  };
  for (std::size_t i = 0; i < out.tensions.size(); ++i) {
    take_number(text("tendons.", i, ".length"), out.tendon_lengths[i]);
    take_number(text("tendons.", i, ".tension"), out.tensions[i]);
  }
  if (given.contains("energy")) out.energy = given["energy"].cast<double>();
  return out;
}

py::tuple fields(const RodFields& of) {
  return py::make_tuple(array(of.bending), array(of.stretching), array(of.K0));
}

/// What numbers on ever finer grids tend to, their error, and whether the grids converge as they
/// should.
py::tuple limit(const std::vector<Array>& grids, bool even, double noise) {
  std::vector<Vector> levels;
  for (const auto& grid : grids) levels.push_back(numbers(grid, "grids"));
  const double scale = levels.back().lpNorm<Eigen::Infinity>();
  if (scale == 0) return py::make_tuple(array(levels.back()), 0., true);
  const Judgement by{{{0, int(levels[0].size()), 0}}, {scale}, even, noise};
  const auto found = Extrapolation(levels, by).result();
  return py::make_tuple(array(found.values), scale * found.error(), found.regular);
}

/// Rows of each rod.
std::vector<std::vector<Vec3>> of_each(const std::vector<Array>& rods, const char* name) {
  std::vector<std::vector<Vec3>> out;
  for (const auto& rod : rods) out.push_back(vectors<3>(rod, name));
  return out;
}

Vector flat(const Array& numbers_given) { return numbers(numbers_given, "numbers"); }

}  // namespace

void linear(py::module_& module) {
  py::register_exception<SingularEquilibrium>(module, "SingularEquilibrium", PyExc_ArithmeticError);
  module.def("limit", &limit, py::arg("grids"), py::arg("even"), py::arg("noise"));
  py::class_<Linearised>(module, "Linearised", "How an equilibrium answers to small changes.")
      .def(py::init<const Solver&, const Equilibrium&>(), py::arg("scene"), py::arg("near"),
           py::call_guard<py::gil_scoped_release>())
      .def(
          "numbers", [](const Linearised& l, const Solver& s) { return array(l.numbers(s)); },
          py::arg("scene"))
      .def(
          "of_forces",
          [](const Linearised& l, const std::vector<Array>& rods) {
            return array(l.of_forces(of_each(rods, "forces")));
          },
          py::arg("forces"))
      .def(
          "of_moments",
          [](const Linearised& l, const std::vector<Array>& rods) {
            return array(l.of_moments(of_each(rods, "moments")));
          },
          py::arg("moments"))
      .def(
          "of_moment",
          [](const Linearised& l, int rod, int vertex, const Array& moment) {
            return array(l.of_moment(rod, vertex, vector3(moment, "moment")));
          },
          py::arg("rod"), py::arg("vertex"), py::arg("moment"))
      .def(
          "of_motion",
          [](const Linearised& l, int support, const Array& shift, const Array& turn) {
            return array(l.of_motion(support, vector3(shift, "shift"), vector3(turn, "turn")));
          },
          py::arg("support"), py::arg("shift"), py::arg("turn"))
      .def(
          "of_rod",
          [](const Linearised& l, int rod, const Array& bending, const Array& stretching,
             const Array& K0) {
            return array(l.of_rod(rod, {vectors<3>(bending, "bending"), vectors<3>(K0, "K0"),
                                        vectors<3>(stretching, "stretching")}));
          },
          py::arg("rod"), py::arg("bending"), py::arg("stretching"), py::arg("K0"))
      .def("to_rod", [](const Linearised& l, int rod,
                        const Array& numbers) { return fields(l.to_rod(rod, flat(numbers))); })
      .def(
          "push",
          [](const Linearised& l, const Array& numbers) { return told(l.push(flat(numbers))); },
          py::arg("numbers"))
      .def("pull",
           [](const Linearised& l, const py::dict& given) {
             Vector rounding;
             const auto gradient = l.pull(weights(given, l.empty()), &rounding);
             return py::make_tuple(array(gradient), array(rounding));
           })
      .def("free",
           [](const Linearised& l) {
             py::list out;
             for (const auto& change : l.free()) out.append(told(change));
             return out;
           })
      .def("pushes_freely",
           [](const Linearised& l) {
             py::list out;
             for (const auto& numbers : l.pushes_freely()) out.append(array(numbers));
             return out;
           })
      .def(
          "compliance",
          [](const Linearised& l, int rod, int vertex) {
            std::vector<Vec<6>> rows;
            const Mat<6> C = l.compliance(rod, vertex);
            for (const auto& row : C.rowwise()) rows.emplace_back(row);
            return array(rows);
          },
          py::arg("rod"), py::arg("vertex"))
      .def_property_readonly("weights", [](const Linearised& l) { return array(l.weights()); })
      .def(
          "solved",
          [](const Linearised& l, const Array& rows) {
            return array(l.solved(numbers(rows, "rows")));
          },
          py::arg("rows"))
      .def(
          "follow",
          [](const Linearised& l, const Array& rows) {
            return told(l.follow(numbers(rows, "rows")));
          },
          py::arg("rows"))
      .def_property_readonly("symmetric", &Linearised::symmetric);
}

}  // namespace pyrod::bind
