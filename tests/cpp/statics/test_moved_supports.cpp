// SPDX-License-Identifier: BSD-3-Clause
// The last resort: supports moved from where the rods are at rest to where they are.
#include <pyrod/solve/homotopy.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/start/moving_supports.hpp>
#include <pyrod/statics/start/start.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A bent rod clamped at both ends, the second of them elsewhere than at rest.
template <class Space>
Network<Space> pulled(const Point<Space>& aside, const Spin<Space>& turn, int turns = 0) {
  constexpr int dim = Space::dim, spin = Space::spin;
  Structure<Space> s;
  const int n = 16;
  Spin<Space> K0 = Spin<Space>::Zero();
  K0[spin / 2] = 0.5;
  s.add(Rod<Space>::uniform(Grid::uniform(1, n), Spin<Space>::LinSpaced(1, 2),
                            1e3 * Point<Space>::Ones(), K0));
  s.hold(0, 0, Directions<dim>(dim, 0), Directions<spin>(spin, 0), true);
  const int end = s.hold(0, n, Directions<dim>(dim, 0), Directions<spin>(spin, 0), true);
  s.net.nodes[end].position += aside;
  s.net.nodes[end].frame = moved(s.net.nodes[end].frame, turn);
  s.net.attachments.back().turns = turns;
  return s.net;
}

}  // namespace

TEST_CASE_TEMPLATE("at first all is at rest, at last all is where it is held", Space, EACH_SPACE) {
  Random random(1);
  const Layout<Space> layout(
      pulled<Space>(0.1 * random.vector<Space::dim>(), random.turn<Space>(0.4)));
  const Start<Space> shapes(layout);
  const NetworkProblem<Space> problem(layout);
  const auto rest = shapes.at_rest();
  auto x = rest;
  move_supports(layout, 0, rest, x);
  CHECK(distance(x.positions, rest.positions) < 1e-15);
  CHECK(distance(x.node_frames, rest.node_frames) < 1e-15);
  auto here = problem.linearisation();
  problem.linearise(x, Hessian::exact, here);
  CHECK(here.gradient.norm() < 1e-12 * problem.unit_energy());

  move_supports(layout, 1, rest, x);
  for (int v = 0; v < 2; ++v) {
    const auto& node = layout.network().nodes[v];
    CHECK(distance(x.positions[v], node.position) < 1e-15);
    CHECK(distance(x.node_frames[v], node.frame) < 1e-14);
  }
  move_supports(layout, 0.5, rest, x);
  CHECK(distance(x.positions[1],
                 Point<Space>((rest.positions[1] + layout.network().nodes[1].position) / 2)) <
        1e-15);
}

TEST_CASE_TEMPLATE("what may slide is not moved along", Space, EACH_SPACE) {
  constexpr int dim = Space::dim;
  auto net = pulled<Space>(0.1 * Point<Space>::Ones(), Spin<Space>::Zero());
  net.nodes[1].free = Mat<dim>::Identity().leftCols(1);
  const Layout<Space> layout(net);
  const Start<Space> shapes(layout);
  const auto rest = shapes.at_rest();
  auto x = rest;
  move_supports(layout, 1, rest, x);
  CHECK(x.positions[1][0] == doctest::Approx(rest.positions[1][0]).epsilon(1e-14));
  CHECK(x.positions[1][dim - 1] == doctest::Approx(net.nodes[1].position[dim - 1]).epsilon(1e-14));
}

TEST_CASE("followed from rest, the rod arrives stable, with the turns that are put in") {
  std::vector<double> twist;
  for (const int turns : {0, 1}) {
    const Layout<Spatial> layout(pulled<Spatial>({0.1, 0.05, -0.3}, {0.2, 0.1, 0.3}, turns));
    const Start<Spatial> shapes(layout);
    const NetworkProblem<Spatial> problem(layout);
    Newton<NetworkProblem<Spatial>> newton(problem);
    const auto rest = shapes.at_rest();
    const auto path = follow(
        newton, [&](double λ, NetworkState<Spatial>& x) { move_supports(layout, λ, rest, x); },
        rest);
    REQUIRE(path.result.converged());
    CHECK(path.result.index == 0);
    CHECK(path.steps >= 4);
    twist.push_back(0);
    const auto& q = path.result.state.frames;
    for (std::size_t j = 1; j < q.size(); ++j) twist.back() += log(q[j - 1].conjugate() * q[j]).z();
  }
  CHECK(std::round((twist[1] - twist[0]) / (2 * std::numbers::pi)) == 1);
}
