// SPDX-License-Identifier: BSD-3-Clause
// A catheter whose tip follows a moving target at 1 kHz: every millisecond its base is moved by
// what the tip is off, and the shape is solved for again from the last one. A number of steps may
// be given; 60 000 are a minute.
#include <pyrod/scene.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <vector>

int main(int argc, char** argv) {
  using namespace pyrod;
  using Clock = std::chrono::steady_clock;
  const int steps = argc > 1 ? std::atoi(argv[1]) : 60000;
  Clamp base{.position = Vec3(0, 0, 0)};
  Force thrust{.force = {0, 0.02, 0}, .follower = true};  // across the tip, wherever that turns
  Scene scene(precurved(0.2, 32, Section::circle(0.8e-3, Material(5e9, 0.4, 1100)), Vec3(8, 0, 0)),
              {base}, {Gravity{}, thrust});
  Solver solver(scene);
  const Vec3 start = solver.solve(scene).tip();

  std::vector<double> times;
  double worst = 0, residual = 0;
  Vec3 tip = start;
  for (int k = 0; k < steps; ++k) {
    const double t = 1e-3 * k;
    const Vec3 target = start + 0.01 * Vec3(std::sin(2 * t), std::sin(3 * t), 1 - std::cos(t));
    *base.position += target - tip;
    thrust.force.y() = 0.02 * std::cos(2 * t);
    const auto begun = Clock::now();
    const Equilibrium found = solver.solve({.supports = {{0, base}}, .loads = {{1, thrust}}});
    if (!found.converged()) return std::cerr << found.advice() << '\n', 1;
    tip = found.tip();
    times.push_back(std::chrono::duration<double, std::micro>(Clock::now() - begun).count());
    worst = std::max(worst, (tip - target).norm());
    residual = std::max(residual, found.course.residual);
  }

  std::ranges::sort(times);
  const auto part = [&](double of) { return times[std::size_t(of * double(times.size() - 1))]; };
  std::cout << "per step: median " << part(0.5) << ", 99.9 % below " << part(0.999) << ", longest "
            << times.back() << " microseconds; largest residual " << residual
            << "; the tip is at most " << 1e3 * worst << " mm off\n";
  return worst < 2e-4 && residual < 1e-6 ? 0 : 1;
}
