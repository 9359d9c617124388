// SPDX-License-Identifier: BSD-3-Clause
// Starts of rods over several supports.
#include <pyrod/statics/start/start.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int n = 48;  // edges of a span

/// A clamp, hinges, and a clamp, each span so much shorter.
template <class Space>
Structure<Space> over_hinges(int spans, double slack, int turns = 0) {
  Structure<Space> s;
  s.add(n * spans);
  for (int k = 0; k <= spans; ++k) {
    const int v = k == 0 || k == spans ? s.clamp(0, n * k) : s.hinge(0, n * k);
    s.net.nodes[v].position *= 1 - slack;
  }
  s.net.attachments.back().turns = turns;
  return s;
}

template <class Space>
NetworkState<Space> start(const Network<Space>& net, bool level = false) {
  const Layout<Space> layout(net);
  return Start<Space>(layout, level).state();
}

/// From the start of span k to its end, unstretched.
template <class Space>
Point<Space> reach(const Structure<Space>& s, const NetworkState<Space>& x, int k) {
  Point<Space> sum = Point<Space>::Zero();
  for (int j = n * k; j < n * (k + 1); ++j)
    sum += s.net.rods[0].grid.h(j) * rotate(x.frames[j], axis<Space>());
  return sum;
}

/// How far the middle of span k is aside.
template <class Space>
double aside(const Structure<Space>& s, const NetworkState<Space>& x, int k) {
  double sum = 0;
  for (int j = n * k; j < n * k + n / 2; ++j)
    sum += s.net.rods[0].grid.h(j) * rotate(x.frames[j], axis<Space>())[0];
  return sum;
}

template <class Space>
double largest_turn(const NetworkState<Space>& x) {
  double out = 0;
  for (std::size_t j = 1; j < x.frames.size(); ++j)
    out = std::max(out, log(x.frames[j - 1].conjugate() * x.frames[j]).norm());
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("bows go on over hinges without a kink, and reach", Space, EACH_SPACE) {
  for (const int spans : {2, 3, 6})
    for (const double slack : {0.01, 0.1, 0.3, 0.6}) {
      CAPTURE(spans);
      CAPTURE(slack);
      const auto s = over_hinges<Space>(spans, slack);
      const auto x = start(s.net);
      CHECK(largest_turn(x) < 0.6);
      for (int k = 0; k < spans; ++k) {
        const Point<Space> chord = (1 - slack) / spans * axis<Space>();
        CHECK(distance(reach(s, x, k), chord) < 0.15 / spans);
      }
    }
}

TEST_CASE_TEMPLATE("without loads bows alternate", Space, EACH_SPACE) {
  const auto s = over_hinges<Space>(6, 0.2);
  const auto x = start(s.net);
  for (int k = 1; k < 6; ++k) CHECK(aside(s, x, k) * aside(s, x, k - 1) < 0);
}

TEST_CASE_TEMPLATE("under large loads all bows go with them", Space, EACH_SPACE) {
  auto s = over_hinges<Space>(6, 0.2);
  for (auto& force : s.net.loads[0].force) force[0] = -1e5 / (6 * n);
  const auto x = start(s.net);
  for (int k = 0; k < 6; ++k) CHECK(aside(s, x, k) < -0.01);
}

TEST_CASE_TEMPLATE("on the level, directions at the supports are those between their chords", Space,
                   EACH_SPACE) {
  const auto s = over_hinges<Space>(4, 0.2);
  const auto x = start(s.net, true);
  for (int k = 1; k < 4; ++k) {
    const Point<Space> t =
        rotate(x.frames[n * k - 1], axis<Space>()) + rotate(x.frames[n * k], axis<Space>());
    CHECK(distance(t.normalized(), axis<Space>()) < 0.15);
  }
}

TEST_CASE("turns are spread evenly over all spans") {
  const auto s = over_hinges<Spatial>(4, 0.05, 2);
  const auto x = start(s.net);
  const double even = 4 * std::numbers::pi / (4 * n);
  for (int j = 1; j < 4 * n; ++j)
    CHECK(twist_angle(x.frames[j - 1].conjugate() * x.frames[j]) ==
          doctest::Approx(even).epsilon(0.1));
}

TEST_CASE_TEMPLATE("supports drawn taut leave rods nearly straight", Space, EACH_SPACE) {
  const auto s = over_hinges<Space>(3, 0.5);
  const Layout<Space> layout(s.net);
  const auto taut = Start<Space>(layout).drawn_taut();
  REQUIRE(taut);
  const auto x = taut->state();
  for (int k = 0; k <= 3; ++k)
    CHECK(distance(x.positions[k], Point<Space>(0.97 * k / 3 * axis<Space>())) < 1e-12);
  for (const auto& q : x.frames) CHECK(log(q).norm() < 1);
}
