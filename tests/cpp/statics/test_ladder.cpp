// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are no more than a rule what each level says.
#include <pyrod/statics/ladder/ladder.hpp>

#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int edges = 4;
constexpr int many = 1 << 18;

const std::vector<Rod<Spatial>>& rods() {
  static const std::vector<Rod<Spatial>> all{
      Rod<Spatial>::uniform(Grid::uniform(2, edges), Vec3::Ones(), Vec3::Constant(1e3))};
  return all;
}

/// A straight rod under a pull, whose vertices are `off` from where they belong.
Solution<Spatial> pulled(double off) {
  RodSolution<Spatial> rod;
  const Vec3 pull(0, 0, 1);
  rod.curve.frames.assign(edges, Quaternion::Identity());
  rod.strains.Γ.assign(edges, pull);
  rod.force.assign(edges, pull);
  for (int j = 0; j <= edges; ++j) rod.curve.positions.push_back(Vec3(off * j, 0, j / 2.));
  rod.vertex_frames.assign(edges + 1, Quaternion::Identity());
  for (auto* list : {&rod.strains.K, &rod.moment, &rod.material_moment})
    list->assign(edges + 1, Vec3::Zero());
  rod.vertex_force.assign(edges + 1, pull);
  rod.load.assign(edges + 1, Vec3::Zero());
  Solution<Spatial> out;
  out.status = Status::converged;
  out.index = 0;
  out.rods.push_back(rod);
  out.record.resize(2);
  return out;
}

double h(int level) { return std::exp2(-level); }
double even_series(int level) {
  const double x = h(level) * h(level);
  return 0.1 * x + 0.01 * x * x + 0.002 * x * x * x + 0.0003 * x * x * x * x;
}

struct Asked {
  int level;
  bool from_below;
  double tolerance;
};

struct Climb {
  Climbed found;
  std::vector<Asked> asked;

  double off() const { return found.solution.rods[0].curve.positions.back().x(); }
  double error() const { return found.reached.errors[std::size_t(Quantity::positions)]; }
  double true_error() const { return std::abs(off()) / 2; }  // relative to the length
};

template <class Says>
Climb climbed(double tolerance, const Says& says, int most_edges = many) {
  Climb out;
  const auto solve = [&](int level, bool from_below, double step) {
    out.asked.push_back({level, from_below, step});
    REQUIRE(level < 30);
    return says(level);
  };
  out.found = Ladder({rods(), solve}, tolerance, most_edges).climb();
  return out;
}

Solution<Spatial> failed(Status status) {
  auto out = pulled(7);
  out.status = status;
  return out;
}

}  // namespace

TEST_CASE("the ladder is climbed until the error wanted is reached, and that holds") {
  int before = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10}) {
    CAPTURE(tolerance);
    const auto climb = climbed(tolerance, [](int level) { return pulled(even_series(level)); });
    const auto& reached = climb.found.reached;
    CHECK(climb.found.solution.converged());
    CHECK(climb.error() <= tolerance);
    CHECK(climb.true_error() <= climb.error());
    CHECK(climb.error() <= 100 * std::max(climb.true_error(), 1e-14));
    CHECK(reached.regular);
    CHECK(reached.order == doctest::Approx(2).epsilon(0.1));
    CHECK(reached.levels == int(climb.asked.size()));
    CHECK(reached.edges == edges << (reached.levels - 1));
    CHECK(reached.levels >= std::max(3, before));
    before = reached.levels;
    CHECK(climb.found.solution.record.size() == 2 * climb.asked.size());
  }
  CHECK(before == 6);
}

TEST_CASE("each level starts from the one below, the first from nothing") {
  const auto climb = climbed(1e-8, [](int level) { return pulled(even_series(level)); });
  for (std::size_t k = 0; k < climb.asked.size(); ++k) {
    CHECK(climb.asked[k].level == int(k));
    CHECK(climb.asked[k].from_below == (k > 0));
  }
}

TEST_CASE("the more accurate a result is to be, the smaller Newton's last step must be") {
  const auto says = [](int level) {
    auto out = pulled(even_series(level));
    out.record[0].step = 1e-3;
    out.record[1].step = 4e-6;  // steps s are followed by 4 s²
    out.record[0].fraction = out.record[1].fraction = 1;
    return out;
  };
  double before = 1;
  for (const double tolerance : {1e-4, 1e-8, 1e-10}) {
    const auto climb = climbed(tolerance, says);
    CHECK(climb.asked[0].tolerance == 1e-8);
    const double step = climb.asked[1].tolerance;
    CHECK(4 * step * step <= 0.011 * tolerance);
    CHECK(step <= before);
    before = step;
  }
}

TEST_CASE("what is not reached is told") {
  const auto climb =
      climbed(1e-9, [](int level) { return pulled(even_series(level)); }, edges << 3);
  const auto& reached = climb.found.reached;
  CHECK(climb.found.solution.status == Status::not_accurate);
  CHECK(reached.levels == 4);
  CHECK(reached.edges == edges << 3);
  CHECK(reached.ended == Ended::edges);
  CHECK(climb.error() > 1e-9);
  CHECK(climb.true_error() <= climb.error());
}

TEST_CASE("time ends a climb between grids, and sees what is reached so far") {
  std::vector<SoFar> seen;
  const auto solve = [](int level, bool, double) { return pulled(even_series(level)); };
  const auto has_time = [&](const SoFar& reached) {
    seen.push_back(reached);
    return seen.size() < 4;
  };
  const auto climbed = Ladder({rods(), solve, has_time}, 1e-13, 1 << 20).climb();
  CHECK(climbed.solution.status == Status::not_accurate);
  CHECK(climbed.reached.ended == Ended::time);
  CHECK(climbed.reached.levels == 4);
  REQUIRE(seen.size() == 4);
  CHECK(std::isinf(seen[1].error));
  CHECK(seen[3].error < seen[2].error);
  CHECK(seen[3].grids == 4);
  CHECK(seen[3].edges == edges << 3);
}

TEST_CASE("three levels are climbed in any case") {
  const auto climb = climbed(0.1, [](int level) { return pulled(even_series(level)); }, 1);
  CHECK(climb.found.solution.converged());
  CHECK(climb.found.reached.levels == 3);
}

TEST_CASE("levels of another order are told plainly") {
  const auto says = [](int level) { return pulled(0.1 * h(level)); };
  const auto climb = climbed(1e-3, says);
  const auto& reached = climb.found.reached;
  CHECK(climb.found.solution.converged());
  CHECK_FALSE(reached.regular);
  CHECK(reached.order == doctest::Approx(1).epsilon(1e-10));
  CHECK(distance(climb.off(), 4 * 0.1 * h(reached.levels - 1)) < 1e-15);
  CHECK(climb.true_error() <= climb.error());
  CHECK(climb.error() <= 4 * climb.true_error());
  CHECK(climbed(1e-6, says, 1 << 12).found.solution.status == Status::not_accurate);
}

TEST_CASE("levels that fail are left out, and the next starts anew") {
  const auto climb = climbed(1e-6, [](int level) {
    return level < 2 ? failed(Status::too_coarse) : pulled(even_series(level));
  });
  CHECK(climb.found.solution.converged());
  CHECK(climb.true_error() <= climb.error());
  CHECK_FALSE(climb.asked[1].from_below);
  CHECK_FALSE(climb.asked[2].from_below);
  CHECK(climb.asked[3].from_below);
  CHECK(climb.asked.size() >= 5);
}

TEST_CASE("where all levels fail the last tells why") {
  const auto climb = climbed(1e-6, [](int) { return failed(Status::stalled); }, edges << 4);
  CHECK(climb.found.solution.status == Status::stalled);
  CHECK(climb.off() == 7 * 4);
  CHECK(std::isinf(climb.error()));
  CHECK_FALSE(climb.found.reached.regular);
}

TEST_CASE("where only the first is solved the last tells why") {
  const auto climb = climbed(
      1e-6, [](int level) { return level == 0 ? pulled(0.5) : failed(Status::stalled); },
      edges << 4);
  CHECK(climb.found.solution.status == Status::stalled);
  CHECK(climb.found.solution.rods[0].force[0] == Vec3(0, 0, 1));
  CHECK(std::isinf(climb.error()));
}

TEST_CASE("an equilibrium of another kind begins the ladder anew") {
  const auto other = [](bool descends) {
    return climbed(1e-6, [=](int level) {
      auto out = pulled(level < 2 ? 3 + h(level) : even_series(level));
      out.index = level < 2 && !descends ? 1 : 0;
      out.descents = level == 2 && descends ? 1 : 0;
      return out;
    });
  };
  const auto anew = climbed(1e-6, [](int level) {
    return level < 2 ? failed(Status::stalled) : pulled(even_series(level));
  });
  for (const bool descends : {false, true}) {
    const auto climb = other(descends);
    CHECK(climb.asked.size() == anew.asked.size());
    CHECK(climb.off() == anew.off());
    CHECK(climb.found.solution.converged());
    CHECK(climb.true_error() <= climb.error());
    CHECK(climb.error() <= 1e-6);
    CHECK(climb.found.solution.descents == int(descends));
  }
}

TEST_CASE("an interrupted climb tells the best that it knows") {
  for (int last = 0; last <= 4; ++last) {
    CAPTURE(last);
    const auto climb = climbed(1e-12, [=](int level) {
      return level == last ? failed(Status::interrupted) : pulled(even_series(level));
    });
    CHECK(climb.found.solution.status == Status::interrupted);
    CHECK(int(climb.asked.size()) == last + 1);
    if (last < 3) CHECK(std::isinf(climb.error()));
    if (last == 1) CHECK(distance(climb.off(), 4 * even_series(0)) < 1e-15);
    if (last >= 3) {
      CHECK(climb.true_error() <= climb.error());
      CHECK(climb.error() < 3e-3);
    }
  }
}

TEST_CASE("rounding ends the climb") {
  const auto climb = climbed(1e-15, [](int level) {
    const double rounding = 1e-16 * std::exp2(level) * (level % 2 ? 1 : -1);
    return pulled(even_series(level) + rounding);
  });
  CHECK(climb.found.solution.status == Status::not_accurate);
  CHECK(climb.found.reached.levels < 10);
  CHECK(climb.true_error() <= climb.error());
  CHECK(climb.error() < 1e-12);
}

TEST_CASE("sums and what follows from the numbers belong to what is told") {
  const auto climb = climbed(1e-10, [](int level) {
    auto out = pulled(0);
    auto& rod = out.rods[0];
    const double x = h(level) * h(level);
    for (auto& q : rod.vertex_frames) q = exp(Vec3(0.4 + 0.1 * x, 0, 0));
    for (auto& q : rod.curve.frames) q = exp(Vec3(0.4 + 0.1 * x, 0, 0));
    for (auto& m : rod.moment) m = Vec3(0.3 + x, 0, 0);
    for (auto& F : rod.load) F = Vec3(0, 1, 0);
    rod.load_moment = Vec3(0, 0, 2 + x);
    rod.bend_twist_energy = 3 + x;
    return out;
  });
  const auto& rod = climb.found.solution.rods[0];
  CHECK(climb.found.solution.converged());
  CHECK(distance(rod.vertex_frames[1], exp(Vec3(0.4, 0, 0))) < 1e-10);
  CHECK(distance(rod.moment[1], Vec3(0.3, 0, 0)) < 1e-10);
  CHECK(distance(rod.material_moment[1], Vec3(0.3, 0, 0)) < 1e-10);  // GJ = EI = 1
  CHECK(distance(rod.strains.K[1], Vec3(0.3, 0, 0)) < 1e-10);
  CHECK(distance(rod.material_force[1], unrotate(rod.curve.frames[1], Vec3(0, 0, 1))) < 1e-15);
  CHECK(rod.bend_twist_energy == doctest::Approx(3).epsilon(1e-10));
  Vec3 levers = Vec3::Zero();
  for (std::size_t j = 0; j <= edges; ++j) levers += rod.curve.positions[j].cross(rod.load[j]);
  CHECK(distance(Vec3(rod.load_moment + levers), Vec3(0, 0, 2)) < 1e-9);
}

TEST_CASE("tolerances out of range are refused") {
  const auto with = [](double tolerance) {
    return [=] { climbed(tolerance, [](int) { return pulled(0); }); };
  };
  CHECK_REFUSED("tol: must lie in (0, 0.1]", with(0)());
  CHECK_REFUSED("tol: must lie in (0, 0.1]", with(-1e-3)());
  CHECK_REFUSED("tol: must lie in (0, 0.1]", with(0.2)());
}
