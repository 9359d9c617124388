// SPDX-License-Identifier: BSD-3-Clause
// What the loads tell of the section forces, and networks that nothing holds.
#include "support/network.hpp"

#include "support/dense.hpp"
#include "support/models.hpp"
#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
void load(Random& random, Structure<Space>& s) {
  for (auto& loads : s.net.loads)
    for (auto& F : loads.force) F = random.vector<Space::dim>();
  for (auto& v : s.net.nodes) v.force = random.vector<Space::dim>();
}

/// What is not balanced at a node along its free directions, where only what is known acts.
template <class Space>
Vector imbalance(const Layout<Space>& layout, int v, const std::vector<Point<Space>>& known) {
  const auto dead = layout.known().dead_forces();
  Point<Space> sum = -layout.known().on_nodes(dead)[v];
  for (const auto& [p, end] : layout.spans_at(v)) {
    const auto& span = layout.spans()[p];
    if (end)
      sum += known[p] - layout.known().inside(span, dead);
    else
      sum -= known[p];
  }
  return layout.network().nodes[v].free.transpose() * sum / layout.unit_length(v);
}

template <class Space>
Structure<Space> tree() {
  Structure<Space> s;
  s.add(4), s.add(5), s.add(3), s.add(6);
  s.clamp(0, 2);  // in mid-rod
  const int v = s.joint(0, 4, 1, 0, true);
  s.attach(2, 3, v, false);
  s.joint(1, 2, 3, 4, true);
  return s;
}

/// Two rods with a joint, held nowhere.
template <class Space>
Structure<Space> loose(Random& random) {
  Structure<Space> s;
  s.add(3), s.add(4);
  s.joint(0, 3, 1, 0, true);
  for (auto& loads : s.net.loads)
    for (auto& F : loads.force) F = random.vector<Space::dim>();
  return s;
}

template <class Space>
Point<Space> total(const Network<Space>& net) {
  Point<Space> sum = Point<Space>::Zero();
  for (const auto& loads : net.loads)
    for (const auto& F : loads.force) sum += F;
  for (const auto& v : net.nodes) sum += v.force;
  return sum;
}

}  // namespace

TEST_CASE_TEMPLATE("in a tree the loads tell all section forces, and all nodes balance", Space,
                   EACH_SPACE) {
  Random random(1);
  auto s = tree<Space>();
  load(random, s);
  const Layout<Space> layout(s.net);
  const auto known = layout.known().known_forces(layout.known().dead_forces());
  for (const auto& span : layout.spans()) CHECK(span.open.cols() == 0);
  for (int v = 0; v < int(layout.network().nodes.size()); ++v) {
    CHECK(imbalance(layout, v, known).norm() < 1e-14);
    CHECK(layout.derived(v) == (v != 0));
  }
  // at the clamp in mid-rod: all that acts on its two sides together
  Point<Space> carried = s.net.loads[0].force[2] + s.net.nodes[0].force;
  const auto dead = layout.known().dead_forces();
  for (const auto& [p, end] : layout.spans_at(0))
    carried +=
        end ? Point<Space>(layout.known().inside(layout.spans()[p], dead) - known[p]) : known[p];
  CHECK(distance(carried, total(s.net)) < 1e-14);
}

TEST_CASE_TEMPLATE("of a cantilever they are what acts behind", Space, EACH_SPACE) {
  Random random(2);
  for (const bool at_end : {false, true}) {
    Structure<Space> s;
    s.clamp(s.add(6), at_end ? 6 : 0);
    load(random, s);
    const Layout<Space> layout(s.net);
    const auto known = layout.known().known_forces(layout.known().dead_forces());
    REQUIRE(known.size() == 1);
    const auto& F = s.net.loads[0].force;
    const Point<Space> expected = at_end ? Point<Space>(-F[0]) : s.net.loads[0].section_forces()[0];
    CHECK(distance(known[0], expected) < 1e-15);
  }
}

TEST_CASE_TEMPLATE("a roller tells the component along its way, and no other", Space, EACH_SPACE) {
  Random random(3);
  for (int i = 0; i < Space::dim; ++i) {
    Structure<Space> s;
    s.clamp(s.add(6), 0);
    const int roller = s.roller(0, 6, i);
    load(random, s);
    const Layout<Space> layout(s.net);
    const auto known = layout.known().known_forces(layout.known().dead_forces());
    Point<Space> expected = Point<Space>::Zero();
    expected[i] = s.net.nodes[roller].force[i];
    for (int j = 1; j <= 6; ++j) expected[i] += s.net.loads[0].force[j][i];
    CHECK(distance(known[0], expected) < 1e-15);
    const auto& open = layout.spans()[0].open;
    CHECK(open.row(i).norm() == 0);
    CHECK(imbalance(layout, roller, known).norm() < 1e-15);
  }
}

TEST_CASE_TEMPLATE("a roller across the axes: what is open and what is told fill the space", Space,
                   EACH_SPACE) {
  constexpr int d = Space::dim;
  Random random(4);
  Structure<Space> s;
  s.clamp(s.add(6), 0);
  const Directions<d> way = random.vector<d>().normalized();
  const int roller = s.hold(0, 6, way, s.turning(), false);
  load(random, s);
  const Layout<Space> layout(s.net);
  const auto& open = layout.spans()[0].open;
  CHECK((way.transpose() * open).norm() < 1e-15 * layout.unit_force(0));
  const Dense gram = open.transpose() * open / std::pow(layout.unit_force(0), 2);
  CHECK(distance(gram, Dense::Identity(d - 1, d - 1)) < 1e-14);
  const auto known = layout.known().known_forces(layout.known().dead_forces());
  CHECK(imbalance(layout, roller, known).norm() < 1e-15);
  CHECK((open.transpose() * known[0]).norm() < 1e-14 * layout.unit_force(0));
}

TEST_CASE_TEMPLATE("known forces are linear in the loads", Space, EACH_SPACE) {
  Random random(5);
  auto s = tree<Space>();
  s.roller(3, 6, 0);
  load(random, s);
  const Layout<Space> layout(s.net);
  auto a = layout.known().dead_forces(), b = a, both = a;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < a[i].size(); ++j) {
      b[i][j] = random.vector<Space::dim>();
      both[i][j] = 2 * a[i][j] + b[i][j];
    }
  const auto fa = layout.known().known_forces(a), fb = layout.known().known_forces(b, 0),
             sum = layout.known().known_forces(both, 2);
  double size = 0;
  for (std::size_t p = 0; p < fa.size(); ++p) {
    CHECK(distance(sum[p], Point<Space>(2 * fa[p] + fb[p])) < 1e-14);
    size += fa[p].norm();
  }
  CHECK(size > 0.1);
}

TEST_CASE_TEMPLATE("what nothing holds is refused, unless the loads balance", Space, EACH_SPACE) {
  Random random(6);
  auto s = loose<Space>(random);
  CHECK_REFUSED("supports: nothing holds the rods against the force (", Layout<Space>(s.net));
  s.net.nodes[0].force = -total(s.net);
  const Layout<Space> balanced(s.net);
  const auto known = balanced.known().known_forces(balanced.known().dead_forces());
  for (int v = 0; v < int(balanced.network().nodes.size()); ++v)
    CHECK(imbalance(balanced, v, known).norm() < 1e-14);
  s.spring(1, 2, 1, 0);  // a spring holds in all directions
  s.net.nodes[0].force.setConstant(7);
  CHECK_NOTHROW(Layout<Space>(s.net));
}

TEST_CASE("the refusal names the force along the directions that are free, and only those") {
  Structure<Planar> s;
  s.add(4);
  s.roller(0, 0, 0);
  s.roller(0, 4, 0);
  s.net.loads[0].force[2] = Vec2(0, 5);  // the rollers hold that
  CHECK_NOTHROW(Layout<Planar>(s.net));
  s.net.loads[0].force[1] = Vec2(3, 0);
  CHECK(refusal([&] { Layout<Planar>{s.net}; }) ==
        "supports: nothing holds the rods against the force (3 0); hold a point of them, or let "
        "the loads balance");
  s.roller(0, 2, 1);  // the other way
  CHECK_NOTHROW(Layout<Planar>(s.net));
}

TEST_CASE("parts are looked at one by one") {
  Structure<Planar> s;
  s.clamp(s.add(3), 0);
  s.add(3);
  s.net.loads[0].force[3] = Vec2(1, 1);
  CHECK_NOTHROW(Layout<Planar>(s.net));
  s.net.loads[1].force[3] = Vec2(1, 0);
  CHECK_REFUSED("supports: nothing holds the rods against the force (1 0)", Layout<Planar>(s.net));
  s.net.loads[1].force[0] = Vec2(-1, 0);
  CHECK_NOTHROW(Layout<Planar>(s.net));
}

TEST_CASE("what is attached must exist, and only once") {
  Structure<Planar> s;
  s.clamp(s.add(3), 0);
  const auto with = [&](Attachment<Planar> a) {
    auto net = s.net;
    net.attachments.push_back(a);
    return refusal([&] { Layout<Planar>{net}; });
  };
  CHECK(with({1, 0, 0, true}) == "attachment: no rod 1");
  CHECK(with({0, 1, 1, true}) == "attachment: no node 1");
  CHECK(with({0, 4, 0, true}) == "attachment: rod 0 has no vertex 4");
  CHECK(with({0, 0, 0, false}).starts_with("supports: vertex 0 of rod 0 is held twice"));
}
