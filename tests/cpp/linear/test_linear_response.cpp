// SPDX-License-Identifier: BSD-3-Clause
// Changes of equilibria against differences of equilibria, and forward against backward.
#include "support/allocations.hpp"
#include "support/difference.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <pyrod/linear/linear_response.hpp>
#include <pyrod/linear/numbers.hpp>

#include <memory>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A network in equilibrium, and what is told of it as one list of numbers.
template <class Space>
struct Balanced {
  Posed<Space> posed;
  NetworkState<Space> x;
  Solution<Space> found;

  explicit Balanced(const Network<Space>& net, const NetworkState<Space>* near = nullptr)
      : posed(net) {
    const Trace untraced;
    Options options;
    options.tolerance = 1e-10;
    NetworkOptions any;
    any.stable = near == nullptr;
    NetworkSolver<Space> solver(posed, options, any, untraced);
    const StateNear<Space> starts(posed.layout(), posed.here(), net.nodes.size());
    auto reached = near ? solver.find(starts.state(*near)) : solver.find();
    REQUIRE(reached.converged());
    found = told(posed, reached);
    x = std::move(reached.state);
  }
};

/// Told items in the order of `told`, against the same of `base`: frames as turns from there.
template <class Space>
struct Told {
  const Balanced<Space>& base;
  const LinearResponse<Space>& linear;

  Vector flat(const Balanced<Space>& now) const {
    auto out = linear.no_change();
    const auto& items = linear.told_items();
    const auto& layout = base.posed.layout();
    const auto put = [&](int item, const auto& v) { out.told.col(item).head(v.size()) = v; };
    out.told(0, items.energy()) = 0;
    for (int rod = 0; rod < int(now.found.rods.size()); ++rod) {
      const auto &s = now.found.rods[rod], &t = base.found.rods[rod];
      for (int j = 0; j < int(s.curve.positions.size()); ++j)
        out.positions.col(linear.positions().column(rod, j)) = s.curve.positions[j];
      for (int j = 0; j < int(s.curve.frames.size()); ++j) {
        const int e = layout.edge(rod, j);
        out.state.col(linear.state_items().turn(e)).template head<Space::spin>() =
            log(t.curve.frames[j].conjugate() * s.curve.frames[j]);
        out.state.col(linear.state_items().force(e)).template head<Space::dim>() = s.force[j];
        put(items.strain(e), s.strains.Γ[j]);
      }
      for (int j = 0; j < int(s.moment.size()); ++j) {
        const int v = items.vertex(rod, j);
        put(items.vertex_turn(v),
            log(principal(frame(base, rod, j).conjugate() * frame(now, rod, j))));
        put(items.curvature(v), s.strains.K[j]);
        put(items.moment(v), s.moment[j]);
      }
      out.told(0, items.energy()) += s.bend_twist_energy + s.stretch_shear_energy;
    }
    for (int v = 0; v < int(now.found.nodes.size()); ++v) {
      put(items.reaction_force(v), now.found.nodes[v].reaction_force);
      put(items.reaction_moment(v), now.found.nodes[v].reaction_moment);
    }
    return flat(out);
  }

  /// Closed rods do not tell them.
  static typename Space::Rotation frame(const Balanced<Space>& of, int rod, int j) {
    const auto& s = of.found.rods[rod];
    const auto& grid = of.posed.network().rods[rod].grid;
    return grid.closed() ? vertex_frame(grid, s.curve, j) : s.vertex_frames[j];
  }

  /// What can be compared: no reaches of edges, nor rotations of vertices, which are no functions.
  Vector flat(const typename LinearResponse<Space>::Change& c) const {
    const auto& items = linear.told_items();
    const int E = base.posed.layout().edges();
    Items<Space> told = c.told.rightCols(c.told.cols() - E);
    auto positions = c.positions;
    told.middleCols(items.rotation(0) - E, items.vertices()).setZero();
    const auto& rods = base.posed.network().rods;
    for (int rod = 0; rod < int(rods.size());
         ++rod) {  // the ends of a closed rod are told otherwise
      if (!rods[rod].grid.closed()) continue;
      positions.col(linear.positions().column(rod, rods[rod].edges())).setZero();
      told.col(items.curvature(items.vertex(rod, 0)) - E).setZero();
      told.col(items.vertex_turn(items.vertex(rod, 0)) - E).setZero();
    }
    Vector out(2 * E * c.state.rows() + told.size() + c.positions.size());
    out << c.state.leftCols(2 * E).reshaped(), told.reshaped(), positions.reshaped();
    return out;
  }
};

/// Everything of a network that may change, some of it, or all.
enum class What { forces, moments, places, frames, sections, lengths, springs, all };

template <class Space>
Network<Space> changed(Network<Space> net, What what, double t, unsigned seed) {
  Random random(seed);
  const auto is = [&](What one) { return what == one || what == What::all ? t : 0; };
  const auto point = [&] { return random.vector<Space::dim>(); };
  const auto turn = [&] { return random.vector<Space::spin>(); };
  for (std::size_t i = 0; i < net.rods.size(); ++i) {
    auto& rod = net.rods[i];
    auto& loads = net.loads[i];
    for (auto& F : loads.force) F += is(What::forces) * point();
    for (auto& f : loads.follower_forces) f.force += is(What::forces) * point();
    for (auto& m : loads.moment) m += is(What::moments) * turn();
    loads.start_moment += is(What::moments) * turn();
    loads.end_moment += is(What::moments) * turn();
    for (auto& m : loads.follower_moments) m.moment += is(What::moments) * turn();
    if (!loads.follower_end_moment.isZero(0))
      loads.follower_end_moment += is(What::moments) * turn();
    for (auto& C : rod.bending) C += is(What::sections) * turn();
    for (auto& C : rod.stretching) C += is(What::sections) * point();
    for (auto& K : rod.K0) K += is(What::sections) * turn();
    Vector h = rod.grid.edge_lengths();
    for (auto& one : h) one *= 1 + 0.3 * is(What::lengths) * random.number();
    rod.grid = Grid(h, rod.grid.closure());
  }
  for (auto& v : net.nodes) {
    v.position += 0.3 * is(What::places) * point();
    v.frame = v.frame * exp(Spin<Space>(is(What::frames) * turn()));
    if (!v.moment.isZero(0)) v.moment += is(What::moments) * turn();  // else it needs a frame
    if (v.spring > 0) v.spring += is(What::springs) * random.number();
    if (v.torsion_spring > 0) v.torsion_spring += is(What::springs) * random.number();
  }
  for (auto& a : net.attachments)
    a.relative = a.relative * exp(Spin<Space>(is(What::frames) * turn()));
  return net;
}

/// Of sixth order.
template <class F>
auto slope(const F& f, double h) {
  auto out = f(3 * h);
  out -= f(-3 * h);
  out += 9 * f(-2 * h) - 9 * f(2 * h);
  out += 45 * f(h) - 45 * f(-h);
  out /= 60 * h;
  return out;
}

template <class Space>
void check(const Network<Space>& net, What what) {
  const Balanced<Space> base(net);
  LinearResponse<Space> linear(base.posed.problem(), base.x);
  const Told<Space> told{base, linear};
  const Items<Space> numbers = slope(
      [&](double t) {
        const Layout<Space> layout(changed(net, what, t, 5));
        return NumbersOf<Space>(layout, base.posed.layout(), base.x).values();
      },
      2e-3);
  auto change = linear.no_change();
  linear.push(numbers, change);
  const Vector derivative = told.flat(change);
  REQUIRE(derivative.allFinite());
  const auto at = [&](double t) {
    return told.flat(Balanced<Space>(changed(net, what, t, 5), &base.x));
  };
  const Vector difference = slope(at, 2e-3);
  Eigen::Index worst = 0;
  (difference - derivative).cwiseAbs().maxCoeff(&worst);
  CAPTURE(int(what));
  CAPTURE(worst);
  CAPTURE(difference[worst]);
  CAPTURE(derivative[worst]);
  CHECK((difference - derivative).norm() <= 2e-9 * derivative.norm());

  Random random(3);
  auto weights = linear.no_change();
  for (auto* one : {&weights.told, &weights.state})
    for (auto& w : one->reshaped()) w = random.number();
  weights.state.rightCols(weights.state.cols() - 2 * base.posed.layout().edges()).setZero();
  for (auto& w : weights.positions.reshaped()) w = random.number();
  auto gradient = linear.no_numbers();
  linear.pull(weights, gradient);
  const double forward = weights.told.cwiseProduct(change.told).sum() +
                         weights.state.cwiseProduct(change.state).sum() +
                         weights.positions.cwiseProduct(change.positions).sum();
  const double backward = gradient.cwiseProduct(numbers).sum();
  CHECK(std::abs(forward - backward) <= 1e-11 * (std::abs(forward) + change.told.norm()));
}

constexpr What kinds[] = {What::forces,   What::moments, What::places,  What::frames,
                          What::sections, What::lengths, What::springs, What::all};

}  // namespace

TEST_CASE_TEMPLATE("changes of a network are those of its equilibria", Space, EACH_SPACE) {
  for (const auto& acting :
       {Acting{}, Acting{true}, Acting{true, true}, Acting{false, false, true}}) {
    Random random(acting.closed ? 1 : 8);
    const auto net = random_network<Space>(random, acting);
    CAPTURE(acting.moments);
    CAPTURE(acting.followers);
    CAPTURE(acting.closed);
    for (const What what : kinds) check<Space>(net, what);
  }
}

TEST_CASE_TEMPLATE("after the first product nothing is allocated", Space, EACH_SPACE) {
  Random random(8);
  const Balanced<Space> base(random_network<Space>(random, {}));
  LinearResponse<Space> linear(base.posed.problem(), base.x);
  auto numbers = linear.no_numbers(), gradient = numbers;
  for (auto& one : numbers.reshaped()) one = random.number();
  auto change = linear.no_change(), weights = change;
  for (auto& w : weights.positions.reshaped()) w = random.number();
  linear.push(numbers, change), linear.pull(weights, gradient);
  const auto before = allocations();
  Eigen::internal::set_is_malloc_allowed(false);
  linear.push(numbers, change), linear.pull(weights, gradient);
  Eigen::internal::set_is_malloc_allowed(true);
  CHECK(allocations() == before);
}

TEST_CASE_TEMPLATE("several changes at once are those one by one", Space, EACH_SPACE) {
  Random random(8);
  Structure<Space> clamped;  // where nothing is added to the matrix
  clamped.clamp(clamped.add(6), 0);
  for (const auto& net : {random_network<Space>(random, {}), clamped.net}) {
    const Balanced<Space> base(net);
    LinearResponse<Space> linear(base.posed.problem(), base.x);
    std::vector<Items<Space>> numbers(5, linear.no_numbers());
    for (auto& one : numbers)
      for (int rod = 0; rod < int(net.rods.size()); ++rod)
        one.col(linear.number_items().force(rod, 2)).template head<Space::dim>() =
            random.template vector<Space::dim>();
    auto change = linear.no_change(), alone = change;
    int seen = 0;
    linear.push_all(
        5, [&](int k) -> const Items<Space>& { return numbers[k]; }, change,
        [&](int k, const auto& out) {
          CHECK(k == seen++);
          linear.push(numbers[k], alone);
          CHECK((out.state - alone.state).norm() <= 1e-12 * alone.state.norm());
          CHECK((out.told - alone.told).norm() <= 1e-12 * alone.told.norm());
          CHECK((out.positions - alone.positions).norm() <= 1e-12 * alone.positions.norm());
        });
    CHECK(seen == 5);
  }
}

TEST_CASE("the tangent's transpose is that of the solver's product") {
  Random random(8);
  const Balanced<Spatial> base(random_network<Spatial>(random, {true, true}));
  LinearResponse<Spatial> linear(base.posed.problem(), base.x);
  const int size = base.posed.layout().unknowns();
  const Vector v = random.vector(size), w = random.vector(size);
  Vector Zv, Ztw;
  base.posed.problem().multiply_skew(base.x, v, Zv);
  linear.multiply_skew(w, Ztw, true);
  CHECK(std::abs(w.dot(Zv) - Ztw.dot(v)) < 1e-13 * w.norm() * Zv.norm());
}
