// SPDX-License-Identifier: BSD-3-Clause
// A cantilever under a dead tip force F L²/EI = 10, in the plane, without Python.
#include <pyrod/pyrod.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const int edges = 256;
  const auto rod =
      Rod<Planar>::uniform(Grid::uniform(1.0, edges), Vec1(1.0), Vec2::Constant(Section::rigid));
  Loads<Planar> loads(edges);
  loads.add_force(rod.grid, {10, 0}, rod.grid.length());  // components 1 and 3

  const Cantilever<Planar> scene(rod, {0, 0}, Angle{0}, loads);
  const auto found = scene.solve();
  const Vec2 exact(0.8106090248802964, 0.4450044022462487), tip = found.curve.positions.back();
  std::cout << name(found.status) << " in " << found.record.size() << " iterations, tip ("
            << tip.transpose() << "), error " << (tip - exact).norm() << '\n';
  return found.status == Status::converged && (tip - exact).norm() < 1e-5 ? 0 : 1;
}
