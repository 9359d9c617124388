// SPDX-License-Identifier: BSD-3-Clause
/// \file The work of a tendon's tension as a part of a cell's potential.
#pragma once

#include <pyrod/rod/tendon_cell.hpp>
#include <pyrod/rod/turn_potential.hpp>

namespace pyrod {

/// Adds the work of a tension, theory (34).
template <class Space>
void add_tension(double tension, const TendonLength<Space>& of, TurnPotential<Space>& to) {
  to.energy += tension * of.length;
  to.m += tension * of.slope;
  to.k += tension * of.curvature;
}

}  // namespace pyrod
