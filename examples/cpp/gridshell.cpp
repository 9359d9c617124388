// SPDX-License-Identifier: BSD-3-Clause
// A flat grid of laths that turn about pins where they cross; its edges are drawn in, and it rises.
#include <pyrod/scene.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const int laths = 5;  // each way
  const double size = 4, inwards = 0.95;
  const RodSpec lath = straight(size, 32, Section::rectangle(0.02, 0.05, Material(10e9)));
  const auto line = [&](int k) { return size * (k + 1) / (laths + 1); };

  std::vector<RodSpec> rods;
  std::vector<Support> supports;
  std::vector<Joint> joints;
  for (const bool across : {false, true})
    for (int k = 0; k < laths; ++k) {
      const int rod = int(rods.size());
      const Vec3 tangent = across ? Vec3::UnitY() : Vec3::UnitX();
      const Vec3 from = line(k) * (across ? Vec3::UnitX() : Vec3::UnitY());
      const Vec3 middle = from + size / 2 * tangent;
      rods.push_back(lath.placed({from, frame_along(tangent, Vec3::UnitZ())}));
      supports.push_back(Hinge{Vec3(middle - inwards * size / 2 * tangent), {rod, End::start}});
      supports.push_back(Hinge{Vec3(middle + inwards * size / 2 * tangent), {rod, End::end}});
    }
  for (int i = 0; i < laths; ++i)
    for (int j = 0; j < laths; ++j)
      joints.push_back({.points = {{i, line(j)}, {laths + j, line(i)}},
                        .kind = JointKind::hinge,
                        .axis = Vec3::UnitZ()});
  // a crane draws the middle up
  const Scene shell(rods, supports, {Force{{0, 0, 200}, {laths / 2, size / 2}}}, Dimension::spatial,
                    joints);

  const Equilibrium found = solve(shell);
  double top = 0;
  for (const auto& rod : found.rods())
    for (const Vec3& r : rod.curve.positions) top = std::max(top, r.z());
  std::cout << name(found.status()) << " in " << found.course.record.size() << " iterations, "
            << found.course.unknowns << " unknowns, index " << found.index() << ", " << top
            << " m high\n";
  return found.stable() && top > 0.3 ? 0 : 1;
}
