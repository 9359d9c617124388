// SPDX-License-Identifier: BSD-3-Clause
// A ring that is round at rest, cut, twisted by a full turn and joined again: its energy is that of
// the twist alone, GJ (2π)²/2L, while it stays flat.
#include <pyrod/scene.hpp>

#include <iostream>
#include <numbers>

int main() {
  using namespace pyrod;
  const double turn = 2 * std::numbers::pi;
  const RodSpec rod = precurved(1.0, 128, Section(1, 1, 0.8), Vec3(0, turn, 0));
  const Scene ring({rod}, {Clamp{}}, {}, Dimension::spatial,
                   {Joint{.points = {End::start, End::end}, .turns = 1}});

  const Equilibrium found = solve(ring);
  const double flat = 0.8 * turn * turn / 2;
  std::cout << name(found.status()) << ", index " << found.index() << ", energy " << found.energy()
            << ", of the twist in a flat ring " << flat << '\n';
  return found.stable() && std::abs(found.energy() / flat - 1) < 1e-9 ? 0 : 1;
}
