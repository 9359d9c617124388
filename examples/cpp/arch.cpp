// SPDX-License-Identifier: BSD-3-Clause
// A strip between two clamps that come nearer, with a full turn of twist put into it.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const Section strip = Section::rectangle(0.004, 0.02, Material(70e9));
  const Scene scene(straight(1.0, 64, strip),
                    {Clamp{}, Clamp{.position = Vec3(0.1, 0, 0.8), .at = End::end, .turns = 1}});

  const Equilibrium found = solve(scene, {.eigenvalue = true});
  const auto [force, moment] = found.balance();
  std::cout << name(found.status()) << ", index " << found.index() << ", energy " << found.energy()
            << " J, largest moment " << found.rod().largest.moment << " N m, the far clamp exerts ("
            << found.reactions()[1].force.transpose() << ") N\n";
  return found.stable() && found.course.lowest_eigenvalue > 0 && force < 1e-9 && moment < 1e-9 ? 0
                                                                                              : 1;
}
