// SPDX-License-Identifier: BSD-3-Clause
// A thousand solves on all threads.
#include <pyrod/core/parallel.hpp>
#include <pyrod/scene.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

int main() {
  using namespace pyrod;
  const int cases = 1000;
  const RodSpec rod = straight(1.0, 32, Section(1, 1, 1));
  std::vector<double> bent(cases);
  for_each_row(cases, 0, {}, [&](int i) {
    const double load = 10. * (i + 1) / cases;
    bent[std::size_t(i)] = solve({rod, {Clamp{}}, {Force{{load, 0, 0}}}}).tip().x();
  });
  std::cout << "tips from " << bent.front() << " to " << bent.back() << '\n';
  const bool rising = std::is_sorted(bent.begin(), bent.end());
  return rising && std::abs(bent.back() - 0.8106) < 1e-3 ? 0 : 1;
}
