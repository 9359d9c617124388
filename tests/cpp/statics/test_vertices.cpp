// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/statics/solution/vertices.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

const Grid& grid() {
  static const Grid all(Vector{{0.1, 0.1, 0.15, 0.3, 0.25}});
  return all;
}
constexpr int at = 3;

template <class Space>
Spin<Space> moment() {
  Spin<Space> M = Spin<Space>::Zero();
  M[Space::spin == 1 ? 0 : 1] = 2;
  return M;
}

/// A rod that a moment at a vertex bends to an arc before it: exact, with what its cells transmit.
template <class Space>
RodSolution<Space> arc(const Rod<Space>& rod) {
  RodSolution<Space> s;
  s.curve.start_frame = Space::Rotation::Identity();
  const double end = grid().s(at);
  const auto turned = [&](double length) {
    return exp(Spin<Space>(std::min(length, end) * moment<Space>().cwiseQuotient(rod.bending[0])));
  };
  for (int j = 0; j < 5; ++j) s.curve.frames.push_back(turned(grid().centre(j)));
  s.curve.end_frame = turned(1);
  for (int j = 0; j <= 5; ++j) {
    s.strains.K.push_back(turn(s.curve, j) / grid().Δs(j));
    s.material_moment.push_back(rod.bending[j].cwiseProduct(s.strains.K[j]));
    s.moment.push_back(s.material_moment[j]);  // about an axis that does not turn
  }
  return s;
}

}  // namespace

TEST_CASE_TEMPLATE("a moment at a vertex: both sides, and the frame between", Space, EACH_SPACE) {
  const auto rod =
      Rod<Space>::uniform(grid(), Spin<Space>::Constant(0.8), Point<Space>::Constant(1e3));
  for (const bool follows : {false, true}) {
    Loads<Space> loads(5);
    if (follows)
      loads.add_follower_moment(grid(), moment<Space>(), grid().s(at));
    else
      loads.add_moment(grid(), moment<Space>(), grid().s(at));
    auto s = arc(rod);
    Vertices<Space>(rod, loads).see(s, std::vector<Point<Space>>(5, Point<Space>::Zero()));
    REQUIRE(s.before.size() == 1);
    const auto& before = s.before[0];
    CHECK(before.vertex == at);
    CHECK(before.halves);
    CHECK(distance(before.moment, moment<Space>()) < 1e-15);
    CHECK(distance(s.moment[at], Spin<Space>::Zero().eval()) < 1e-15);
    CHECK(distance(before.K, Spin<Space>(moment<Space>() / 0.8)) < 1e-14);
    CHECK(distance(s.strains.K[at], Spin<Space>::Zero().eval()) < 1e-14);
    CHECK(distance(s.vertex_frames[at], s.curve.frames[at]) < 1e-14);  // straight behind
  }
}

TEST_CASE_TEMPLATE("a held vertex has the node's frame, with the sign of its neighbours", Space,
                   EACH_SPACE) {
  const auto rod =
      Rod<Space>::uniform(grid(), Spin<Space>::Constant(0.8), Point<Space>::Constant(1e3));
  auto s = arc(rod);
  const auto frame = exp(Spin<Space>(0.4 * moment<Space>()));
  const Spin<Space> before = 3 * moment<Space>();
  std::vector<Point<Space>> force(5, Point<Space>::Ones());
  force[at] *= 2;
  Vertices<Space>(rod, Loads<Space>(5), {{at, frame, before}}).see(s, force);
  REQUIRE(s.before.size() == 1);
  CHECK(!s.before[0].halves);
  CHECK(distance(s.vertex_frames[at], frame) < 1e-15);
  CHECK(distance(s.before[0].K, Spin<Space>(before / 0.8)) < 1e-14);
  CHECK(distance(s.before[0].force, force[at - 1]) == 0);
  CHECK(distance(s.vertex_force[at], force[at]) == 0);
}
