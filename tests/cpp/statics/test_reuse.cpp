// SPDX-License-Identifier: BSD-3-Clause
// Solves one after another: what the first one leaves behind for the next.
#include "support/allocations.hpp"
#include "support/cantilever.hpp"
#include "support/failing_memory.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

#include <pyrod/solve/newton.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/start/clamped_start.hpp>

using namespace pyrod;
using namespace pyrod::test;

namespace {

template <class Case>
using ProblemOf = NetworkProblem<typename Case::Space>;

template <class Case>
auto pool_of() -> auto& {
  using P = ProblemOf<Case>;
  return Pool<Workspace<LinearisationOf<P>, typename P::State>>::of_this_thread();
}

/// A clamped rod under a force, and the rest shape to start from.
template <class Case>
struct Setting {
  using Space = typename Case::Space;
  Rod<Space> rod;
  Layout<Space> layout;
  ProblemOf<Case> problem;
  NetworkState<Space> start;

  Setting(Random& random, int n)
      : rod(in_model(random.rod<Space>(n), Case::Model::kind)),
        layout(clamped<Space>(rod, {}, loads(random))),
        problem(layout),
        start(ClampedStart<Space>(layout).state()) {}
  Setting(const Setting&) = delete;
  Setting& operator=(const Setting&) = delete;

  Loads<Space> loads(Random& random) const {
    Loads<Space> out(rod.edges());
    out.add_force(rod.grid, 3 * random.vector<Space::dim>(), 1);
    return out;
  }
};

}  // namespace

TEST_CASE_TEMPLATE("the second solve of a shape analyses nothing and allocates nothing", Case,
                   EACH_MODEL) {
  Random random(1);
  pool_of<Case>().clear();
  const Setting<Case> first(random, 40), second(random, 40);
  const FailingMemory cholmod;
  const int before = cholmod.used();
  const auto one = Newton<ProblemOf<Case>>(first.problem).solve(first.start);
  REQUIRE(one.converged());
  const int used = cholmod.used();
  CHECK(used > before);

  auto start = second.start;
  const std::size_t allocated = allocations();
  Eigen::internal::set_is_malloc_allowed(false);  // Eigen's assertions see to it
  Newton<ProblemOf<Case>> newton(second.problem);
  const auto two = newton.solve(std::move(start));
  Eigen::internal::set_is_malloc_allowed(true);
  const std::size_t record_alone = allocations() - allocated;
  CHECK(two.converged());
  CHECK(two.iterations() > 3);
  CHECK(record_alone == 1);  // the record, which is the caller's
  CHECK(cholmod.used() == used);
}

TEST_CASE_TEMPLATE("what a solve finds does not depend on the solves before it", Case, EACH_MODEL) {
  Random random(2);
  const Setting<Case> setting(random, 40), other(random, 40), longer(random, 41);
  const auto solve = [](const Setting<Case>& s) {
    return Newton<ProblemOf<Case>>(s.problem).solve(s.start);
  };
  pool_of<Case>().clear();
  const auto fresh = solve(setting);
  solve(other);
  solve(longer);
  const auto again = solve(setting);
  CHECK(pool_of<Case>().size() == 2);
  CHECK(distance(again.state.frames, fresh.state.frames) == 0);
  CHECK(again.energy == fresh.energy);
  CHECK(again.residual == fresh.residual);
  CHECK(again.record.size() == fresh.record.size());
}

TEST_CASE_TEMPLATE("two solvers at a time do not share", Space, EACH_SPACE) {
  using Case = With<Space, Cosserat>;
  Random random(3);
  const Setting<Case> outer(random, 20), inner(random, 20);
  const auto alone = Newton<ProblemOf<Case>>(outer.problem).solve(outer.start);
  const auto interrupted = [&](const Iteration&) {
    return Newton<ProblemOf<Case>>(inner.problem).solve(inner.start).converged();
  };
  const auto nested = Newton<ProblemOf<Case>>(outer.problem, {}, interrupted).solve(outer.start);
  CHECK(nested.converged());
  CHECK(distance(nested.state.frames, alone.state.frames) == 0);
}
