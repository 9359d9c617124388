// SPDX-License-Identifier: BSD-3-Clause
// Random spatial cantilevers from their rest shape in one call: how many iterations, how many fail.
#include <pyrod/pyrod.hpp>

#include <algorithm>
#include <cstdio>
#include <random>

namespace {

using namespace pyrod;

std::mt19937 generator(1);
double normal() { return std::normal_distribution<double>()(generator); }
Vec3 direction() { return Vec3(normal(), normal(), normal()).normalized(); }

/// EI1 = 1, EI2 and GJ spread over a factor of 30, |K0| L as given, n = 64.
Equilibrium solve_random(double force, double curvature, double moment) {
  const int n = 64;
  const Vec3 bending(1, std::exp(1.15 * normal()), 0.6 * std::exp(0.5 * normal()));
  const Section section(bending[0], bending[1], bending[2]);
  const auto rod = precurved(1.0, n, section, Vec3(curvature * direction()));
  std::vector<Load> loads{Force{force * direction()}};
  if (moment > 0) loads.push_back(Moment{moment * direction()});
  return solve(Scene({rod}, {Clamp{}}, loads));
}

void row(double force, double curvature, double moment) {
  const int rods = 200;
  std::vector<int> iterations;
  int failed = 0, unstable = 0;
  for (int i = 0; i < rods; ++i) {
    const auto found = solve_random(force, curvature, moment);
    if (found.converged())
      iterations.push_back(int(found.course.record.size()));
    else
      ++failed;
    unstable += found.index() > 0;
  }
  std::sort(iterations.begin(), iterations.end());
  const auto quantile = [&](double q) {
    return iterations.empty() ? 0 : iterations[std::size_t(q * double(iterations.size() - 1))];
  };
  std::printf("%8g %8g %8g %8d %8d %8d %8d %8d %8d\n", force, curvature, moment, quantile(0.5),
              quantile(0.9), quantile(0.99), quantile(1), failed, unstable);
}

}  // namespace

int main() {
  std::puts(
      "200 random rods a line; F L2/EI1, |K0| L, M L/EI1; iterations: median, 90 %, 99 %, most\n");
  std::puts("   force     bent   moment   median     90 %     99 %     most   failed unstable");
  for (double force : {1., 10., 100., 1000.})
    for (double curvature : {0., 1.5, 6.}) row(force, curvature, 0);
  for (double moment : {0.5, 3., 10.})
    for (double force : {0., 1., 10., 100.}) row(force, 1.5, moment);
}
