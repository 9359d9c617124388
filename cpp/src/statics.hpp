// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bind.hpp"

#include <optional>

namespace pyrod::bind {

/// Loads together with the grid they are brought to.
struct GridLoads {
  Grid grid;
  Loads<Spatial> loads;
};

/// The record of a solve as columns, one line per iteration.
py::dict record(const std::vector<Iteration>& lines);

/// Shape, strains, forces and energies of one rod.
py::dict rod_results(const Grid& grid, const RodSolution<Spatial>& s);

/// How the solve ended, and its record.
void add_status(py::dict& out, Status status, const std::vector<Iteration>& lines);

/// Looks for Ctrl-C once per iteration and shows the iteration to Python, if that is wanted.
Trace python_trace(const std::optional<py::function>& show);

}  // namespace pyrod::bind
