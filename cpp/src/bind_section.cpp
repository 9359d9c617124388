// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/rod/section.hpp>

namespace pyrod::bind {

void section(py::module_& module) {
  const auto values = [](const Section& s) {
    return py::make_tuple(s.EI1, s.EI2, s.GJ, s.GA1, s.GA2, s.EA);
  };
  auto m = module.def_submodule("section", "Stiffnesses (EI1, EI2, GJ, GA1, GA2, EA).");
  m.def(
      "check_material", [](double E, double nu) { return Material(E, nu).G(); }, py::arg("E"),
      py::arg("nu"));
  m.def(
      "check",
      [values](double EI1, double EI2, double GJ, double GA1, double GA2, double EA) {
        return values(Section(EI1, EI2, GJ, GA1, GA2, EA));
      },
      py::arg("EI1"), py::arg("EI2"), py::arg("GJ"), py::arg("GA1"), py::arg("GA2"), py::arg("EA"));
  m.def(
      "circle",
      [values](double radius, double E, double nu) {
        return values(Section::circle(radius, Material(E, nu)));
      },
      py::arg("radius"), py::arg("E"), py::arg("nu"));
  m.def(
      "tube",
      [values](double outer, double inner, double E, double nu) {
        return values(Section::tube(outer, inner, Material(E, nu)));
      },
      py::arg("outer_radius"), py::arg("inner_radius"), py::arg("E"), py::arg("nu"));
  m.def(
      "rectangle",
      [values](double width, double height, double E, double nu) {
        return values(Section::rectangle(width, height, Material(E, nu)));
      },
      py::arg("width"), py::arg("height"), py::arg("E"), py::arg("nu"));
}

}  // namespace pyrod::bind
