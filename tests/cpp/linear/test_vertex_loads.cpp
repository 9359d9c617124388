// SPDX-License-Identifier: BSD-3-Clause
// Where loads on a vertex go, by hand.
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <pyrod/linear/vertex_loads.hpp>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// Edges of 1, 3 and 2.
Rod<Planar> uneven(Closure closure = Closure::open) {
  Vector h(3);
  h << 1, 3, 2;
  return Rod<Planar>::uniform(Grid(h, closure), Vec1(1), Vec2(100, 100));
}

struct Put {
  Layout<Planar> layout;
  NumberItems<Planar> numbers;
  Items<Planar> out;

  explicit Put(const Network<Planar>& net)
      : layout(net), numbers(layout), out(Items<Planar>::Zero(2, numbers.count())) {}

  const Items<Planar>& moment(int vertex) {
    out.setZero();
    VertexLoads<Planar>(layout, 0, vertex).add_moment(Vec1(6), out);
    return out;
  }
  /// Of this one, and of no other.
  double alone(int item) const {
    return std::abs(out.sum() - out(0, item)) < 1e-15 ? out(0, item) : std::nan("");
  }
};

}  // namespace

TEST_CASE("a force is that of its vertex") {
  Structure<Planar> structure;
  structure.clamp(structure.add(uneven()), 0);
  Put put(structure.net);
  VertexLoads<Planar>(put.layout, 0, 2).add_force(Vec2(3, 4), put.out);
  CHECK(put.out.col(put.numbers.force(0, 2)) == Vec2(3, 4));
  CHECK(put.out.cwiseAbs().sum() == 7);
}

TEST_CASE("a moment goes to what holds the frame, or to the edges beside as by a lever") {
  Structure<Planar> structure;
  const int rod = structure.add(uneven()), clamp = structure.clamp(rod, 0);
  Put put(structure.net);
  put.moment(0);
  CHECK(put.alone(put.numbers.node_moment(clamp)) == 6);
  put.moment(1);  // 1 before, 3 behind: the shorter edge takes more
  CHECK(put.out(0, put.numbers.moment(0)) == doctest::Approx(6 * 3. / 4));
  CHECK(put.out(0, put.numbers.moment(1)) == doctest::Approx(6 * 1. / 4));
  CHECK(put.out.sum() == doctest::Approx(6));
  put.moment(2);  // 3 before, 2 behind
  CHECK(put.out(0, put.numbers.moment(1)) == doctest::Approx(6 * 2. / 5));
  CHECK(put.out(0, put.numbers.moment(2)) == doctest::Approx(6 * 3. / 5));
  put.moment(3);  // the free end: the last edge, and the half cell behind it
  CHECK(put.out(0, put.numbers.moment(2)) == 6);
  CHECK(put.out(0, put.numbers.end_moment(0, Side::behind)) == 6);
  CHECK(put.out.sum() == 12);
}

TEST_CASE("the ends of a closed rod are one vertex") {
  Structure<Planar> structure;
  const int rod = structure.add(uneven(Closure::closed));
  structure.net.rods[0].K0.assign(4, Vec1(2 * std::numbers::pi / 6));
  structure.hinge(rod, 1);
  Put put(structure.net);
  for (const int vertex : {0, 3}) {  // 2 before, 1 behind
    put.moment(vertex);
    CHECK(put.out(0, put.numbers.moment(2)) == doctest::Approx(6 * 1. / 3));
    CHECK(put.out(0, put.numbers.moment(0)) == doctest::Approx(6 * 2. / 3));
    CHECK(put.out.sum() == doctest::Approx(6));
  }
}
