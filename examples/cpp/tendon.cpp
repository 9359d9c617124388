// SPDX-License-Identifier: BSD-3-Clause
// A steel wire that is bent by tendons: one parallel to its axis, one in a helix around it.
#include <pyrod/scene.hpp>

#include <cmath>
#include <cstdio>
#include <numbers>

int main() {
  using namespace pyrod;
  const double length = 0.242, distance = 8e-3, turn = 2 * std::numbers::pi / length;
  const auto wire = Section::circle(0.4e-3, Material(210e9, 0.3125));
  const auto rod = straight(length, 8, wire, ModelKind::inextensible);
  const FunctionAlong<Vec2> helix(
      [&](double s) { return Vec2(distance * std::cos(turn * s), distance * std::sin(turn * s)); });
  for (const Along<Vec2>& offset : {Along<Vec2>(Vec2(distance, 0)), Along<Vec2>(helix)}) {
    Scene robot(rod, {Clamp()});
    robot.actuators = {Tendon{.offset = offset, .tension = 5}};
    const auto found = solve(robot, {.tol = 1e-9});
    const auto& tendon = found.tendons()[0];
    const Vec3 tip = found.tip(), base = tendon.force_on_base;
    std::printf(
        "tip (%.7f, %.7f, %.7f) m, tendon %.7f m, pulls at its base by (%.3f, %.3f, %.3f) N\n",
        tip.x(), tip.y(), tip.z(), tendon.length, base.x(), base.y(), base.z());
    if (!found.converged() || !found.stable()) return 1;
  }
}
