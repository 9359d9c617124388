// SPDX-License-Identifier: BSD-3-Clause
// What equilibria on coarser grids make expect on a finer one.
#include <pyrod/statics/start/outlook.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A rod that is held at its ends and in the middle, where it may have a corner.
template <class Space>
Layout<Space> layout_on(int edges, bool held = true) {
  Structure<Space> s;
  s.clamp(s.add(edges), 0);
  if (held) s.hinge(0, edges / 2);
  s.hinge(0, edges);
  return Layout<Space>(s.net);
}

/// Frames bent at `corner`, with an error of second order; all else changes by errors as well.
template <class Space>
NetworkState<Space> state_on(const Layout<Space>& layout, double corner, double error = 1) {
  const Grid& grid = layout.network().rods[0].grid;
  const double h = grid.h(0), e = error * h * h;
  NetworkState<Space> x;
  const auto spin = [](double a, double b, double c) { return restrict_spin<Space>({a, b, c}); };
  for (int j = 0; j < grid.edges(); ++j) {
    const double s = grid.centre(j), t = std::max(0., s - corner);
    x.frames.push_back(exp(spin(std::sin(s), 2 * s * s + 4 * t + e * std::cos(3 * s), s)));
  }
  for (std::size_t v = 0; v < layout.network().nodes.size(); ++v) {
    x.positions.push_back((0.3 + e) * Point<Space>::Ones());
    x.node_frames.push_back(exp(spin(0.1, 0.2 + e, 0.3)));
  }
  x.forces.assign(layout.spans().size(), (2 - 3 * e) * Point<Space>::Ones());
  return x;
}

template <class Space>
double difference(const NetworkState<Space>& a, const NetworkState<Space>& b) {
  return std::max({distance(a.frames, b.frames), distance(a.positions, b.positions),
                   distance(a.node_frames, b.node_frames), distance(a.forces, b.forces)});
}

}  // namespace

TEST_CASE_TEMPLATE("from two grids errors of second order are known, in spans that meet in corners",
                   Space, EACH_SPACE) {
  std::vector<double> one, two;
  for (const int n : {32, 64, 128}) {
    const auto a = layout_on<Space>(n), b = layout_on<Space>(4 * n), c = layout_on<Space>(24 * n);
    Outlook<Space> outlook;
    outlook.add(a, state_on(a, 0.5));
    CHECK_FALSE(outlook.sees_change());
    outlook.clear();
    outlook.add(b, state_on(b, 0.5));
    const auto exact = state_on(c, 0.5);
    one.push_back(difference(outlook.on(c), exact));
    outlook.clear();
    outlook.add(a, state_on(a, 0.5)), outlook.add(b, state_on(b, 0.5));
    CHECK(outlook.sees_change());
    two.push_back(difference(outlook.on(c), exact));
  }
  for (std::size_t i = 1; i < one.size(); ++i) {
    CHECK(one[i - 1] / one[i] == doctest::Approx(4).epsilon(0.1));
    CHECK(two[i - 1] / two[i] > 12);
  }
  CHECK(two.back() < 1e-3 * one.back());
}

TEST_CASE_TEMPLATE("a change that is none of second order is not carried on", Space, EACH_SPACE) {
  const auto a = layout_on<Space>(16), b = layout_on<Space>(64), c = layout_on<Space>(256);
  Outlook<Space> one, two;
  one.add(b, state_on(b, 0.5));
  two.add(a, state_on(a, 0.5, 200.)), two.add(b, state_on(b, 0.5));
  CHECK(difference(one.on(c), two.on(c)) == 0);
  // nor is that of another network
  const auto other = layout_on<Space>(16, false);
  Outlook<Space> three;
  three.add(other, state_on(other, 0.5)), three.add(b, state_on(b, 0.5));
  CHECK(difference(one.on(c), three.on(c)) == 0);
}

TEST_CASE_TEMPLATE("frames go on from kink to kink", Space, EACH_SPACE) {
  const auto layout = [](int edges) {
    Structure<Space> s;
    s.clamp(s.add(edges), 0);
    s.net.loads[0].add_moment(s.net.rods[0].grid, Spin<Space>::Ones(), 0.25);
    return Layout<Space>(s.net);
  };
  const auto coarse = layout(128), fine = layout(1024);
  Outlook<Space> outlook;
  outlook.add(coarse, state_on(coarse, 0.25, 0));
  CHECK(distance(outlook.on(fine).frames, state_on(fine, 0.25, 0).frames) < 1e-6);
  outlook.clear();
  outlook.add(coarse, state_on(coarse, 0.3, 0));  // where nothing acts
  CHECK(distance(outlook.on(fine).frames, state_on(fine, 0.3, 0).frames) > 1e-4);
}
