// SPDX-License-Identifier: BSD-3-Clause
/// \file What is thrown where there are no derivatives.
#pragma once

#include <stdexcept>
#include <string>

namespace pyrod {

/// There is no derivative: an equilibrium at which a mode has no stiffness.
struct SingularEquilibrium : std::runtime_error {
  double eigenvalue;  ///< of the softest mode, relative to the stiffness of the rods

  SingularEquilibrium(const std::string& words, double λ)
      : std::runtime_error(words), eigenvalue(λ) {}
};

}  // namespace pyrod
