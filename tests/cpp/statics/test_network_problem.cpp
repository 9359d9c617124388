// SPDX-License-Identifier: BSD-3-Clause
// Gradient and tangent of networks against differences.
#include "support/network.hpp"

#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random_state.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

static_assert(Problem<NetworkProblem<Planar>>);
static_assert(Problem<NetworkProblem<Spatial>>);

/// Numbers of the first rows of all blocks that are a whole spatial rotation.
template <class Space>
std::vector<int> rotations(const Layout<Space>& layout) {
  std::vector<int> out, first{0};
  for (const int size : layout.sizes()) first.push_back(first.back() + size);
  if (Space::spin == 1) return out;
  for (int e = 0; e < layout.edges(); ++e) out.push_back(first[layout.frame_block(e)]);
  for (int v = 0; v < int(layout.network().nodes.size()); ++v)
    if (const int b = layout.turn_block(v); b >= 0 && layout.sizes()[b] == 3)
      out.push_back(first[b]);
  return out;
}

template <class Space>
struct Check {
  Layout<Space> layout;
  NetworkProblem<Space> statics{layout};
  NetworkState<Space> x;

  Check(Random& random, const Network<Space>& net) : layout(net) {
    x = random_state(random, layout);
  }

  auto linearised(const NetworkState<Space>& at, Hessian kind = Hessian::exact) const {
    auto out = statics.linearisation();
    statics.linearise(at, kind, out);
    return out;
  }
  auto moved_by(const Vector& δ) const {
    NetworkState<Space> y;
    statics.move(x, δ, y);
    return linearised(y);
  }

  void run(Random& random, int directions = 3) const {
    const auto here = linearised(x);
    const int size = int(here.gradient.size());
    for (int k = 0; k < directions; ++k) {
      const Vector δ = random.vector(size);
      if (statics.conservative())
        check_slope([&](double t) { return moved_by(t * δ).energy; }, here.gradient.dot(δ), 0.02);
      Vector change(size), skew_part;
      here.hessian.multiply(δ, change);
      statics.multiply_skew(x, δ, skew_part);
      if (statics.conservative()) CHECK(skew_part.norm() == 0);
      change += skew_part;
      for (const int r : rotations(layout)) {  // none at an equilibrium
        const Vec3 g = here.gradient.template segment<3>(r), φ = δ.segment<3>(r);
        change.segment<3>(r) += g.cross(φ) / 2;
      }
      check_derivative([&](double t) { return moved_by(t * δ).gradient; }, change, 0.02);
    }
  }
};

/// A rod held at its start, and in another way by `support`, with dead forces on it.
template <class Space, class Support>
Network<Space> held(Random& random, const Support& support) {
  Structure<Space> s;
  s.add(random.rod<Space>(6), random.vector<Space::dim>(), random.rotation<Space>());
  s.clamp(0, 0);
  support(s);
  for (auto& F : s.net.loads[0].force) F = random.vector<Space::dim>();
  for (auto& v : s.net.nodes) v.force = random.vector<Space::dim>();
  return s.net;
}

template <class Space, class Support>
void check_support(Random& random, const Support& support) {
  const Check<Space> check(random, held<Space>(random, support));
  CHECK(check.statics.conservative());
  check.run(random, 1);
}

/// Rods that run through moving nodes; one of them is closed.
template <class Space>
Network<Space> crossing(Random& random) {
  Structure<Space> s;
  s.add(random.rod<Space>(14)), s.add(random.rod<Space>(11));
  s.clamp(0, 0), s.hinge(0, 14), s.clamp(1, 0);
  const int one = s.joint(0, 5, 1, 4, false),
            other = s.joint(0, 10, 1, 8, false);  // with 4 edges behind it, and with 3
  auto ring = random.rod<Space>(9);
  ring.grid = Grid(ring.grid.edge_lengths(), Closure::closed);
  ring.K0.pop_back(), ring.bending.pop_back();
  s.add(ring);
  s.net.attachments.push_back({2, 0, one, false});
  s.net.attachments.push_back({2, 4, other, false});
  for (auto& loads : s.net.loads)
    for (auto& F : loads.force) F = random.vector<Space::dim>();
  return s.net;
}

}  // namespace

TEST_CASE_TEMPLATE("each support by itself: gradient and tangent", Space, EACH_SPACE) {
  Random random(1);
  SUBCASE("none") {
    check_support<Space>(random, [](auto&) {});
  }
  SUBCASE("clamp") {
    check_support<Space>(random, [](auto& s) { s.clamp(0, 6); });
  }
  SUBCASE("clamp in mid-rod") {
    check_support<Space>(random, [](auto& s) { s.clamp(0, 3); });
  }
  SUBCASE("hinge") {
    check_support<Space>(random, [](auto& s) { s.hinge(0, 6); });
  }
  SUBCASE("hinge in mid-rod") {
    check_support<Space>(random, [](auto& s) { s.hinge(0, 2); });
  }
  SUBCASE("roller") {
    check_support<Space>(random, [](auto& s) { s.roller(0, 6, 0); });
  }
  SUBCASE("roller in mid-rod") {
    check_support<Space>(random, [](auto& s) { s.roller(0, 4, 0); });
  }
  SUBCASE("slider") {
    check_support<Space>(random, [](auto& s) { s.slider(0, 6, 1); });
  }
  SUBCASE("pivot") {
    check_support<Space>(random, [](auto& s) { s.pivot(0, 6); });
  }
  SUBCASE("pivot in mid-rod") {
    check_support<Space>(random, [](auto& s) { s.pivot(0, 3); });
  }
  SUBCASE("spring") {
    check_support<Space>(random, [](auto& s) { s.spring(0, 6, 3, 0); });
  }
  SUBCASE("torsion") {
    check_support<Space>(random, [](auto& s) { s.spring(0, 6, 0, 2); });
  }
  SUBCASE("both in mid-rod") {
    check_support<Space>(random, [](auto& s) { s.spring(0, 3, 3, 2); });
  }
  SUBCASE("ring") {
    check_support<Space>(random, [](auto& s) { s.joint(0, 2, 0, 6, true); });
  }
  SUBCASE("loop on a hinge") {
    check_support<Space>(random, [&](auto& s) {
      s.joint(0, 2, 0, 6, true);
      s.net.attachments.back().hinge = random.turn<Space>(1);
    });
  }
  SUBCASE("loop on a ball joint") {
    check_support<Space>(random, [](auto& s) { s.joint(0, 2, 0, 6, false); });
  }
}

TEST_CASE_TEMPLATE("everything at once: with and without moments, followers, closed rods", Space,
                   EACH_SPACE) {
  Random random(2);
  for (const bool moments : {false, true})
    for (const bool followers : {false, true})
      for (const bool closed : {false, true}) {
        CAPTURE(moments);
        CAPTURE(followers);
        CAPTURE(closed);
        const Check<Space> check(random,
                                 random_network<Space>(random, {moments, followers, closed}));
        CHECK(check.statics.conservative() == (!followers && (Space::spin == 1 || !moments)));
        check.run(random);
      }
}

TEST_CASE_TEMPLATE("the convex Hessian stands in for the exact one", Space, EACH_SPACE) {
  Random random(3);
  const Check<Space> check(random, random_network<Space>(random, {.closed = true}));
  const auto exact = check.linearised(check.x);
  const auto convex = check.linearised(check.x, Hessian::convex);
  CHECK(convex.energy == exact.energy);
  CHECK(distance(convex.gradient, exact.gradient) == 0);
  const Vector& weights = check.statics.weights();
  std::vector<int> primal, rest;
  for (int k = 0; k < int(weights.size()); ++k) (weights[k] > 0 ? primal : rest).push_back(k);
  const Dense A = dense(convex.hessian), B = dense(exact.hessian);
  CHECK(eigenvalues(A(primal, primal))[0] > -1e-13 * A.norm());
  CHECK(eigenvalues(B(primal, primal))[0] < 0);  // where it is needed
  CHECK(distance(A(rest, primal), B(rest, primal)) == 0);
  CHECK(distance(A(rest, rest), B(rest, rest)) == 0);
}

TEST_CASE_TEMPLATE("a part of the loads is a network with that part of them", Space, EACH_SPACE) {
  Random random(4);
  const double part = 0.3;
  const auto net = random_network<Space>(random, {true, true, true});
  auto weaker = net;
  for (auto& loads : weaker.loads) {
    for (auto& F : loads.force) F *= part;
    for (auto& m : loads.moment) m *= part;
    loads.start_moment *= part, loads.end_moment *= part, loads.follower_end_moment *= part;
    for (auto& f : loads.follower_forces) f.force *= part;
    for (auto& m : loads.follower_moments) m.moment *= part;
  }
  for (auto& v : weaker.nodes) v.force *= part, v.moment *= part;
  Check<Space> whole(random, net);
  const Check<Space> reduced(random, weaker);
  const auto full = whole.linearised(whole.x);
  whole.statics.load(part);
  const auto a = whole.linearised(whole.x), b = reduced.linearised(whole.x);
  CHECK(distance(a.gradient, b.gradient) < 1e-13 * b.gradient.norm());
  CHECK(distance(dense(a.hessian), dense(b.hessian)) < 1e-13 * dense(b.hessian).norm());
  CHECK(distance(full.gradient, a.gradient) > 0.1);
  const Vector δ = random.vector(int(a.gradient.size()));
  Vector wa, wb;
  whole.statics.multiply_skew(whole.x, δ, wa);
  reduced.statics.multiply_skew(whole.x, δ, wb);
  CHECK(distance(wa, wb) < 1e-13 * wb.norm());
}

TEST_CASE_TEMPLATE("weights: the share of each unknown in the length, none for multipliers", Space,
                   EACH_SPACE) {
  Random random(5);
  const Check<Space> check(random, random_network<Space>(random, {}));
  const auto& layout = check.layout;
  const Vector& weights = check.statics.weights();
  int row = 0, multipliers = 0;
  double frames = 0;
  for (int b = 0; b < int(layout.sizes().size()); ++b) {
    const int size = layout.sizes()[b];
    for (const auto& span : layout.spans())
      if (span.block == b) {
        CHECK(weights.segment(row, size).norm() == 0);
        multipliers += size;
      }
    for (int e = 0; e < layout.edges(); ++e)
      if (layout.frame_block(e) == b) frames += weights.segment(row, size).sum();
    row += size;
  }
  CHECK(row == int(weights.size()));
  CHECK(frames == doctest::Approx(Space::spin).epsilon(1e-14));
  CHECK((weights.array() == 0).count() == multipliers);
  CHECK(multipliers > 0);
}

TEST_CASE_TEMPLATE("rods that run through moving nodes: gradient, tangent, and inertia", Space,
                   EACH_SPACE) {
  Random random(7);
  const Check<Space> check(random, crossing<Space>(random));
  int apart = 0;
  for (int p = 0; p < int(check.layout.spans().size()); ++p) apart += check.layout.apart(p);
  CHECK(apart == 5);
  CHECK(check.statics.conservative());
  check.run(random);
  for (const Hessian kind : {Hessian::exact, Hessian::convex}) {
    const auto here = check.linearised(check.x, kind);
    CHECK(Ldlt(here.hessian).factorise().negative == negative_eigenvalues(dense(here.hessian)));
  }
}
