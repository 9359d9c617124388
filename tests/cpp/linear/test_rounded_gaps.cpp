// SPDX-License-Identifier: BSD-3-Clause
// How far rounding moves the solutions of a tent: two inextensible edges between fixed points,
// whose turns the points alone decide.
#include "support/dense.hpp"
#include "support/network.hpp"

#include <pyrod/linear/rounded_gaps.hpp>

#include <doctest/doctest.h>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr double h = 0.5;

/// Edges at the angles α and −α to the line between the points.
struct Tent {
  Posed<Planar> posed;
  NetworkState<Planar> x;
  Tangent<NetworkProblem<Planar>> tangent;
  Dense K;
  bool solvable = true;

  static Network<Planar> network(double α) {
    constexpr double rigid = std::numeric_limits<double>::infinity();
    Structure<Planar> structure;
    structure.add(Rod<Planar>::uniform(Grid::uniform(2 * h, 2), Vec1(1), Vec2(rigid, rigid)));
    structure.hinge(0, 0), structure.hinge(0, 2);
    structure.net.nodes[1].position = Vec2(0, 2 * h * std::cos(α));
    return structure.net;
  }

  explicit Tent(double α) : posed(network(α)), tangent(posed.problem()) {
    const auto& nodes = posed.network().nodes;
    x = {{Angle{α}, Angle{-α}},
         {Angle{}, Angle{}},
         {Vec2::Zero()},
         {nodes[0].position, nodes[1].position},
         {}};
    tangent.linearise(x, Hessian::exact);
    tangent.factor().factorise(0);
    K = dense(tangent.factor().matrix());
  }

  auto solver() const {
    return [this](const Vector& b, Vector& y) {
      y = K.fullPivLu().solve(b);
      return solvable;
    };
  }
  int row(int component) const {
    return posed.layout().row(posed.layout().spans()[0].block) + component;
  }
  /// How far apart rounding may put the points, along either axis.
  double rounded() { return tangent.rounding(x)[row(0)] / 4 / posed.layout().unit_force(0); }
};

}  // namespace

TEST_CASE("what moves the points of a tent moves its turns by cos/sin² of their rounding") {
  for (const double α : {1e-3, 1e-4, 1e-5}) {
    CAPTURE(α);
    Tent tent(α);
    RoundedGaps<Planar> gaps(tent.posed.problem(), tent.x, tent.tangent, tent.solver());
    Vector b = Vector::Zero(tent.K.rows()), y;
    b[tent.row(1)] = 1;
    tent.solver()(b, y);
    const int first = tent.posed.layout().frame_row(0), last = tent.posed.layout().frame_row(1);
    // 2 h sin α δα = δ, in the units of the row
    CHECK(std::abs(y[first]) ==
          doctest::Approx(1 / (2 * h * std::sin(α) * tent.posed.layout().unit_force(0))));
    CHECK(y[first] == doctest::Approx(-y[last]));
    const double s = std::sin(α), c = std::cos(α);
    const double expected = tent.rounded() / (2 * h) * std::hypot(c / (s * s), s / (c * c));
    CHECK(gaps.moved(y, 0, tent.solver()) == doctest::Approx(expected).epsilon(1e-3));
    CHECK(gaps.moved(y, 1e30, tent.solver()) == 0);  // nothing that counts
    Vector change;
    CHECK(gaps.find(y, change, tent.solver()));
    CHECK(std::hypot(change[first], change[last]) / std::hypot(y[first], y[last]) ==
          doctest::Approx(expected).epsilon(1e-3));
    tent.solvable = false;
    CHECK(gaps.moved(y, 0, tent.solver()) == 1);
    CHECK_FALSE(gaps.find(y, change, tent.solver()));
  }
}
