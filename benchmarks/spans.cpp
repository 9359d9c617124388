// SPDX-License-Identifier: BSD-3-Clause
// A rod clamped at both ends: one iteration in nanoseconds per edge beside bare CHOLMOD. And a rod
// on many hinges: its matrix factorised as a whole, or its frames alone with a dense Schur
// complement for the section forces of the spans.
#include "measure.hpp"

#include <pyrod/pyrod.hpp>

#include <Eigen/Cholesky>

#include <cstdio>
#include <cstdlib>

namespace pyrod::benchmark {

/// Clamped at both ends and hinged in between so that there are `spans` spans, each a tenth shorter
/// than its rod; anisotropic, precurved.
Network<Spatial> held(int n, int spans) {
  Network<Spatial> net;
  net.rods.push_back(Rod<Spatial>::uniform(Grid::uniform(1, n), {1, 1.5, 0.7}, {4e3, 4e3, 1e4},
                                           Vec3(0.5, 0.2, 1)));
  net.placements.emplace_back();
  net.loads.emplace_back(n);
  for (int i = 0; i <= spans; ++i) {
    const bool end = i == 0 || i == spans;
    Node<Spatial> node;
    node.position = Vec3(0, 0, 0.9 * i / spans);
    node.free = Directions<3>(3, 0);
    if (end) node.turns = Directions<3>(3, 0);
    net.nodes.push_back(node);
    net.attachments.push_back({0, n / spans * i, i, end});
  }
  return net;
}

/// The frames' matrix H, and what moments it with the forces: K = [H B; Bᵀ −A].
struct Parts {
  SymmetricMatrix H;
  Eigen::MatrixXd B, A;

  Parts(const SymmetricMatrix& K, const Vector& weights) {
    std::vector<int> number;  // among the frames, or among the forces
    int frames = 0, forces = 0;
    for (int k = 0; k < K.size(); ++k) number.push_back(weights[k] > 0 ? frames++ : forces++);
    B = Eigen::MatrixXd::Zero(frames, forces);
    A = Eigen::MatrixXd::Zero(forces, forces);
    for (int k = 0; k < K.size(); ++k) {
      for (int e = K.starts[k]; e < K.starts[k + 1]; ++e) {
        const int i = K.rows[e];
        if (weights[k] == 0 && weights[i] == 0)
          A(number[i], number[k]) = A(number[k], number[i]) = -K.values[e];
        else if (weights[k] == 0 || weights[i] == 0)
          B(number[weights[k] > 0 ? k : i], number[weights[k] > 0 ? i : k]) = K.values[e];
        else
          H.rows.push_back(number[i]), H.values.push_back(K.values[e]);
      }
      if (weights[k] > 0) H.starts.push_back(int(H.rows.size()));
    }
  }
};

/// Solves with H factorised, one more right-hand side per component of a force, and the dense
/// Schur complement A + Bᵀ H⁻¹ B.
class Schur {
 public:
  explicit Schur(Parts& parts) : parts_(parts), factor_(parts.H), HB_(parts.B) {}

  Vector solve(const Vector& g) {
    factor_.factorise();
    const Eigen::Index frames = parts_.B.rows();
    Vector x = g.head(frames);
    factor_.solve(x, x);
    for (Eigen::Index i = 0; i < HB_.cols(); ++i) {
      column_ = parts_.B.col(i);
      factor_.solve(column_, column_);
      HB_.col(i) = column_;
    }
    const Eigen::MatrixXd S = parts_.A + parts_.B.transpose() * HB_;
    Vector out(g.size());
    out.tail(S.rows()) = S.ldlt().solve(parts_.B.transpose() * x - g.tail(S.rows()));
    out.head(frames) = x - HB_ * out.tail(S.rows());
    return out;
  }

 private:
  Parts& parts_;
  Ldlt factor_;
  Eigen::MatrixXd HB_;
  Vector column_;
};

/// A network at its equilibrium.
struct Solved {
  Posed<Spatial> posed;
  const Layout<Spatial>& layout = posed.layout();
  const NetworkProblem<Spatial>& problem = posed.problem();
  Found<Spatial> result;
  LinearisationOf<NetworkProblem<Spatial>> here;

  explicit Solved(const Network<Spatial>& net) : posed(net), here(problem.linearisation()) {
    NetworkSolver<Spatial> solver(posed, {}, {}, {});
    result = solver.find();
    problem.linearise(result.state, Hessian::exact, here);
  }
};

void iteration(int n) {
  const auto net = held(n, 1);
  Solved at(net);
  Ldlt factor(at.here.hessian);
  auto moved = at.result.state;
  Vector δ(at.here.gradient.size());
  const auto step = [&] {
    at.problem.linearise(at.result.state, Hessian::exact, at.here);
    factor.factorise();
    factor.solve(at.here.gradient, δ);
    at.problem.move(at.result.state, δ, moved);
  };
  const double ns = 1e9 / n;
  const double evaluate =
      ns * seconds([&] { at.problem.linearise(at.result.state, Hessian::exact, at.here); });
  const double factorise = ns * seconds([&] { factor.factorise(); });
  const double solve = ns * seconds([&] { factor.solve(at.here.gradient, δ); });
  const double move = ns * seconds([&] { at.problem.move(at.result.state, δ, moved); });
  const double all = ns * seconds(step);
  const double bare = ns * seconds([&] {
                        factor.factorise();
                        factor.solve(at.here.gradient, δ);
                      });
  const double call = seconds(
      [&] {
        const Posed<Spatial> posed(net);
        told(posed, find<Spatial>(posed, {}, {}, {}, {}));
      },
      3);
  std::printf("%8d %6.0f %7.0f %6.0f %5.0f %6.0f %6.0f %6.2f %6.2f %4d %9.3f\n", n, evaluate,
              factorise, solve, move, all, bare, all / bare, at.result.fill,
              int(at.result.record.size()), 1e3 * call);
  std::fflush(stdout);
}

void schur(int n, int spans) {
  Solved at(held(n, spans));
  Ldlt whole(at.here.hessian);
  const Vector weights = at.problem.weights();
  Parts parts(at.here.hessian, weights);
  Schur complement(parts);
  const Vector g = Vector::LinSpaced(weights.size(), -1, 1);
  Vector x(g.size()), ordered(g.size());
  int frames = 0, forces = int(parts.B.rows());  // g with the forces last
  std::vector<int> place;
  for (int k = 0; k < int(g.size()); ++k) place.push_back(weights[k] > 0 ? frames++ : forces++);
  for (int k = 0; k < int(g.size()); ++k) ordered[place[k]] = g[k];
  const double ns = 1e9 / n;
  const double one = ns * seconds([&] {
                       whole.factorise();
                       whole.solve(g, x);
                     });
  Vector y;
  const double two = ns * seconds([&] { y = complement.solve(ordered); });
  double off = 0;
  for (int k = 0; k < int(g.size()); ++k) off = std::max(off, std::abs(y[place[k]] - x[k]));
  std::printf("%8d %6d %8.0f %8.0f %8.1f %12.1e\n", n, spans, one, two, two / one,
              off / x.lpNorm<Eigen::Infinity>());
  std::fflush(stdout);
}

}  // namespace pyrod::benchmark

int main(int argc, char** argv) {
  using namespace pyrod;
  const int largest = argc > 1 ? std::atoi(argv[1]) : 1000000;
  std::puts(
      "ns per edge: evaluation, factor, solve, move, the whole iteration, bare CHOLMOD; their");
  std::puts("ratio; fill; iterations of a solve on all grids; ms of the whole call\n");
  std::puts("       n   eval  factor  solve  move   iter   bare  ratio   fill   it   call/ms");
  for (int n = 100; n <= largest; n *= 10) benchmark::iteration(n);
  std::puts("\nns per edge of factor + solve: the whole matrix, or frames and Schur complement\n");
  std::puts("       n  spans    whole    Schur    ratio   difference");
  for (const int spans : {1, 2, 8, 64}) benchmark::schur(1024, spans);
  for (const int spans : {1, 2, 8, 64})
    if (largest >= 16384) benchmark::schur(16384, spans);
}
