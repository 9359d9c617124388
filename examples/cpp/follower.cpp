// SPDX-License-Identifier: BSD-3-Clause
// A force that stays across the end of the rod, wherever that turns. It has no potential, and so
// the equilibrium no index: −1.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const Scene scene(straight(1.0, 64, Section(1, 1, 1)), {Clamp{}},
                    {Force{.force = {4, 0, 0}, .follower = true}});

  const Equilibrium found = solve(scene);
  const Vec3 across = rotate(found.tip_frame(), Vec3::UnitX());
  std::cout << name(found.status()) << ", index " << found.index() << ", tip ("
            << found.tip().transpose() << "), the clamp exerts ("
            << found.reactions()[0].force.transpose() << ")\n";
  const bool balanced = (found.reactions()[0].force + 4 * across).norm() < 0.02;  // the grid's error
  return found.converged() && found.index() == -1 && balanced ? 0 : 1;
}
