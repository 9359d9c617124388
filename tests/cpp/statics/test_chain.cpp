// SPDX-License-Identifier: BSD-3-Clause
// The evaluation in packs, beside cell by cell and edge by edge; the same bits with any
// instructions.
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/chain_reach.hpp>

#include "support/dense.hpp"
#include "support/instructions.hpp"
#include "support/matrices.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/random.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// A chain of n edges at random, in lists and in columns.
template <class Space>
struct RandomChain {
  using Rotation = typename Space::Rotation;
  static constexpr int dim = Space::dim, spin = Space::spin;
  using Storage = Linearisation<BlockSymmetric>;

  int n;
  Rotation clamp;
  std::vector<Rotation> frames;
  std::vector<Spin<Space>> bending, K0;
  std::vector<Point<Space>> force, compliance;
  std::vector<double> Δs, h;

  /// Each vertex turns by an angle between `least` and `most`.
  RandomChain(Random& random, int edges, double least, double most)
      : n(edges), clamp(random.rotation<Space>()) {
    for (int j = 0; j < n; ++j) {
      const auto& before = j == 0 ? clamp : frames[j - 1];
      frames.push_back(moved(before, random.turn<Space>(random.number(least, most))));
      bending.push_back(random.between<spin>(0.5, 3));
      K0.push_back(random.vector<spin>());
      force.push_back(3 * random.vector<dim>());
      compliance.push_back(random.between<dim>(0, 0.2));
      Δs.push_back(random.number(0.1, 0.3));
      h.push_back(random.number(0.1, 0.3));
    }
  }

  EdgeColumns<Space> columns() const {
    return {Columns<spin>(n, [&](int j) { return bending[j] / Δs[j]; }),
            Columns<spin>(n, [&](int j) { return Δs[j] * K0[j]; }),
            Columns<1>(n, [&](int j) { return Vec1(h[j]); }),
            Columns<dim>(n, [&](int j) { return compliance[j]; })};
  }
  Columns<dim> forces() const {
    return {n, [&](int j) { return force[j]; }};
  }

  template <Hessian kind>
  Storage in_packs(Instructions set) const {
    Storage out{0, 0, Vector::Constant(spin * n, NAN), chain_of(spin, n)};
    std::fill(out.hessian.values.begin(), out.hessian.values.end(), NAN);
    const auto edges = columns();
    const auto told = forces();
    const Chain<Space> chain{n, 0, edges, told, Point<Space>::Zero(), clamp, frames.data()};
    ChainRows<Space> rows{out.gradient.data(), out.hessian.template chain<spin>(0, n)};
    dispatch(ChainLinearisation<Space, kind>(chain, rows), set);
    out.energy = rows.energy, out.magnitude = rows.magnitude;
    return out;
  }

  /// Energy, magnitude, gradient and Hessian by the sum of the cells and edges.
  template <Hessian kind>
  auto one_by_one() const {
    struct {
      double energy = 0, magnitude = 0;
      Vector gradient;
      Dense hessian;
    } out;
    out.gradient = Vector::Zero(spin * n);
    out.hessian = Dense::Zero(spin * n, spin * n);
    for (int j = 0; j < n; ++j) {
      const Spin<Space> u = log((j == 0 ? clamp : frames[j - 1]).conjugate() * frames[j]);
      const auto cell =
          bend_twist<kind>(u, typename Space::Differential(u), bending[j], K0[j], Δs[j]);
      const auto edge = edge_term<kind, Space, double>(frames[j], force[j], compliance[j], h[j]);
      const int a = spin * (j - 1), b = spin * j;
      out.energy += cell.energy + edge.energy;
      out.magnitude += cell.energy + std::abs(edge.energy);
      out.gradient.template segment<spin>(b) += cell.b + edge.gradient;
      out.hessian.template block<spin, spin>(b, b) += cell.bb + edge.hessian;
      if (j == 0) continue;
      out.gradient.template segment<spin>(a) += cell.a;
      out.hessian.template block<spin, spin>(a, a) += cell.aa;
      out.hessian.template block<spin, spin>(a, b) += cell.ab;
      out.hessian.template block<spin, spin>(b, a) += cell.ab.transpose();
    }
    return out;
  }
};

/// `condition`: by how much the chain enlarges the rounding of a turn.
template <Hessian kind, class Space>
void compare(const RandomChain<Space>& chain, double condition = 1) {
  const auto expected = chain.template one_by_one<kind>();
  const auto first = chain.template in_packs<kind>(Instructions::baseline);
  CHECK(std::abs(first.energy - expected.energy) < 1e-15 * expected.magnitude);
  CHECK(std::abs(first.magnitude - expected.magnitude) < 1e-15 * expected.magnitude);
  CHECK(distance(first.gradient, expected.gradient) < 2e-15 * condition * expected.gradient.norm());
  CHECK(distance(dense(first.hessian), expected.hessian) <
        2e-15 * condition * expected.hessian.norm());
  with_each_instructions([&](Instructions set) {
    const auto other = chain.template in_packs<kind>(set);
    CHECK(other.energy == first.energy);
    CHECK(other.magnitude == first.magnitude);
    CHECK(other.gradient == first.gradient);
    CHECK(other.hessian.values == first.hessian.values);
  });
}

}  // namespace

TEST_CASE_TEMPLATE("packs of edges are edges, for any number of them", Space, EACH_SPACE) {
  Random random(1);
  for (int n = 1; n < 36; ++n) {
    CAPTURE(n);
    const RandomChain<Space> chain(random, n, 0, 0.1);
    compare<Hessian::exact>(chain);
    compare<Hessian::convex>(chain);
  }
}

TEST_CASE_TEMPLATE("lanes on different sides of every branch", Space, EACH_SPACE) {
  Random random(2);
  for (const auto& [least, most] :
       {std::pair{0., 1.}, {0., 3.1}, {0., 6.2}, {6.2, 6.28}, {0., 0.}}) {
    CAPTURE(most);
    const double condition = std::max(1., 1 / (2 * std::numbers::pi - most));  // pole at 2π
    for (int i = 0; i < 20; ++i) {
      const RandomChain<Space> chain(random, 33, least, most);
      compare<Hessian::exact>(chain, condition);
      compare<Hessian::convex>(chain, condition);
    }
  }
}

TEST_CASE_TEMPLATE("edges along their force, against it, and without any", Space, EACH_SPACE) {
  Random random(3);
  RandomChain<Space> chain(random, 33, 0, 1);
  for (auto& S : chain.compliance) S.setConstant(S[0]);  // else the secant jumps where it aligns
  for (int j = 0; j < chain.n; ++j)
    chain.force[j] = double(j % 3 - 1) * rotate(chain.frames[j], axis<Space>());
  for (int j = 0; j < chain.n; j += 4) chain.frames[j] = Space::Rotation::Identity();
  for (int j = 0; j < chain.n; j += 4) chain.force[j] = double(j % 8 - 4) * axis<Space>();
  compare<Hessian::exact>(chain);
  compare<Hessian::convex>(chain);
}

namespace {

/// A part of a chain, with a force that is added: what packs make of it, in any matrix.
template <class Space>
struct Part {
  static constexpr int dim = Space::dim, spin = Space::spin;
  const RandomChain<Space>& whole;
  int first, edges;
  Point<Space> added;

  Chain<Space> chain(const EdgeColumns<Space>& columns, const Columns<dim>& told) const {
    const auto* frames = whole.frames.data() + first;
    return {edges, first, columns, told, added, first == 0 ? whole.clamp : frames[-1], frames};
  }

  /// The same edges as a chain of their own.
  RandomChain<Space> alone() const {
    const auto cut = [this](auto& list) {
      list.erase(list.begin(), list.begin() + first);
      list.resize(std::size_t(edges), list.front());
    };
    RandomChain<Space> out = whole;
    if (first > 0) out.clamp = whole.frames[first - 1];
    cut(out.frames), cut(out.bending), cut(out.K0), cut(out.force), cut(out.compliance);
    cut(out.Δs), cut(out.h);
    for (auto& n : out.force) n += added;
    out.n = edges;
    return out;
  }
};

template <class Space>
struct Reached : Reach<Space> {
  std::vector<Vector> rows;
};

template <class Space>
Reached<Space> reached(const Part<Space>& part, const Mat<Space::dim>& C, Instructions set) {
  const auto columns = part.whole.columns();
  const auto told = part.whole.forces();
  const auto chain = part.chain(columns, told);
  Reached<Space> out;
  out.give.setZero();
  std::array<double*, Space::dim> to;
  for (int k = 0; k < Space::dim; ++k)
    out.rows.push_back(Vector::Constant(Space::spin * part.edges, NAN));
  for (int k = 0; k < Space::dim; ++k) to[k] = out.rows[k].data();
  dispatch(ChainReach<Space>(chain, C, Space::dim, to, out), set);
  return out;
}

}  // namespace

TEST_CASE_TEMPLATE("a part of a chain, in a matrix of other blocks", Space, EACH_SPACE) {
  constexpr int spin = Space::spin;
  Random random(4);
  const RandomChain<Space> whole(random, 30, 0, 1);
  for (const int first : {0, 3, 7})
    for (const int edges : {1, 2, 3, 8, 9, 23}) {
      const Part<Space> part{whole, first, edges, random.vector<Space::dim>()};
      const auto expected = part.alone().template in_packs<Hessian::exact>(machine());
      // a block before the chain, to which its ends are coupled
      std::vector<int> sizes(std::size_t(edges + 1), spin);
      std::vector<std::vector<int>> above{{}, {0}};
      for (int j = 1; j < edges; ++j) above.push_back({j});
      if (edges > 1) above.back() = {0, edges - 1};
      BlockSymmetric A(pattern_of(sizes, above));
      const auto columns = whole.columns();
      const auto told = whole.forces();
      const auto chain = part.chain(columns, told);
      Vector gradient(spin * edges);
      ChainRows<Space> rows{gradient.data(), A.template chain<spin>(spin, edges)};
      dispatch(ChainLinearisation<Space, Hessian::exact>(chain, rows));
      CHECK(rows.energy == expected.energy);
      CHECK(rows.magnitude == expected.magnitude);
      CHECK(gradient == expected.gradient);
      const Dense all = dense(A);
      CHECK(all.bottomRightCorner(spin * edges, spin * edges) == dense(expected.hessian));
      CHECK(all.topRows(spin).norm() == 0);
    }
}

TEST_CASE_TEMPLATE("the reach of a chain, and how frames change it", Space, EACH_SPACE) {
  constexpr int dim = Space::dim, spin = Space::spin;
  Random random(5);
  for (const int n : {1, 2, 7, 8, 9, 33}) {
    const RandomChain<Space> whole(random, n + 4, 0, 1);
    const Part<Space> part{whole, 2, n, random.vector<dim>()};
    const Mat<dim> C = Mat<dim>::NullaryExpr([&] { return random.number(); });
    const auto first = reached(part, C, Instructions::baseline);
    Reached<Space> sum;
    sum.rigid.setZero(), sum.strained.setZero(), sum.give.setZero();
    for (int j = 0; j < n; ++j) {
      const auto& q = whole.frames[j + 2];
      const Mat<dim> R = matrix(q);
      const Point<Space> S = whole.compliance[j + 2],
                         b = R.transpose() * (whole.force[j + 2] + part.added);
      const double h = whole.h[j + 2];
      sum.rigid += h * R.col(dim - 1);
      sum.strained += h * R * S.cwiseProduct(b);
      sum.give += h * R * S.asDiagonal() * R.transpose();
      const Point<Space> Γ = axis<Space>() + S.cwiseProduct(b);
      for (int k = 0; k < dim; ++k) {
        const Point<Space> c = h * R.transpose() * C.col(k);
        const Spin<Space> row = cross(c, Γ) + cross(b, Point<Space>(S.cwiseProduct(c)));
        CHECK(distance(first.rows[k].template segment<spin>(spin * j), row) < 1e-14);
      }
    }
    CHECK(distance(first.rigid, sum.rigid) < 1e-14 * n);
    CHECK(distance(first.strained, sum.strained) < 1e-14 * n);
    const Mat<dim> give = first.give.template selfadjointView<Eigen::Upper>();
    CHECK(distance(give, sum.give) < 1e-14 * n);
    with_each_instructions([&](Instructions set) {
      const auto other = reached(part, C, set);
      CHECK(other.rigid == first.rigid);
      CHECK(other.strained == first.strained);
      CHECK(other.give == first.give);
      for (int k = 0; k < dim; ++k) CHECK(other.rows[k] == first.rows[k]);
    });
  }
}
