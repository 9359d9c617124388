// SPDX-License-Identifier: BSD-3-Clause
/// \file The parts of scenes, as Python hands them over.
#pragma once

#include "bind.hpp"

#include <pyrod/scene/rod_on_grid.hpp>
#include <pyrod/scene/scene.hpp>

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

/// "start", "end", an arc length, or (number of a rod, one of these).
Place place(const py::handle& at);

}  // namespace pyrod::bind
