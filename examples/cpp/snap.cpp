// SPDX-License-Identifier: BSD-3-Clause
// A deep arch, clamped at one foot and hinged at the other, is pushed down at its crown: its path
// goes through two folds. Then a column, and the shapes that it buckles into.
#include <pyrod/paths/branch.hpp>
#include <pyrod/scene.hpp>

#include <cmath>
#include <iostream>
#include <numbers>

int main() {
  using namespace pyrod;
  constexpr double π = std::numbers::pi, angle = 215 * π / 180;
  const auto arch = [&](double force) {
    auto rod = precurved(angle, 128, Section(1, 1, 1), Vec3(0, 1, 0));
    rod.placement.frame = exp(Vec3(0, -angle / 2, 0));
    return Scene(rod, {Clamp{}, Hinge{.at = End::end}}, {Force{{force, 0, 0}, angle / 2}},
                 Dimension::planar);
  };
  const Branch snap = follow(SceneFamily(arch(0), arch(1)), {.start = 0, .stop = 12});
  for (const auto& point : snap.special())
    std::cout << name(point.kind) << " at " << point.value << " EI/R², index " << point.index_before
              << " to " << point.index_behind << '\n';

  const auto column = [&](double force) {
    return Scene(straight(1.0, 64, Section(1, 1, 1)), {Hinge{}, Slider{.along = Vec3(0, 0, 1)}},
                 {Force{{0, 0, -force}}}, Dimension::planar);
  };
  const PathSettings up{.start = 0, .stop = 60};
  const Branch straight_one = follow(SceneFamily(column), up);
  const Branch buckled = straight_one.switched(0, 1, up);
  const Equilibrium last = buckled.equilibrium(buckled.points().size() - 1);
  std::cout << name(straight_one.special()[0].kind) << " at "
            << straight_one.special()[0].value / (π * π)
            << " π² EI/L²; at 60 the end is at z = " << last.tip().z() << " L\n";

  const bool fine = snap.special().size() == 2 && straight_one.special().size() == 2 &&
                    std::abs(snap.special()[0].value - 8.973) < 1e-2 &&
                    std::abs(straight_one.special()[0].value / (π * π) - 1) < 1e-3;
  return fine ? 0 : 1;
}
