// SPDX-License-Identifier: BSD-3-Clause
// A column between pins: the load at which its straight shape becomes unstable, told by the index.
#include <pyrod/scene.hpp>

#include <iostream>
#include <numbers>

int main() {
  using namespace pyrod;
  const Section strip = Section::rectangle(0.002, 0.02, Material(200e9));
  const auto pressed = [&](double load) {
    return Scene(
        straight(1.0, 64, strip, ModelKind::inextensible),
        {Pivot{{0, 1, 0}}, Pivot{.axis = {0, 1, 0}, .at = End::end, .along = Vec3(0, 0, 1)}},
        {Force{{0, 0, -load}}});
  };
  double stable = 1, unstable = 100;
  while (unstable - stable > 1e-6) {
    const double load = (stable + unstable) / 2;
    const Equilibrium straight_one = solve(pressed(load), {.stable = false});
    (straight_one.index() == 0 ? stable : unstable) = load;
  }
  const double Euler = std::numbers::pi * std::numbers::pi * strip.EI2;
  const Equilibrium buckled = solve(pressed(1.05 * Euler));  // leaves the straight shape by itself
  std::cout << "critical load " << stable << " N, Euler's " << Euler << " N; at 1.05 of it the end "
            << "comes " << 1 - buckled.tip().z() << " m nearer\n";
  const bool sank = buckled.stable() && std::abs(1 - buckled.tip().z() - 0.0947) < 5e-4;
  return std::abs(stable / Euler - 1) < 1e-3 && sank ? 0 : 1;
}
