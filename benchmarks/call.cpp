// SPDX-License-Identifier: BSD-3-Clause
// The solve of call_overhead.py without Python: prints its median time in seconds.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>

int main() {
  using namespace pyrod;
  const int n = 64;
  const Section section(1, 1, 0.7, 4e3, 4e3, 1e4);
  for (const auto dimension : {Dimension::planar, Dimension::spatial}) {
    const auto time = benchmark::seconds([&] {
      solve(Scene({straight(1.0, n, section)}, {Clamp{}}, {Force{{10, 0, 0}}}, dimension));
    });
    std::printf("%.9f\n", time);
  }
}
