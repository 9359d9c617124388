// SPDX-License-Identifier: BSD-3-Clause
// A wire under a dead tip force F L²/EI = 10, to an error that is asked for.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const RodSpec rod = straight(1.0, automatic, Section(1, 1, 1));
  const Scene scene(rod, {Clamp{}}, {Force{{10, 0, 0}}}, Dimension::planar);

  const Equilibrium found = solve(scene, {.tol = 1e-9});
  const Vec3 exact(0.8106090248802964, 0, 0.4450044022462487);
  const double error = (found.tip() - exact).norm(),
               told = found.accuracy->error(Quantity::positions);
  std::cout << name(found.status()) << " on " << found.accuracy->reached.levels << " grids, tip ("
            << found.tip().transpose() << "), error " << error << ", told " << told << '\n';
  return found.converged() && error <= told && told <= 1e-9 ? 0 : 1;
}
