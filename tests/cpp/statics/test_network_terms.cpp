// SPDX-License-Identifier: BSD-3-Clause
// Tendons in networks: gradient and tangent against differences, and what they leave alone.
#include "support/network.hpp"

#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random_state.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

std::shared_ptr<const Routing> wavy() {
  return std::make_shared<const Routing>(
      [](double s) { return Vec2(0.1 * std::cos(2 * s), 0.07 * std::sin(3 * s)); });
}

template <class Space>
RoutedTendon tendon(const Network<Space>& net, int rod, int first, int last, double tension) {
  return {rod, first, last, tension, {}, wavy(), net.rods[rod].grid};
}

/// Numbers of the first rows of all blocks that are a whole spatial rotation.
template <class Space>
std::vector<int> rotations(const Layout<Space>& layout) {
  std::vector<int> out;
  if (Space::spin == 1) return out;
  for (int e = 0; e < layout.edges(); ++e) out.push_back(layout.frame_row(e));
  for (int v = 0; v < int(layout.network().nodes.size()); ++v)
    if (const int b = layout.turn_block(v); b >= 0 && layout.sizes()[b] == 3)
      out.push_back(layout.row(b));
  return out;
}

template <class Space>
void check(Random& random, const Network<Space>& net) {
  const Layout<Space> layout(net);
  const NetworkProblem<Space> statics(layout);
  CHECK(statics.conservative());
  const auto x = random_state(random, layout);
  const auto linearised = [&](const NetworkState<Space>& at) {
    auto out = statics.linearisation();
    statics.linearise(at, Hessian::exact, out);
    return out;
  };
  const auto here = linearised(x);
  const int size = int(here.gradient.size());
  const Vector δ = random.vector(size);
  const auto moved_by = [&](double t) {
    NetworkState<Space> y;
    statics.move(x, t * δ, y);
    return linearised(y);
  };
  check_slope([&](double t) { return moved_by(t).energy; }, here.gradient.dot(δ), 0.02);
  Vector change(size);
  here.hessian.multiply(δ, change);
  for (const int r : rotations(layout)) {  // none at an equilibrium
    const Vec3 g = here.gradient.template segment<3>(r), φ = δ.segment<3>(r);
    change.segment<3>(r) += g.cross(φ) / 2;
  }
  check_derivative([&](double t) { return moved_by(t).gradient; }, change, 0.02);
}

template <class Space>
Structure<Space> clamped(Random& random) {
  Structure<Space> s;
  s.add(random.rod<Space>(8), random.vector<Space::dim>(), random.rotation<Space>());
  s.clamp(0, 0);
  for (auto& F : s.net.loads[0].force) F = random.vector<Space::dim>();
  return s;
}

}  // namespace

TEST_CASE_TEMPLATE("tendons: gradient and tangent, however the rod is held", Space, EACH_SPACE) {
  Random random(31);
  auto s = clamped<Space>(random);
  int first = 0, last = 8;
  SUBCASE("free end") {}
  SUBCASE("clamps") { s.clamp(0, 8); }
  SUBCASE("hinge inside") { s.hinge(0, 3); }
  SUBCASE("slider at the end") { s.slider(0, 8, 1); }
  SUBCASE("pivot inside") { s.pivot(0, 3); }
  SUBCASE("node with a frame, where it begins and ends") {
    s.net.nodes[s.hold(0, 2, s.anywhere(), s.turning(), true)].parts_cell = true;
    s.net.nodes[s.hold(0, 6, s.anywhere(), s.turning(), true)].parts_cell = true;
    first = 2, last = 6;
  }
  SUBCASE("hinge joint") {
    s.joint(0, 2, 0, 6, true);
    s.net.attachments.back().hinge = random.turn<Space>(1);
  }
  s.net.tendons.push_back(tendon(s.net, 0, first, last, 1.7));
  s.net.tendons.push_back(tendon(s.net, 0, first, last, 0.4));
  check(random, s.net);
  for (auto& one : s.net.tendons) one.length = 0.9, one.softness = 0.3;
  check(random, s.net);  // of given length
}

TEST_CASE_TEMPLATE("tendons of one rod leave the rows of others alone, to the last bit", Space,
                   EACH_SPACE) {
  Random random(32);
  auto s = clamped<Space>(random);
  s.add(random.rod<Space>(9));
  s.clamp(1, 0), s.clamp(1, 9);
  auto with = s.net;
  with.tendons.push_back(tendon(s.net, 0, 0, 8, 2));
  const Layout<Space> layout(s.net), other(with);
  const NetworkProblem<Space> bare(layout), driven(other);
  CHECK(!bare.has_terms());
  CHECK(driven.has_terms());
  const auto x = random_state(random, layout);
  auto a = bare.linearisation(), b = driven.linearisation();
  bare.linearise(x, Hessian::exact, a), driven.linearise(x, Hessian::exact, b);
  int same = 0, differing = 0;
  for (int e = 0; e < layout.edges(); ++e) {
    const int row = layout.frame_row(e);
    const bool alike = a.gradient.template segment<Space::spin>(row) ==
                       b.gradient.template segment<Space::spin>(row);
    ++(alike ? same : differing);
    CHECK(alike == (e >= 8));
  }
  CHECK(same == 9);
  CHECK(differing == 8);
}

TEST_CASE_TEMPLATE("the convex Hessian is that without tendons", Space, EACH_SPACE) {
  Random random(33);
  auto s = clamped<Space>(random);
  auto with = s.net;
  with.tendons.push_back(tendon(s.net, 0, 0, 8, 2));
  const Layout<Space> layout(s.net), other(with);
  const NetworkProblem<Space> bare(layout), driven(other);
  const auto x = random_state(random, layout);
  auto a = bare.linearisation(), b = driven.linearisation(), c = driven.linearisation();
  bare.linearise(x, Hessian::convex, a), driven.linearise(x, Hessian::convex, b);
  driven.linearise(x, Hessian::exact, c);
  CHECK(distance(dense(a.hessian), dense(b.hessian)) == 0);
  CHECK(distance(b.gradient, c.gradient) == 0);
}
