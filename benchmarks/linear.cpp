// SPDX-License-Identifier: BSD-3-Clause
// Products of the linear response, forward and backward, beside one Newton iteration at the same
// state; and what it takes to be ready for them.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace pyrod::benchmark {

/// A rod clamped at its start, at a force across it.
template <class Space>
Network<Space> cantilever(int n) {
  const Rod<Spatial> rod =
      Rod<Spatial>::uniform(Grid::uniform(1, n), {1, 1.5, 0.7}, {4e3, 4e3, 1e4},
                            Space::spin == 3 ? Vec3(0.5, 0.2, 1) : Vec3(0, 0.2, 0));
  Network<Space> out;
  out.rods.push_back(restricted<Space>(rod));
  out.placements.emplace_back();
  out.loads.emplace_back(n);
  out.loads[0].add_force(out.rods[0].grid, restrict_point<Space>({5, 0, 1}), 1);
  out.nodes.emplace_back();
  out.nodes[0].free.resize(Space::dim, 0);
  out.nodes[0].turns.resize(Space::spin, 0);
  out.attachments.push_back({0, 0, 0, true});
  return out;
}

template <class Space>
void row(int n) {
  const Posed<Space> posed(cantilever<Space>(n));
  const auto& problem = posed.problem();
  Newton<NetworkProblem<Space>> newton(problem);
  const auto x = newton.solve(ClampedStart<Space>(posed.layout()).state()).state;

  auto here = problem.linearisation();
  Ldlt factor(here.hessian);
  Vector δ(here.gradient.size());
  auto moved = x;
  const auto iteration = [&] {
    problem.linearise(x, Hessian::exact, here);
    factor.factorise();
    factor.solve(here.gradient, δ);
    problem.move(x, δ, moved);
  };
  std::unique_ptr<LinearResponse<Space>> linear;
  const auto make = [&] { linear = std::make_unique<LinearResponse<Space>>(problem, x); };
  make();
  auto numbers = linear->no_numbers(), gradient = numbers;
  numbers(0, linear->number_items().force(0, n)) = 1;
  auto change = linear->no_change(), weights = change;
  weights.positions(0, linear->positions().column(0, n)) = 1;

  const double scale = 1e9 / n, one = scale * seconds(iteration);
  const double push = scale * seconds([&] { linear->push(numbers, change); });
  const double pull = scale * seconds([&] { linear->pull(weights, gradient); });
  const double ready = scale * seconds(make, 3);
  std::printf("%-8s %8d %9.0f %8.0f %9.0f %6.2f %6.2f %8.0f\n",
              Space::spin == 3 ? "spatial" : "planar", n, one, push, pull, push / one, pull / one,
              ready);
  std::fflush(stdout);
}

}  // namespace pyrod::benchmark

int main(int argc, char** argv) {
  using namespace pyrod;
  const int largest = argc > 1 ? std::atoi(argv[1]) : 100000;
  std::puts(
      "ns per edge: a Newton iteration, a product forward, backward, both over the iteration;");
  std::puts("what it takes to be ready for them\n");
  std::puts("space           n iteration  forward  backward  ratios         ready");
  for (int n = 100; n <= largest; n *= 10) {
    benchmark::row<Planar>(n);
    benchmark::row<Spatial>(n);
  }
}
