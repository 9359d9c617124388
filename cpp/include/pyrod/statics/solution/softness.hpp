// SPDX-License-Identifier: BSD-3-Clause
/// \file How soft the softest mode of an equilibrium is, and what of errors follows from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pyrod {

struct Softness {
  static constexpr double shift = 1e-6;  ///< that Newton's matrices have, see `ShiftedFactor`

  double eigenvalue = std::numeric_limits<double>::infinity();  ///< over EI/L of the scene
  double drift = 0;  ///< turn [rad] along the mode that rounding does not tell from none
  double bend = 0;   ///< by how much curvatures change with the mode's largest turn [1/m]
  double push = 0;   ///< by how much section forces do [N]

  bool neutral() const { return std::abs(eigenvalue) < 3 * shift; }
  bool soft() const { return std::abs(eigenvalue) < 1e-2; }
  /// What a full Newton step leaves of a distance along the mode, because of the shift.
  double left() const { return shift / std::max(shift, std::abs(shift + eigenvalue)); }
};

}  // namespace pyrod
