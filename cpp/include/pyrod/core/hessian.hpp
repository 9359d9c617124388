// SPDX-License-Identifier: BSD-3-Clause
/// \file Which second derivative of an energy is meant.
#pragma once

namespace pyrod {

/// `exact`: the Hessian. `convex`: a positive semidefinite matrix that stands in for it far from a
/// solution; it sees each part of the energy as the parabola that has the part's own slope here and
/// its minimum where the part's minimum is, as theory (12) does for an edge.
enum class Hessian { exact, convex };

}  // namespace pyrod
