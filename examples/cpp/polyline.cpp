// SPDX-License-Identifier: BSD-3-Clause
// Geometry without mechanics: curvature and torsion of a polygon on a helix, beside those of the
// helix, a/(a² + b²) and b/(a² + b²).
#include <pyrod/curve/frenet.hpp>

#include <iostream>

int main() {
  using namespace pyrod;
  const double a = 1, b = 0.5;
  const int n = 400;
  std::vector<Vec3> positions;
  for (int j = 0; j <= n; ++j) {
    const double t = 10. * j / n;
    positions.emplace_back(a * std::cos(t), a * std::sin(t), b * t);
  }
  const Arc arc{positions};
  arc.check();
  const Grid grid = arc_length(arc);
  const double κ = curvature(grid, turning_angles(arc))[n / 2];
  const double τ = torsion(grid, dihedral_angles(arc, binormals(arc)))[n / 2];
  std::cout << "curvature " << κ << ", torsion " << τ << "; helix: 0.8 and 0.4\n";
  return std::abs(κ - 0.8) < 1e-3 && std::abs(τ - 0.4) < 1e-3 ? 0 : 1;
}
