// SPDX-License-Identifier: BSD-3-Clause
// How far the tip of a bent cantilever gives way to a little more force, beside a difference of
// solves and beside the derivative by elliptic integrals.
#include <pyrod/linear/linearised.hpp>
#include <pyrod/scene.hpp>

#include <cmath>
#include <iostream>

int main() {
  using namespace pyrod;
  const auto pulled = [](double force) {
    return Scene(straight(1.0, 256, Section(1, 1, 1)), {Clamp{}}, {Force{{force, 0, 0}}},
                 Dimension::planar);
  };
  const Solver solver(pulled(10));
  const Linearised linear(solver, solver.solve());
  const Vector change = linear.numbers(Solver(pulled(11))) - linear.numbers(solver);
  const Vec3 tip = linear.push(change).rods[0].positions.back();

  const Vec3 ahead = solve(pulled(10.01)).tip(), behind = solve(pulled(9.99)).tip();
  const double difference = (tip - (ahead - behind) / 0.02).norm();
  const double error = (tip - Vec3(0.0105359712168, 0, -0.0215494661655)).norm();
  std::cout << "d(tip)/dF = (" << tip.transpose() << "), off by " << error << ", and by "
            << difference << " from differences\n";

  SceneChange across = linear.empty();
  across.rods[0].positions.back() = {1, 0, 0};
  const Vector gradient = linear.pull(across);
  std::cout << "backward: " << gradient.dot(change) - tip.x() << '\n';
  return error < 1e-6 && difference < 1e-7 && std::abs(gradient.dot(change) - tip.x()) < 1e-15 ? 0
                                                                                               : 1;
}
