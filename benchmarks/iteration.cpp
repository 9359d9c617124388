// SPDX-License-Identifier: BSD-3-Clause
// One Newton iteration in nanoseconds per edge, split, beside a bare CHOLMOD factor + solve of the
// same matrix in the same run; and a whole solve from the straight start.
#include "clamped.hpp"
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>
#include <cstdlib>

namespace pyrod::benchmark {

/// CHOLMOD alone, called as its manual says: simplicial LDLᵀ in the given order, and one solve.
double bare_cholmod(SymmetricMatrix A, Vector b) {
  cholmod_common common;
  cholmod_start(&common);
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = false;
  common.supernodal = CHOLMOD_SIMPLICIAL;
  const auto n = std::size_t(b.size());
  cholmod_sparse matrix{
      n,       n, A.values.size(), A.starts.data(), A.rows.data(),  nullptr, A.values.data(),
      nullptr, 1, CHOLMOD_INT,     CHOLMOD_REAL,    CHOLMOD_DOUBLE, true,    true};
  cholmod_dense right{n, 1, n, n, b.data(), nullptr, CHOLMOD_REAL, CHOLMOD_DOUBLE};
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;
  cholmod_factor* factor = cholmod_analyze(&matrix, &common);
  const double time = seconds([&] {
    cholmod_factorize(&matrix, factor, &common);
    cholmod_solve2(CHOLMOD_A, factor, &right, nullptr, &x, nullptr, &y, &e, &common);
  });
  for (auto* dense : {&x, &y, &e}) cholmod_free_dense(dense, &common);
  cholmod_free_factor(&factor, &common);
  cholmod_finish(&common);
  return time;
}

/// Bytes per edge of what is kept from one solve to the next.
template <class P>
double kept_memory(const P& problem, const typename P::State& start) {
  Workspace<LinearisationOf<P>, typename P::State> kept(problem);
  kept.factor.factorise(0);
  kept.factor.solve(kept.δ, kept.trial);
  kept.from = start;
  return double(kept.bytes()) / double(start.frames.size());
}

template <class Space>
void row(int n, ModelKind model, const char* name) {
  const auto scene_rod = in_model(rod<Space>(n), model);
  Loads<Space> loads(n);
  loads.add_force(scene_rod.grid, restrict_point<Space>({5, 0, 1}), 1);
  const Posed<Space> posed(clamped(scene_rod, loads));
  const auto& problem = posed.problem();

  auto here = problem.linearisation();
  const auto start = ClampedStart<Space>(posed.layout()).state();
  auto state = start, moved = state;
  Ldlt factor(here.hessian);
  Vector δ(here.gradient.size());
  const auto step = [&](Hessian curvature) {
    problem.linearise(state, curvature, here);
    factor.factorise();
    factor.solve(here.gradient, δ);
    δ = -δ;
    problem.move(state, δ, moved);
  };
  step(Hessian::convex);
  std::swap(state, moved);

  const double scale = 1e9 / n;
  const double evaluate = scale * seconds([&] { problem.linearise(state, Hessian::exact, here); });
  const double factorise = scale * seconds([&] { factor.factorise(); });
  const double solve = scale * seconds([&] { factor.solve(here.gradient, δ); });
  const double move = scale * seconds([&] { problem.move(state, δ, moved); });
  const double iteration = scale * seconds([&] { step(Hessian::exact); });
  const double bare = scale * bare_cholmod(here.hessian, here.gradient);

  Newton<NetworkProblem<Space>> newton(problem);
  int iterations = 0;
  const double newton_time = seconds([&] { iterations = newton.solve(start).iterations(); }, 3);
  const double all = seconds([&] { told(posed, find<Space>(posed, {}, {}, {}, {})); }, 3);
  std::printf(
      "%-8s %-12s %8d %6.1f %6.0f %6.0f %6.1f %6.0f %6.0f %6.2f %4d %7.0f %6.2f %10.3f %6.0f\n",
      Space::spin == 3 ? "spatial" : "planar", name, n, evaluate, factorise, solve, move, iteration,
      bare, iteration / bare, iterations, scale * newton_time / iterations,
      scale * newton_time / iterations / bare, 1e3 * all, kept_memory(problem, start));
  std::fflush(stdout);
}

template <class Space>
void rows(int n) {
  row<Space>(n, ModelKind::cosserat, "cosserat");
  row<Space>(n, ModelKind::extensible, "extensible");
  row<Space>(n, ModelKind::inextensible, "inextensible");
}

}  // namespace pyrod::benchmark

int main(int argc, char** argv) {
  using namespace pyrod;
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  std::puts("ns per edge: evaluation (energy, gradient, Hessian), factor, solve, move, the whole");
  std::puts(
      "iteration, bare CHOLMOD factor + solve, their ratio; iterations of a solve from rest, ns");
  std::puts(
      "per edge and iteration of all of Newton, beside bare; ms of the whole call with results;");
  std::puts("bytes per edge kept for the next solve\n");
  std::puts(
      "space    model               n   eval factor  solve   move   iter   bare  ratio   it  newton"
      "  ratio    call/ms  bytes");
  for (int n = 100; n <= largest; n *= 10) {
    benchmark::rows<Planar>(n);
    benchmark::rows<Spatial>(n);
  }
}
