// SPDX-License-Identifier: BSD-3-Clause
// Prints an equilibrium to the last bit, and hands lists of frames to the library and takes them
// from it: compiled for several instruction sets, beside one library.
#include <pyrod/scene.hpp>

#include <iomanip>
#include <iostream>
#include <vector>

int main() {
  using namespace pyrod;
  const RodSpec bar = straight(1.0, 20, Section(1, 1.3, 0.8, 80, 90, 300));
  const RodSpec beam = bar.placed({Vec3(0, 0, 1), frame_along(Vec3(1, 0, 0), Vec3(0, 0, -1))});
  const Joint corner{.points = {{0, End::end}, {1, End::start}}};
  const Scene scene({bar, beam}, {Clamp{}}, {Force{{2, 0.5, -1}, {1, End::end}}},
                    Dimension::spatial, {corner});

  const Equilibrium first = solve(scene);
  const Equilibrium found = solve(scene, {.tol = 1e-6, .start = &first});
  std::cout << name(found.status()) << std::hexfloat << ' ' << found.energy();
  for (int rod = 0; rod < 2; ++rod) {
    for (const Vec3& r : found.rod(rod).curve.positions) std::cout << '\n' << r.transpose();
    for (const Quaternion& q : found.rod(rod).curve.frames)
      std::cout << '\n' << q.coeffs().transpose();
  }
  return found.converged() ? 0 : 1;
}
