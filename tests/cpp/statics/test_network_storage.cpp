// SPDX-License-Identifier: BSD-3-Clause
// What networks do with the storage that solver and problem keep, and long spans, which are
// evaluated piece by piece.
#include "support/network.hpp"

#include "support/allocations.hpp"
#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Clamped at its start; its end, on a spring, may move in some directions.
template <class Space>
Structure<Space> held(Random& random, int edges, int free) {
  Structure<Space> s;
  s.add(random.rod<Space>(edges));
  s.clamp(0, 0);
  s.hinge(0, edges);
  s.net.nodes.back().free = Mat<Space::dim>::Identity().leftCols(free);
  s.net.nodes.back().spring = 1;
  for (auto& F : s.net.loads[0].force) F = random.vector<Space::dim>() / edges;
  return s;
}

/// A closed rod without any node: its last frame is coupled to its first.
template <class Space>
Network<Space> ring(Random& random) {
  Structure<Space> s;
  auto rod = random.rod<Space>(7);
  rod.grid = Grid(rod.grid.edge_lengths(), Closure::closed);
  rod.K0.pop_back();
  rod.bending.pop_back();
  s.add(rod);
  return s.net;
}

template <class Space>
NetworkState<Space> moved_start(Random& random, const Layout<Space>& layout) {
  auto x = Start<Space>(layout).state();
  for (auto& q : x.frames) q = moved(q, random.vector<Space::spin>());
  for (auto& r : x.positions) r += random.vector<Space::dim>();
  for (std::size_t p = 0; p < x.forces.size(); ++p)
    x.forces[p] = layout.spans()[p].open * random.vector(int(layout.spans()[p].open.cols()));
  return x;
}

}  // namespace

TEST_CASE_TEMPLATE("gradient and tangent of spans of any length", Space, EACH_SPACE) {
  Random random(1);
  for (const int edges : {1, 2, 31, 32, 33, 64, 65, 100})
    for (int free = 0; free <= Space::dim; ++free) {
      CAPTURE(edges);
      CAPTURE(free);
      const Layout<Space> layout(held<Space>(random, edges, free).net);
      const NetworkProblem<Space> statics(layout);
      const auto x = moved_start(random, layout);
      auto here = statics.linearisation();
      statics.linearise(x, Hessian::exact, here);
      const Vector δ = random.vector(int(here.gradient.size())) / std::sqrt(edges);
      const auto moved_by = [&](double t) {
        NetworkState<Space> y;
        statics.move(x, t * δ, y);
        auto out = statics.linearisation();
        statics.linearise(y, Hessian::exact, out);
        return out;
      };
      check_slope([&](double t) { return moved_by(t).energy; }, here.gradient.dot(δ), 0.02);
      Vector change;
      here.hessian.multiply(δ, change);
      if constexpr (Space::spin == 3)
        for (int e = 0; e < layout.edges(); ++e) {  // none at an equilibrium
          const int r = layout.frame_row(e);
          const Vec3 g = here.gradient.template segment<3>(r), φ = δ.segment<3>(r);
          change.segment<3>(r) += g.cross(φ) / 2;
        }
      check_derivative([&](double t) { return moved_by(t).gradient; }, change, 0.02);
    }
}

TEST_CASE_TEMPLATE("a span reaches as far as the forces in all of its edges make it", Space,
                   EACH_SPACE) {
  Random random(5);
  for (const int edges : {1, 32, 33, 100}) {
    const auto net = held<Space>(random, edges, 0).net;
    const Layout<Space> layout(net);
    const NetworkProblem<Space> statics(layout);
    const auto x = moved_start(random, layout);
    auto here = statics.linearisation();
    statics.linearise(x, Hessian::exact, here);
    typename NetworkProblem<Space>::Acting changed;
    const auto n = statics.sections(x, statics.acting(x, changed));
    Point<Space> gap = x.positions[1] - x.positions[0];
    for (int j = 0; j < edges; ++j) {
      const Mat<Space::dim> R = matrix(x.frames[j]);
      const Point<Space> S = net.rods[0].stretching[j].cwiseInverse();
      gap -= net.rods[0].grid.h(j) *
             (R * (axis<Space>() + S.cwiseProduct(R.transpose() * n[std::size_t(j)])));
    }
    const auto rows = here.gradient.template tail<Space::dim>();
    CHECK(distance(rows / layout.unit_force(0), gap) < 1e-14 * (1 + net.rods[0].grid.length()));
  }
}

TEST_CASE_TEMPLATE("nothing is left of what the storage held before", Space, EACH_SPACE) {
  Random random(2);
  for (const auto& net : {random_network<Space>(random, {true, true, true}), ring<Space>(random)}) {
    const Layout<Space> layout(net);
    const NetworkProblem<Space> statics(layout);
    const auto x = moved_start(random, layout);
    for (const Hessian kind : {Hessian::exact, Hessian::convex}) {
      auto fresh = statics.linearisation(), used = statics.linearisation();
      std::fill(used.hessian.values.begin(), used.hessian.values.end(), std::nan(""));
      used.gradient.setConstant(std::nan(""));
      used.energy = used.magnitude = std::nan("");
      statics.linearise(x, kind, fresh);
      statics.linearise(x, kind, used);
      CHECK(used.energy == fresh.energy);
      CHECK(used.magnitude == fresh.magnitude);
      CHECK(used.gradient == fresh.gradient);
      CHECK(used.hessian.values == fresh.hessian.values);
    }
  }
}

TEST_CASE_TEMPLATE("once there is storage, networks allocate nothing", Space, EACH_SPACE) {
  Random random(3);
  const Layout<Space> layout(random_network<Space>(random, {true, false, true}));
  const NetworkProblem<Space> statics(layout);
  const auto x = moved_start(random, layout);
  auto here = statics.linearisation();
  auto y = x;
  const Vector δ = random.vector(int(here.gradient.size()));
  Vector out(δ.size());
  const std::size_t before = allocations();
  Eigen::internal::set_is_malloc_allowed(false);  // Eigen's assertions see to it
  statics.linearise(x, Hessian::exact, here);
  statics.linearise(x, Hessian::convex, here);
  statics.move(x, δ, y);
  statics.multiply_skew(x, δ, out);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations() == before);
}

TEST_CASE_TEMPLATE("iterations behind the first allocate nothing", Space, EACH_SPACE) {
  Random random(4);
  auto scene = held<Space>(random, 50, 1);
  for (auto& F : scene.net.loads[0].force) F *= 30;
  const Layout<Space> layout(scene.net);
  const NetworkProblem<Space> statics(layout);
  std::vector<std::size_t> counts;
  counts.reserve(100);
  Newton<NetworkProblem<Space>> newton(statics, {}, [&](const Iteration&) {
    Eigen::internal::set_is_malloc_allowed(false);
    counts.push_back(allocations());
    return true;
  });
  const auto result = newton.solve(Start<Space>(layout).state());
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(result.converged());
  REQUIRE(counts.size() > 3);
  CHECK(counts.back() == counts.front());
}

TEST_CASE_TEMPLATE("what a solve finds does not depend on the networks before it", Space,
                   EACH_SPACE) {
  using P = NetworkProblem<Space>;
  auto& pool = Pool<Workspace<LinearisationOf<P>, typename P::State>>::of_this_thread();
  Random random(6);
  const auto first = held<Space>(random, 20, 1).net, like = held<Space>(random, 20, 1).net,
             other = held<Space>(random, 20, 0).net;
  const auto solve = [&](const Network<Space>& net) {
    const Layout<Space> layout(net);
    const P statics(layout);
    return Newton<P>(statics).solve(Start<Space>(layout).state());
  };
  pool.clear();
  const auto fresh = solve(first);
  CHECK(fresh.converged());
  CHECK(pool.size() == 1);
  solve(like);
  CHECK(pool.size() == 1);
  solve(other);
  CHECK(pool.size() == 2);
  const auto again = solve(first);
  CHECK(pool.size() == 2);
  CHECK(again.iterations() == fresh.iterations());
  CHECK(again.residual == fresh.residual);
  CHECK(distance(again.state.frames, fresh.state.frames) == 0);
}

TEST_CASE_TEMPLATE("storage of another network fits if blocks and multipliers are the same", Space,
                   EACH_SPACE) {
  Random random(7);
  const auto layout_of = [&](int edges, int free) {
    return Layout<Space>(held<Space>(random, edges, free).net);
  };
  const auto one = layout_of(9, 0), two = layout_of(9, 0), longer = layout_of(10, 0),
             freer = layout_of(9, 1);
  const NetworkProblem<Space> of_one(one), of_two(two), of_longer(longer), of_freer(freer);
  const Workspace<LinearisationOf<NetworkProblem<Space>>, NetworkState<Space>> kept(of_one);
  CHECK(kept.fits(of_one));
  CHECK(kept.fits(of_two));
  CHECK(!kept.fits(of_longer));
  CHECK(!kept.fits(of_freer));
  // the same pattern, where a row that was no multiplier's is one
  Vector weights = of_one.stiffness();
  CHECK(kept.factor.multipliers().are(weights));
  weights[0] = 0;
  CHECK(!kept.factor.multipliers().are(weights));
}
