// SPDX-License-Identifier: BSD-3-Clause
// A portal of two posts and a beam, one corner rigid and one hinged, pushed aside.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const RodSpec bar = straight(1.0, 20, Section(1, 1.3, 0.8, 80, 90, 300));
  const auto along = [&](const Vec3& from, const Vec3& tangent, const Vec3& normal) {
    return bar.placed({from, frame_along(tangent, normal)});
  };
  const std::vector rods{bar, along({0, 0, 1}, {1, 0, 0}, {0, 0, -1}),
                         along({1, 0, 1}, {0, 0, -1}, {-1, 0, 0})};
  const Joint rigid{.points = {{0, End::end}, {1, End::start}}};
  const Joint hinged{
      .points = {{1, End::end}, {2, End::start}}, .kind = JointKind::hinge, .axis = Vec3(0, 1, 0)};
  const Scene portal(rods, {Clamp{.at = {0, End::start}}, Clamp{.at = {2, End::end}}},
                     {Force{{2, 0.5, -1}, {0, End::end}}}, Dimension::spatial, {rigid, hinged});

  const Equilibrium found = solve(portal, {.tol = 1e-7});
  const auto [force, moment] = found.balance();
  std::cout << name(found.status()) << ", the corner comes to (" << found.tip(0).transpose()
            << "), feet carry (" << found.reactions()[0].force.transpose() << ") and ("
            << found.reactions()[1].force.transpose() << ")\n";
  const Vec3 sum = found.reactions()[0].force + found.reactions()[1].force + Vec3(2, 0.5, -1);
  return found.stable() && sum.norm() < 1e-9 && force < 1e-9 && moment < 1e-9 ? 0 : 1;
}
