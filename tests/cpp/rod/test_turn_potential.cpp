// SPDX-License-Identifier: BSD-3-Clause
// The general cell, and tendons in cells.
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/moment_law.hpp>
#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/rod/tension.hpp>
#include <pyrod/rod/turn_potential.hpp>

#include "support/dense.hpp"
#include "support/difference.hpp"
#include "support/jets.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <numbers>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A full stiffness, a cubic part, and two tendons.
template <class Space>
struct Law {
  Mat<Space::spin> k;
  Spin<Space> rest, cubic;
  TendonCell<Space> first, second;

  explicit Law(Random& random) : rest(random.vector<Space::spin>()) {
    const Mat<Space::spin> root = Mat<Space::spin>::NullaryExpr([&] { return random.number(); });
    k = root * root.transpose() + Mat<Space::spin>::Identity();
    cubic = random.vector<Space::spin>();
    for (auto* cell : {&first, &second}) {
      cell->along = random.vector<Space::dim>();
      cell->along[Space::dim - 1] += 2;
      cell->lever = random.vector<Space::dim>();
      cell->lever[Space::dim - 1] = 0;
    }
  }

  TurnPotential<Space> operator()(const Spin<Space>& u) const {
    TurnPotential<Space> out;
    const Spin<Space> strain = u - rest;
    const double c = cubic.dot(u);
    out.m = k * strain + c * c * cubic;
    out.k = k + 2 * c * cubic * cubic.transpose();
    out.energy = strain.dot(k * strain) / 2 + c * c * c / 3;
    add_tension<Space>(0.7, tendon_length(first, u), out);
    add_tension<Space>(1.9, tendon_length(second, u), out);
    return out;
  }
};

const std::vector<double> angles{0, 1e-9, 0.01, 0.7, 1.5, 3.14, 4.5};

}  // namespace

TEST_CASE_TEMPLATE("a general cell against differences", Space, EACH_SPACE) {
  Random random(21);
  for (const double θ : angles) {
    CAPTURE(θ);
    const Law<Space> law(random);
    const auto q = random.rotation<Space>(), p = q * random.rotation<Space>(θ);
    const Spin<Space> a = random.vector<Space::spin>(), b = random.vector<Space::spin>();
    const auto at = [&](double t) {
      const Spin<Space> u =
          log(moved(q, Spin<Space>(t * a)).conjugate() * moved(p, Spin<Space>(t * b)));
      return turn_potential<Hessian::exact>(u, law(u));
    };
    const auto jet = at(0);
    Vec<twice(Space::spin)> both, twist;
    both << a, b;
    twist << spin_skew(jet.a) * a, spin_skew(jet.b) * b;
    check_slope([&](double t) { return at(t).energy; }, gradient(jet).dot(both), 0.02);
    check_derivative([&](double t) { return gradient(at(t)); }, hessian(jet) * both + twist / 2,
                     0.02);
  }
}

TEST_CASE_TEMPLATE("the diagonal law is one of them", Space, EACH_SPACE) {
  Random random(22);
  for (const double θ : angles) {
    const Spin<Space> u = random.turn<Space>(θ), k = random.between<Space::spin>(0.5, 3),
                      rest = random.vector<Space::spin>();
    TurnPotential<Space> ψ;
    ψ.m = k.cwiseProduct(u - rest);
    ψ.k.diagonal() = k;
    ψ.energy = ψ.m.dot(u - rest) / 2;
    const auto one = turn_potential<Hessian::exact>(u, ψ);
    const auto other = bend_twist<Hessian::exact>(u, typename Space::Differential(u), k, rest);
    CHECK(distance(gradient(one), gradient(other)) < 1e-13 * (1 + ψ.m.norm()));
    CHECK(distance(hessian(one), hessian(other)) < 1e-12 * (1 + hessian(other).norm()));
    CHECK(turn_potential<Hessian::convex>(u, ψ).bb.isZero(0));
    CHECK(distance(turn_potential<Hessian::convex>(u, ψ).b, one.b) == 0);
  }
}

TEST_CASE_TEMPLATE("a turn under a moment, of any law", Space, EACH_SPACE) {
  Random random(23);
  for (int i = 0; i < 20; ++i) {
    Law<Space> law(random);
    law.cubic.setZero(), law.rest /= 2, law.k *= 5;  // half cells are short, thus stiff
    const Spin<Space> M = 3 * random.vector<Space::spin>(), guess = law.rest;
    const Spin<Space> u = turn_under_moment<Space>(M, law, guess),
                      w = turn_under_moment_behind<Space>(M, law, guess);
    const typename Space::Differential du(u), dw(w);
    CHECK(distance(Spin<Space>(du.T() * law(u).m), M) < 1e-13);
    CHECK(distance(Spin<Space>(dw.T().transpose() * law(w).m), M) < 1e-13);
  }
}

TEST_CASE("tendons: halves, ends and slopes of a helix on uneven edges") {
  Random random(24);
  const double turn = 2 * std::numbers::pi;
  const auto helix = std::make_shared<const Routing>(
      [=](double s) { return Vec2(0.1 * std::cos(turn * s), 0.1 * std::sin(turn * s)); });
  for (const Grid& grid : {Grid::uniform(1, 40), random.grid(40)}) {
    const RoutedTendon tendon(0, 8, 40, 3., {20}, helix, grid);
    CHECK(!tendon.covers(8, CellKind::before));
    CHECK(tendon.covers(8, CellKind::behind));
    CHECK(tendon.covers(9, CellKind::whole));
    CHECK(tendon.covers(40, CellKind::before));
    CHECK(!tendon.covers(40, CellKind::behind));
    CHECK(!tendon.covers(8, CellKind::whole));
    const auto whole = tendon.cell<Spatial>(grid, 20, CellKind::whole),
               before = tendon.cell<Spatial>(grid, 20, CellKind::before),
               behind = tendon.cell<Spatial>(grid, 20, CellKind::behind);
    CHECK(distance(whole.along, Vec3(before.along + behind.along)) < 1e-15);
    CHECK(whole.along.z() == doctest::Approx(grid.Δs(20)).epsilon(1e-14));
    const double middle = (grid.centre(19) + grid.centre(20)) / 2;
    CHECK(distance(whole.lever,
                   Vec3(0.1 * std::cos(turn * middle), 0.1 * std::sin(turn * middle), 0)) < 1e-12);
    const double quarter = grid.s(20) - grid.h(19) / 4;
    CHECK(distance(before.lever, Vec3(0.1 * std::cos(turn * quarter),
                                      0.1 * std::sin(turn * quarter), 0)) < 1e-14);
    for (const int j : {8, 9, 20, 31, 40})
      for (const auto side : {CellKind::before, CellKind::behind}) {
        if (!tendon.covers(j, side)) continue;
        const auto at = tendon.at_vertex<Spatial>(grid, j, side);
        const double s = grid.s(j);
        const Vec3 slope(-0.1 * turn * std::sin(turn * s), 0.1 * turn * std::cos(turn * s), 1);
        CHECK(distance(at.along, slope) < 1e-9);
      }
  }
}

TEST_CASE("tendons: slopes do not look beyond kinks") {
  const auto bent = std::make_shared<const Routing>(
      [](double s) { return s < 0.5 ? Vec2(0.1, 0) : Vec2(0.1 + s - 0.5, 2 * s - 1); });
  const Grid grid = Grid::uniform(1, 6);
  const RoutedTendon tendon(0, 0, 6, 1., {3}, bent, grid);
  const auto slope = [&](int j, CellKind side) {
    return tendon.at_vertex<Spatial>(grid, j, side).along;
  };
  CHECK(distance(slope(3, CellKind::before), Vec3(0, 0, 1)) < 1e-14);
  CHECK(distance(slope(2, CellKind::behind), Vec3(0, 0, 1)) < 1e-14);
  CHECK(distance(slope(3, CellKind::behind), Vec3(1, 2, 1)) < 1e-12);
  CHECK(distance(slope(6, CellKind::before), Vec3(1, 2, 1)) < 1e-12);
}
