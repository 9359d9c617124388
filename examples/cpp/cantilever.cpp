// SPDX-License-Identifier: BSD-3-Clause
// A cantilever under a dead tip force F L²/EI = 10, in the plane, on finer and finer grids.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const Vec3 exact(0.8106090248802964, 0, 0.4450044022462487);  // by elliptic integrals
  double error = 1;
  for (const int edges : {64, 128, 256}) {
    const auto rod = straight(1.0, edges, Section(1, 1, 1));
    const Equilibrium bent = solve(Scene({rod}, {Clamp{}}, {Force{{10, 0, 0}}}, Dimension::planar));
    const double before = error;
    error = (bent.tip() - exact).norm();
    std::cout << edges << " edges: " << name(bent.status()) << " in " << bent.course.record.size()
              << " iterations, error " << error << ", " << before / error << " times smaller\n";
    if (!bent.converged()) return 1;
  }
  return error < 1e-5 ? 0 : 1;
}
