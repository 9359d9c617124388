// SPDX-License-Identifier: BSD-3-Clause
/// \file By how much rounding may move an equilibrium.
#pragma once

namespace pyrod {

/// Where members are stiff along themselves rounding makes large forces of gaps that are nothing.
struct Rounding {
  double force = 0, moment = 0;  ///< [N], [N m]
};

}  // namespace pyrod
