// SPDX-License-Identifier: BSD-3-Clause
/// \file Derivatives against differences, with the order that the differences must show.
#pragma once

#include <pyrod/core/types.hpp>

#include <functional>

namespace pyrod::test {

/// Checks `derivative` = f'(0). The error of the central difference must fall like h², and what is
/// left without its powers h², h⁴, … must be rounding. (Where f is a parabola, there is no error to
/// fall.) `h`: the largest step.
void check_derivative(const std::function<Vector(double)>& f, const Vector& derivative,
                      double h = 0.05, double tolerance = 1e-10);
void check_slope(const std::function<double(double)>& f, double derivative, double h = 0.05,
                 double tolerance = 1e-10);

}  // namespace pyrod::test
