// SPDX-License-Identifier: BSD-3-Clause
// How fast: iterations of the solver, order of the grid.
#include "support/cantilever.hpp"

#include "support/models.hpp"
#include "support/near.hpp"

#include <algorithm>
#include <cmath>

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Space>
Scene<Space> pulled(int n, const Point<Space>& F, double EA, const Spin<Space>& C,
                    const Spin<Space>& K0 = Spin<Space>::Zero()) {
  auto scene = uniform_scene<Space>(n, C, Point<Space>::Constant(EA), K0);
  scene.loads.add_force(scene.rod.grid, F, 1);
  return scene;
}

/// Every step below 0.1 is followed by one of the order of its square.
void check_quadratic(const std::vector<Iteration>& record, double constant) {
  int seen = 0;
  for (std::size_t i = 1; i < record.size(); ++i) {
    const double before = record[i - 1].step;
    if (before > 0.1 || record[i - 1].kind != Hessian::exact) continue;
    CAPTURE(i);
    CHECK(record[i].step <= constant * before * before + 1e-13);
    ++seen;
  }
  CHECK(seen >= 2);
}

}  // namespace

TEST_CASE("an unstretched cantilever takes its side force in one go, however large") {
  for (const double F : {1., 10., 100., 1000.}) {
    for (const double EA : {1e2, 1e4, 1e6}) {
      CAPTURE(F);
      CAPTURE(EA);
      const auto scene = pulled<Planar>(64, Vec2(F, 0), EA, Vec1(1.));
      for (const auto& solution :
           {solved<Planar>(scene), solved<Planar, ExtensibleKirchhoff>(scene),
            solved<Planar, InextensibleKirchhoff>(scene)}) {
        CHECK(solution.status == Status::converged);
        CHECK(solution.index == 0);
        CHECK(solution.record.size() <= 8);
      }
    }
  }
}

TEST_CASE("a curved and anisotropic one in space needs a few more") {
  for (const double F : {1., 10., 100., 1000.}) {
    CAPTURE(F);
    const Vec3 direction = Vec3(1, 0.7, -0.3).normalized();
    const auto scene = pulled<Spatial>(64, F * direction, 1e4, Vec3(1, 3, 0.8), Vec3(1, 2, -1));
    for (const auto& solution :
         {solved<Spatial, Cosserat>(scene), solved<Spatial, ExtensibleKirchhoff>(scene),
          solved<Spatial, InextensibleKirchhoff>(scene)}) {
      CHECK(solution.status == Status::converged);
      CHECK(solution.index == 0);
      CHECK(solution.record.size() <= 12);
    }
  }
}

TEST_CASE("convergence is quadratic, with a potential and without") {
  auto scene = pulled<Spatial>(32, Vec3(3, 2, -1), 1e3, Vec3(1, 2, 0.8), Vec3(0, 1, 0));
  check_quadratic(solved<Spatial, Cosserat>(scene).record, 10);
  scene.loads.add_moment(scene.rod.grid, Vec3(0.5, 1, -0.7), 1);  // dead: no potential
  for (const auto& solution :
       {solved<Spatial, Cosserat>(scene), solved<Spatial, InextensibleKirchhoff>(scene)}) {
    CHECK(solution.status == Status::converged);
    CHECK(solution.index == -1);
    check_quadratic(solution.record, 10);
  }
}

TEST_CASE("on a hundred thousand edges rounding does not defeat the stopping test") {
  const int n = 100000;
  const auto flat = pulled<Planar>(n, Vec2(10, 0), 1e4, Vec1(1.));
  const auto plane = solved<Planar, InextensibleKirchhoff>(flat);
  CHECK(plane.status == Status::converged);
  CHECK(plane.record.size() <= 10);
  CHECK(distance(plane.curve.positions[n], Vec2(0.8106090248802964, 0.4450044022462487)) < 1e-8);

  const auto scene = pulled<Spatial>(n, Vec3(5, 4, -3), 1e4, Vec3(1, 3, 0.8), Vec3(1, 2, -1));
  const auto space = solved<Spatial, Cosserat>(scene);
  CHECK(space.status == Status::converged);
  CHECK(space.record.size() <= 14);
}

TEST_CASE_TEMPLATE("tip, moment and energy converge with the square of the edge length", Case,
                   EACH_MODEL) {
  using Space = typename Case::Space;
  std::vector<Vector> found;  // tip, moment at the clamp, energy
  for (const int n : {32, 64, 128, 256}) {
    const auto solution = solved<Space, typename Case::Model>(rich_scene<Space>(n));
    REQUIRE(solution.status == Status::converged);
    Vector values(Space::dim + Space::spin + 1);
    values << solution.curve.positions[n], solution.moment[0], solution.energy();
    found.push_back(values);
  }
  for (Eigen::Index i = 0; i < found[0].size(); ++i) {
    CAPTURE(i);
    const auto gap = [&](int k) { return std::abs(found[k + 1][i] - found[k][i]); };
    CHECK(gap(2) > 1e-9);
    CHECK(std::log2(gap(1) / gap(2)) == doctest::Approx(2).epsilon(0.05));
  }
}

TEST_CASE("the trace may stop a solve, options reach it") {
  const auto scene = pulled<Planar>(32, Vec2(10, 0), 1e4, Vec1(1.));
  int seen = 0;
  const auto stopped = solved<Planar>(scene, {}, [&](const Iteration&) { return ++seen < 2; });
  CHECK(stopped.status == Status::interrupted);
  CHECK(stopped.record.size() == 2);
  CHECK(stopped.curve.positions.size() == 33);
  Options options;
  options.max_iterations = 1;
  CHECK(solved<Planar>(scene, options).status == Status::out_of_iterations);
  options.trust = -1;
  CHECK_REFUSED("trust:", solved<Planar>(scene, options));
}
