// SPDX-License-Identifier: BSD-3-Clause
// The solve of call_overhead.py without Python: prints its median time in seconds.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>

int main() {
  using namespace pyrod;
  const int n = 64;
  for (const auto dimension : {Dimension::planar, Dimension::spatial}) {
    const auto time = benchmark::seconds([&] {
      const auto rod = Rod<Spatial>::uniform(Grid::uniform(1, n), {1, 1, 0.7}, {4e3, 4e3, 1e4});
      rod.check();
      Loads<Spatial> loads(n);
      loads.add_force(rod.grid, {10, 0, 0}, 1);
      solve(rod, dimension, ModelKind::cosserat, {}, loads);
    });
    std::printf("%.9f\n", time);
  }
}
