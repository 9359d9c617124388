// SPDX-License-Identifier: BSD-3-Clause
// A straight rod whose ends are joined to a ring, with a full turn of twist in it. It stays flat,
// as the turn is below Michell's threshold, √3 EI/GJ: its energy is (EI + GJ) (2π)²/2L.
#include <pyrod/scene.hpp>

#include <iostream>
#include <numbers>

int main() {
  using namespace pyrod;
  const double turn = 2 * std::numbers::pi;
  const RodSpec rod = straight(1.0, automatic, Section(1, 1, 0.8));
  const Scene ring({rod}, {Clamp{}}, {}, Dimension::spatial,
                   {Joint{.points = {End::start, End::end}, .turns = 1}});

  const Equilibrium found = solve(ring, {.tol = 1e-8});
  const double flat = (1 + 0.8) * turn * turn / 2;
  std::cout << name(found.status()) << ", index " << found.index() << ", energy " << found.energy()
            << ", of a flat ring " << flat << '\n';
  return found.stable() && std::abs(found.energy() / flat - 1) < 1e-8 ? 0 : 1;
}
