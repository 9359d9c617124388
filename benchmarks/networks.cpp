// SPDX-License-Identifier: BSD-3-Clause
// Grids of k x k rods, joined rigidly or by balls, that sag under their weight between four held
// corners: a whole solve, and the parts of one iteration.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <cstdio>
#include <cstdlib>

namespace pyrod::benchmark {

constexpr int between = 8;  // edges from crossing to crossing

/// Line number `at` of the grid of side 1, along x or along y; a1 points up.
void add_line(Network<Spatial>& net, int k, int at, bool along_x, bool rigid) {
  const int n = between * (k - 1), number = int(net.rods.size());
  const double y = double(at) / (k - 1);
  Mat3 R;
  R.col(0) = Vec3::UnitZ();
  R.col(2) = along_x ? Vec3::UnitX() : Vec3::UnitY();
  R.col(1) = R.col(2).cross(R.col(0));
  const Quaternion frame(R);
  net.rods.push_back(
      Rod<Spatial>::uniform(Grid::uniform(1, n), {1, 1, 0.8}, {4e3, 4e3, 1e4}, Vec3::Zero()));
  net.placements.push_back({along_x ? Vec3(0, y, 0) : Vec3(y, 0, 0), frame});
  net.loads.emplace_back(n);
  for (int j = 0; j <= n; ++j)
    net.loads.back().force[j] = Vec3(0, 0, -5 * net.rods.back().grid.Δs(j));
  for (int i = 0; i < k; ++i) {
    const int node = along_x ? at * k + i : i * k + at;
    net.attachments.push_back({number, between * i, node, rigid, frame});
  }
}

/// Held at one corner, free to move along x at the next, in the plane at the other two; or at all
/// of them, if the rods are joined by balls.
Network<Spatial> grid(int k, bool rigid) {
  Network<Spatial> net;
  for (int i = 0; i < k * k; ++i) {
    net.nodes.emplace_back();
    net.nodes.back().position = Vec3(i % k, i / k, 0) / (k - 1);
  }
  int free = 0;
  for (const int corner : {0, k - 1, k * (k - 1), k * k - 1}) {
    net.nodes[corner].free = Mat3::Identity().leftCols(rigid ? free : 0);
    free = std::min(2, free + 1);
  }
  for (const bool along_x : {true, false})
    for (int at = 0; at < k; ++at) add_line(net, k, at, along_x, rigid);
  return net;
}

void row(int k, bool rigid) {
  const auto net = grid(k, rigid);
  Found<Spatial> result;
  const double all = seconds(
      [&] {
        const Posed<Spatial> posed(net);
        NetworkSolver<Spatial> solver(posed, {}, {}, {});
        result = solver.find();
      },
      3);
  const Posed<Spatial> posed(net);
  const auto& layout = posed.layout();
  const auto& problem = posed.problem();
  auto here = problem.linearisation();
  const auto& state = result.state;
  auto moved = state;
  problem.linearise(state, Hessian::exact, here);
  Ldlt factor(here.hessian);
  Vector δ(here.gradient.size());
  const double ns = 1e9 / result.unknowns;
  const double analyse = ns * seconds([&] { Ldlt again(here.hessian); }, 3);
  const double evaluate = ns * seconds([&] { problem.linearise(state, Hessian::exact, here); }, 3);
  const double factorise = ns * seconds([&] { factor.factorise(); }, 3);
  const double solve = ns * seconds([&] { factor.solve(here.gradient, δ); }, 3);
  δ.setConstant(1e-12);
  const double move = ns * seconds([&] { problem.move(state, δ, moved); }, 3);
  std::printf("%3d %8d %8d %8d %5.1f %4d %5d %9.2f %7.0f %8.0f %7.0f %7.0f %6.0f %6.0f\n", k,
              layout.edges(), result.unknowns, result.multipliers, result.fill,
              int(result.record.size()), result.index, 1e3 * all, ns * all, analyse, evaluate,
              factorise, solve, move);
  std::fflush(stdout);
}

}  // namespace pyrod::benchmark

int main(int argc, char** argv) {
  const int largest = argc > 1 ? std::atoi(argv[1]) : 40;
  std::puts(
      "whole solve [ms], then ns per unknown: of the solve, of the symbolic analysis, and of");
  std::puts("one iteration: evaluation, factor, solve, move\n");
  std::puts(
      "  k    edges unknowns   multip  fill   it index     solve     all  analyse    eval  factor  "
      "solve   move");
  for (const bool rigid : {true, false}) {
    std::puts(rigid ? "joined rigidly" : "\njoined by balls");
    for (const int k : {5, 10, 20, 40})
      if (k <= largest) pyrod::benchmark::row(k, rigid);
  }
}
