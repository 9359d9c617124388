// SPDX-License-Identifier: BSD-3-Clause
// Products of the linear response, forward and backward, beside one Newton iteration at the same
// state; and what it takes to be ready for them.
#include "clamped.hpp"
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace pyrod::benchmark {

/// With a force across its end.
template <class Space>
Network<Space> cantilever(int n) {
  const auto made = rod<Space>(n);
  Loads<Space> loads(n);
  loads.add_force(made.grid, restrict_point<Space>({5, 0, 1}), 1);
  return clamped(made, loads);
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
