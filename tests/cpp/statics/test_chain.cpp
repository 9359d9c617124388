// SPDX-License-Identifier: BSD-3-Clause
// The evaluation in packs, beside cell by cell and edge by edge; the same bits with any
// instructions.
#include <pyrod/statics/chain.hpp>

#include "support/dense.hpp"
#include "support/instructions.hpp"
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
  using Storage = Linearisation<BlockTridiagonal<spin>>;

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

  Chain<Space> columns() const {
    const auto of = [&](const auto& list) { return [&list](int j) { return list[j]; }; };
    return {n,
            clamp,
            Columns<spin>(n, [&](int j) { return bending[j] / Δs[j]; }),
            Columns<spin>(n, [&](int j) { return Δs[j] * K0[j]; }),
            Columns<1>(n, [&](int j) { return Vec1(h[j]); }),
            Columns<dim>(n, of(force)),
            Columns<dim>(n, of(compliance))};
  }

  template <Curvature kind>
  Storage in_packs(Instructions set) const {
    Storage out{0, 0, Vector::Constant(spin * n, NAN), BlockTridiagonal<spin>(n)};
    std::fill(out.hessian.values.begin(), out.hessian.values.end(), NAN);
    const auto chain = columns();
    dispatch(ChainLinearisation<Space, kind>(chain, frames.data(), out), set);
    return out;
  }

  /// Energy, magnitude, gradient and Hessian by the sum of the cells and edges.
  template <Curvature kind>
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
template <Curvature kind, class Space>
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
    compare<Curvature::exact>(chain);
    compare<Curvature::convex>(chain);
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
      compare<Curvature::exact>(chain, condition);
      compare<Curvature::convex>(chain, condition);
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
  compare<Curvature::exact>(chain);
  compare<Curvature::convex>(chain);
}
