// SPDX-License-Identifier: BSD-3-Clause
/// \file What a user may tune in a solve, listed once: bindings and prints are made from `fields`.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/require.hpp>

#include <tuple>

namespace pyrod {

struct Options {
  int max_iterations = 100;
  double tolerance = 1e-8;
  double trust = 2.0;
  double near = 0.5;
  int max_edges = 1 << 18;
  double max_time = 60;

  static constexpr auto fields() {
    return std::tuple{
        Field<Options, int>{"max_iterations", &Options::max_iterations,
                            "linear solves of one run before giving up"},
        Field<Options, double>{
            "tolerance", &Options::tolerance,
            "largest component [rad] of the last full Newton step; the error left "
            "is of the order of its square"},
        Field<Options, double>{"trust", &Options::trust,
                               "longest step [rad] taken on the word of the exact Hessian"},
        Field<Options, double>{"near", &Options::near,
                               "steps [rad] below which the exact Hessian replaces the convex one"},
        Field<Options, int>{"max_edges", &Options::max_edges,
                            "edges of all rods together on the finest grid that a tolerance may "
                            "lead to"},
        Field<Options, double>{"max_time", &Options::max_time,
                               "seconds that the grids of a tolerance may take; none is begun that "
                               "would end later, if it took as long as the one before"},
    };
  }

  void check() const {
    require(max_iterations > 0, "max_iterations: must be at least 1, got ", max_iterations);
    require(tolerance > 0 && tolerance <= 1e-3, "tolerance: must lie in (0, 1e-3] rad, got ",
            tolerance);
    require(trust > 0, "trust: must be positive, got ", trust);
    require(max_edges > 0, "max_edges: must be at least 1, got ", max_edges);
    require(max_time > 0, "max_time: must be positive, got ", max_time);
    require(near >= 0, "near: must not be negative, got ", near);
  }
};

}  // namespace pyrod
