// SPDX-License-Identifier: BSD-3-Clause
/// \file The parts of scenes, as Python hands them over.
#pragma once

#include "bind.hpp"

#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/statics/solver.hpp>

#include <string_view>

namespace pyrod::bind {

/// A rod as it was given, and on its grid, whatever its model is.
struct GivenRod {
  RodSpec spec;
  RodOnGrid made;

  explicit GivenRod(RodSpec given) : spec(std::move(given)), made(made_on_grid(spec)) {
    made.rod.check();
  }

  ModelKind model() const { return spec.model.value_or(made.richest); }
};

/// Whether two rods that are made of the same stand on the same grid.
inline bool same_grid(const RodSpec& a, const RodSpec& b) {
  return a.edge_lengths.size() == b.edge_lengths.size() && a.kept == b.kept && a.marks == b.marks;
}

/// Models and spaces go by their names, which Python has checked.
inline ModelKind model_of(std::string_view name) {
  return name == "cosserat"     ? ModelKind::cosserat
         : name == "extensible" ? ModelKind::extensible
                                : ModelKind::inextensible;
}
inline const char* name(ModelKind model) {
  constexpr const char* names[] = {"cosserat", "extensible", "inextensible"};
  return names[int(model)];
}
inline Dimension space_of(std::string_view name) {
  return name == "planar" ? Dimension::planar : Dimension::spatial;
}

/// How a scene is solved, and the solvers of many and of one that changes.
void solving(py::module_& module, py::class_<Solver>& scene);

/// "start", "end", an arc length, or (number of a rod, one of these).
Place place(const py::handle& at);

}  // namespace pyrod::bind
