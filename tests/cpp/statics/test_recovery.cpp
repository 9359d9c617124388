// SPDX-License-Identifier: BSD-3-Clause
// All there is to know of a network in equilibrium.
#include <pyrod/rod/energy.hpp>

#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A random network in equilibrium; the test fails if there is none.
template <class Space>
struct Solved {
  Network<Space> net;
  Solution<Space> result;

  Solved(Random& random, const Acting& acting) : net(random_network<Space>(random, acting)) {
    result = solved(net);
    REQUIRE(result.status == Status::converged);
  }

  const auto& rod(int i) const { return result.rods[i]; }
  const auto& node(int v) const { return result.nodes[v]; }
  Point<Space> place(int i, int j) const {
    const auto& r = rod(i).curve.positions;
    return r[std::size_t(j) == r.size() ? 0 : j];
  }
};

constexpr Acting all_kinds[] = {{},
                                {.moments = true},
                                {.followers = true},
                                {.closed = true},
                                {.moments = true, .followers = true}};

/// Of forces of order 1 that act on arms of order 1.
constexpr double rounding = 1e-12;

}  // namespace

TEST_CASE_TEMPLATE("rods meet in their nodes, and their edges are what the strains say", Space,
                   EACH_SPACE) {
  Random random(1);
  for (const auto& acting : all_kinds) {
    const Solved<Space> s(random, acting);
    for (const auto& a : s.net.attachments)
      CHECK(distance(s.place(a.rod, a.vertex), s.node(a.node).position) < rounding);
    for (int i = 0; i < int(s.net.rods.size()); ++i) {
      const auto& grid = s.net.rods[i].grid;
      const auto& rod = s.rod(i);
      REQUIRE(int(rod.curve.positions.size()) == grid.vertices());
      CHECK(distance(strains(grid, rod.curve).Γ, rod.strains.Γ) < 10 * rounding);
      for (int j = 0; j < grid.edges(); ++j) {
        const Point<Space> S = compliance(s.net.rods[i].stretching[j]);
        CHECK(distance(rod.strains.Γ[j],
                       Point<Space>(axis<Space>() + S.cwiseProduct(rod.material_force[j]))) <
              1e-14);
        CHECK(distance(rotate(rod.curve.frames[j], rod.material_force[j]), rod.force[j]) < 1e-13);
      }
    }
  }
}

TEST_CASE_TEMPLATE("reactions balance all that acts, in force and in moment", Space, EACH_SPACE) {
  Random random(2);
  for (const auto& acting : all_kinds) {
    const Solved<Space> s(random, acting);
    Point<Space> force = Point<Space>::Zero();
    Spin<Space> moment = Spin<Space>::Zero();
    const auto act = [&](const Point<Space>& r, const Point<Space>& F) {
      force += F;
      moment += cross(r, F);
    };
    for (int i = 0; i < int(s.net.rods.size()); ++i) {
      for (int j = 0; j < int(s.rod(i).load.size()); ++j) act(s.place(i, j), s.rod(i).load[j]);
      moment += s.rod(i).load_moment;
    }
    for (int v = 0; v < int(s.net.nodes.size()); ++v) {
      act(s.node(v).position, s.net.nodes[v].force + s.node(v).reaction_force);
      moment += s.net.nodes[v].moment + s.node(v).reaction_moment;
    }
    CHECK(force.norm() < 10 * rounding);
    CHECK(moment.norm() < 100 * rounding);
  }
}

TEST_CASE_TEMPLATE("supports exert nothing where they give way, and springs what they must", Space,
                   EACH_SPACE) {
  Random random(3);
  for (const auto& acting : all_kinds) {
    const Solved<Space> s(random, acting);
    double held = 0;
    for (int v = 0; v < int(s.net.nodes.size()); ++v) {
      const auto& node = s.net.nodes[v];
      const auto& found = s.node(v);
      const Point<Space> pull =
          found.reaction_force + node.spring * (found.position - node.position);
      CHECK((node.free.transpose() * pull).norm() < 10 * rounding);
      held += found.reaction_force.norm();
      bool rigid = false;
      for (const auto& a : s.net.attachments) rigid = rigid || (a.node == v && a.rigid);
      if (!rigid) continue;
      const Spin<Space> u = log(principal(node.frame.conjugate() * found.frame));
      const Spin<Space> twist =
          rotate_spin(found.frame.conjugate(), found.reaction_moment) + node.torsion_spring * u;
      CHECK((node.turns.transpose() * twist).norm() < 10 * rounding);
    }
    CHECK(held > 1);
    for (std::size_t v = s.net.nodes.size(); v < s.result.nodes.size(); ++v)
      CHECK(s.node(int(v)).reaction_force.norm() < rounding);  // free ends
  }
}

TEST_CASE_TEMPLATE("energies are those of the rods in positions and frames", Space, EACH_SPACE) {
  Random random(4);
  for (const auto& acting : all_kinds) {
    const Solved<Space> s(random, acting);
    for (const int i : {0, 1}) {  // fixed to nodes at their ends only
      const auto jet = energy(s.net.rods[i], s.rod(i).curve, {true, true});
      CHECK(s.rod(i).bend_twist_energy == doctest::Approx(jet.bend_twist).epsilon(1e-12));
      CHECK(s.rod(i).stretch_shear_energy == doctest::Approx(jet.stretch_shear).epsilon(1e-10));
    }
  }
}

TEST_CASE_TEMPLATE("section moments and forces balance the loads, edge by edge", Space,
                   EACH_SPACE) {
  Random random(5);
  for (const bool moments : {false, true}) {
    const Solved<Space> s(random, {.moments = moments});
    const auto& rod = s.rod(0);
    const auto& loads = s.net.loads[0];
    for (int j = 0; j < s.net.rods[0].edges(); ++j) {
      const Point<Space> edge = rod.curve.positions[j + 1] - rod.curve.positions[j];
      const Spin<Space> change = rod.moment[j] - rod.moment[j + 1];
      const Spin<Space> load = cross(edge, rod.force[j]) + loads.moment[j];
      CHECK(distance(change, load) < 10 * rounding);
      if (j > 0)
        CHECK(distance(rod.force[j - 1], Point<Space>(rod.force[j] + loads.force[j])) < 1e-13);
    }
  }
}

TEST_CASE_TEMPLATE("a free end turns by what acts on it, dead or following", Space, EACH_SPACE) {
  Random random(6);
  for (const bool following : {false, true}) {
    Structure<Space> s;
    s.add(random.rod<Space>(7));
    s.clamp(0, 0);
    const Spin<Space> M = random.vector<Space::spin>();
    (following ? s.net.loads[0].follower_end_moment : s.net.loads[0].end_moment) = M;
    const auto result = solved(s.net);
    REQUIRE(result.status == Status::converged);
    const auto& rod = result.rods[0];
    const Spin<Space> acting = following ? rotate_spin(rod.curve.end_frame, M) : M;
    for (const auto& m : rod.moment) CHECK(distance(m, acting) < rounding);  // no force acts
    CHECK(distance(rod.load_moment, acting) < rounding);
    CHECK(distance(result.nodes[0].reaction_moment, Spin<Space>(-acting)) < rounding);
  }
}
