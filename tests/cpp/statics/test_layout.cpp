// SPDX-License-Identifier: BSD-3-Clause
// What of a network is unknown.
#include "support/network.hpp"

#include "support/models.hpp"
#include "support/near.hpp"

#include <numeric>

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
int unknowns(const Layout<Space>& layout) {
  return std::accumulate(layout.sizes().begin(), layout.sizes().end(), 0);
}

template <class Space>
int multipliers(const Layout<Space>& layout) {
  int count = 0;
  for (const auto& span : layout.spans()) count += int(span.open.cols());
  return count;
}

/// Frames of `edges`, and besides `forces` multipliers, `turns` and `places` numbers of nodes.
template <class Space>
void check_unknowns(const Structure<Space>& s, int edges, int forces, int turns, int places) {
  const Layout<Space> layout(s.net);
  CHECK(layout.edges() == edges);
  CHECK(multipliers(layout) == forces);
  int node_turns = 0, node_places = 0;
  for (int v = 0; v < int(layout.network().nodes.size()); ++v) {
    if (const int b = layout.turn_block(v); b >= 0) node_turns += layout.sizes()[b];
    if (const int b = layout.place_block(v); b >= 0) node_places += layout.sizes()[b];
  }
  CHECK(node_turns == turns);
  CHECK(node_places == places);
  CHECK(unknowns(layout) == Space::spin * edges + forces + turns + places);
}

/// Entries of the factor beyond those of the matrix.
template <class Space>
int fill(const Network<Space>& net) {
  const Layout<Space> layout(net);
  const BlockSymmetric A(layout.pattern());
  return int(Ldlt(A).factor_entries()) - int(A.rows.size());
}

/// k × k rods that cross, `edges` from crossing to crossing, held at one corner.
template <class Space>
Network<Space> lattice(int k, int edges, bool rigid) {
  Structure<Space> s;
  for (int i = 0; i < k * k; ++i) {
    Node<Space> node;
    node.position[0] = i % k, node.position[1] = i / k;
    if (i == 0) node.free = s.nowhere();
    s.net.nodes.push_back(node);
  }
  for (int line = 0; line < 2 * k; ++line) {
    s.add(edges * (k - 1));
    for (int i = 0; i < k; ++i)
      s.net.attachments.push_back(
          {line, edges * i, line < k ? line * k + i : i * k + line - k, rigid});
  }
  return s.net;
}

/// Entries of the factor over those of the matrix.
template <class Space>
double relative_fill(const Network<Space>& net) {
  const Layout<Space> layout(net);
  const BlockSymmetric A(layout.pattern());
  return double(Ldlt(A).factor_entries()) / double(A.rows.size());
}

}  // namespace

TEST_CASE_TEMPLATE("a clamped rod with a free end: frames only", Space, EACH_SPACE) {
  for (const int n : {1, 7}) {
    Structure<Space> s;
    s.clamp(s.add(n), 0);
    check_unknowns(s, n, 0, 0, 0);
    Structure<Space> back;
    back.clamp(back.add(n), n);
    check_unknowns(back, n, 0, 0, 0);
    if (n == 1) continue;
    Structure<Space> middle;
    middle.clamp(middle.add(n), 3);
    check_unknowns(middle, n, 0, 0, 0);
    Structure<Space> loose;  // held nowhere, and nothing acts
    loose.add(n);
    check_unknowns(loose, n, 0, 0, 0);
  }
}

TEST_CASE_TEMPLATE("one rod between two supports: one force, less what a roller tells", Space,
                   EACH_SPACE) {
  constexpr int d = Space::dim, s = Space::spin, n = 8;
  const auto with = [](const auto& support) {
    Structure<Space> out;
    out.clamp(out.add(n), 0);
    support(out);
    return out;
  };
  check_unknowns(with([](auto& x) { x.clamp(0, n); }), n, d, 0, 0);
  check_unknowns(with([](auto& x) { x.hinge(0, n); }), n, d, 0, 0);
  check_unknowns(with([](auto& x) { x.pivot(0, n); }), n, d, s == 3, 0);  // plane: a hinge
  for (int i = 0; i < d; ++i) {
    check_unknowns(with([i](auto& x) { x.roller(0, n, i); }), n, d - 1, 0, 0);
    check_unknowns(with([i](auto& x) { x.slider(0, n, i); }), n, d - 1, 0, 0);
  }
  const auto in_plane = [](auto& x) {  // free in all directions but one
    Directions<d> plane = Mat<d>::Identity().rightCols(d - 1);
    x.hold(0, n, plane, x.turning(), false);
  };
  check_unknowns(with(in_plane), n, 1, 0, 0);
  // a spring's node has a place of its own, and a frame if the spring turns it
  check_unknowns(with([](auto& x) { x.spring(0, n, 2, 0); }), n, d, 0, d);
  check_unknowns(with([](auto& x) { x.spring(0, n, 2, 1); }), n, d, s, d);
  check_unknowns(with([](auto& x) { x.spring(0, n, 0, 1); }), n, 0, s, 0);
}

TEST_CASE_TEMPLATE("held in between: only spans between supports have a force", Space, EACH_SPACE) {
  constexpr int d = Space::dim, n = 9;
  Structure<Space> hinged;
  hinged.clamp(hinged.add(n), 0);
  hinged.hinge(0, 4);
  check_unknowns(hinged, n, d, 0, 0);
  hinged.hinge(0, 7);
  check_unknowns(hinged, n, 2 * d, 0, 0);
  hinged.roller(0, n, 0);
  check_unknowns(hinged, n, 3 * d - 1, 0, 0);
  Structure<Space> rolling;  // on a roller in the middle, two forces are not known
  rolling.clamp(rolling.add(n), 0);
  rolling.roller(0, 4, 0);
  check_unknowns(rolling, n, d - 1, 0, 0);
}

TEST_CASE_TEMPLATE("trees have no multipliers, rings one force", Space, EACH_SPACE) {
  constexpr int d = Space::dim, s = Space::spin;
  for (const bool rigid : {true, false}) {
    Structure<Space> tree;
    tree.add(4), tree.add(5), tree.add(3), tree.add(6);
    tree.clamp(0, 0);
    const int v = tree.joint(0, 4, 1, 0, rigid);
    tree.attach(2, 3, v, rigid);
    tree.joint(1, 2, 3, 0, rigid);  // a branch in mid-rod
    check_unknowns(tree, 18, 0, rigid ? 2 * s : 0, 0);
    tree.clamp(3, 6);
    check_unknowns(tree, 18, 3 * d, rigid ? 2 * s : 0, 2 * d);
  }
  Structure<Space> ring;
  auto rod = Rod<Space>::uniform(Grid(Vector::Constant(6, 0.5), Closure::closed),
                                 Spin<Space>::Ones(), Point<Space>::Ones());
  rod.bending.pop_back(), rod.K0.pop_back();
  ring.add(rod);
  check_unknowns(ring, 6, d, 0, 0);
  Structure<Space> joined;
  joined.joint(joined.add(6), 0, 0, 6, true);
  check_unknowns(joined, 6, d, s, 0);
  joined.net.nodes[0].free = joined.nowhere();
  joined.net.nodes[0].turns = joined.fixed();
  check_unknowns(joined, 6, d, 0, 0);
}

TEST_CASE_TEMPLATE("a frame of two rods: two forces, the corner's place and turn", Space,
                   EACH_SPACE) {
  constexpr int d = Space::dim, s = Space::spin;
  Structure<Space> frame;
  frame.add(5), frame.add(4);
  frame.clamp(0, 0);
  frame.joint(0, 5, 1, 0, true);
  check_unknowns(frame, 9, 0, s, 0);
  frame.clamp(1, 4);
  check_unknowns(frame, 9, 2 * d, s, d);
  Structure<Space> rolled = frame;
  rolled.net.nodes.back().free = rolled.along(0);
  check_unknowns(rolled, 9, 2 * d - 1, s, d);
}

TEST_CASE_TEMPLATE("a frame that nothing needs is dropped, its moment goes to the rod", Space,
                   EACH_SPACE) {
  Structure<Space> s;
  s.clamp(s.add(5), 0);
  const int v = s.hold(0, 5, s.anywhere(), s.turning(), true);
  check_unknowns(s, 5, 0, 0, 0);
  s.net.nodes[v].moment.setConstant(2);
  s.net.loads[0].end_moment.setConstant(1);
  const Layout<Space> layout(s.net);
  CHECK(unknowns(layout) == 5 * Space::spin);
  CHECK(layout.network().loads[0].end_moment == Spin<Space>::Constant(3));
  CHECK(layout.network().nodes[v].moment.isZero(0));
  Structure<Space> middle;  // there is no edge for it in mid-rod
  middle.clamp(middle.add(5), 0);
  const int w = middle.hold(0, 2, middle.anywhere(), middle.turning(), true);
  check_unknowns(middle, 5, 0, 0, 0);
  middle.net.nodes[w].moment.setConstant(2);
  check_unknowns(middle, 5, 0, Space::spin, 0);
}

TEST_CASE_TEMPLATE("chains have no fill; each held point in mid-rod costs one block", Space,
                   EACH_SPACE) {
  constexpr int d = Space::dim, spin = Space::spin;
  Structure<Space> s;
  s.clamp(s.add(30), 0);
  CHECK(fill(s.net) == 0);
  const auto with = [&](const auto& support) {
    auto copy = s;
    support(copy);
    return fill(copy.net);
  };
  CHECK(with([](auto& x) { x.clamp(0, 30); }) == 0);
  CHECK(with([](auto& x) { x.roller(0, 30, 0); }) == 0);
  CHECK(with([](auto& x) { x.spring(0, 30, 1, 0); }) == 0);
  // the last frame before the hinge ties the force to the first frame behind
  CHECK(with([](auto& x) { x.hinge(0, 10), x.clamp(0, 30); }) == d * spin);
  CHECK(with([](auto& x) { x.clamp(0, 10), x.clamp(0, 30); }) == 0);
}

TEST_CASE_TEMPLATE("behind a moving node a frame stands by itself, if its span is long enough",
                   Space, EACH_SPACE) {
  Structure<Space> s;
  s.add(20), s.add(8);
  s.clamp(0, 0), s.clamp(0, 20), s.clamp(1, 0), s.clamp(1, 8);
  s.spring(0, 5, 1, 0);   // 5 edges behind it
  s.spring(0, 10, 1, 0);  // 3
  s.hinge(0, 13);         // 7, but it does not move
  s.spring(1, 4, 1, 1);   // rigid
  const Layout<Space> layout(s.net);
  for (int p = 0; p < int(layout.spans().size()); ++p) {
    const auto& span = layout.spans()[p];
    CAPTURE(span.first);
    const bool apart = span.rod == 0 && span.first == 5;
    CHECK(layout.apart(p) == apart);
    for (int j = span.first + 1; j < span.last; ++j)
      CHECK(layout.frame_row(layout.edge(span.rod, j)) ==
            layout.frame_row(layout.edge(span.rod, span.first + apart)) +
                Space::spin * (j - span.first - apart));
    CHECK((layout.frame_block(layout.first_edge(p)) >= layout.first_node_block()) == apart);
  }
  check_unknowns(s, 28, 6 * Space::dim, Space::spin, 3 * Space::dim);
}

TEST_CASE_TEMPLATE("all rows belong to one block each, whatever the order", Space, EACH_SPACE) {
  for (const bool rigid : {true, false}) {
    const Layout<Space> layout(lattice<Space>(9, 4, rigid));
    std::vector<int> seen(std::size_t(layout.unknowns()), 0);
    const auto see = [&](int block) {
      for (int i = 0; block >= 0 && i < layout.sizes()[block]; ++i) ++seen[layout.row(block) + i];
    };
    for (int e = 0; e < layout.edges(); ++e) see(layout.frame_block(e));
    for (const auto& span : layout.spans()) see(span.block);
    for (int v = 0; v < int(layout.network().nodes.size()); ++v)
      see(layout.turn_block(v)), see(layout.place_block(v));
    CHECK(seen == std::vector<int>(seen.size(), 1));
  }
}

TEST_CASE_TEMPLATE("the fill of lattices grows slowly, joined rigidly or by balls", Space,
                   EACH_SPACE) {
  for (const bool rigid : {true, false}) {
    CAPTURE(rigid);
    double before = relative_fill(lattice<Space>(5, 8, rigid));
    CHECK(before < 2);
    for (const int k : {10, 20}) {
      const double now = relative_fill(lattice<Space>(k, 8, rigid));
      CAPTURE(k);
      CHECK(now < 1.3 * before);
      before = now;
    }
  }
}

TEST_CASE_TEMPLATE("a rod on many springs has a fill that does not grow with their number", Space,
                   EACH_SPACE) {
  const auto on_springs = [](int count) {
    Structure<Space> s;
    s.clamp(s.add(8 * count), 0);
    for (int i = 1; i < count; ++i) s.spring(0, 8 * i, 1, 0);
    return relative_fill(s.net);
  };
  CHECK(on_springs(100) < 1.05 * on_springs(10));
}
