// SPDX-License-Identifier: BSD-3-Clause
// In which order blocks are eliminated.
#include "support/random.hpp"

#include <pyrod/sparse/elimination_order.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

using namespace pyrod;
using namespace pyrod::test;

namespace {

/// k × k blocks of any sizes, each coupled to its neighbours.
BlockGraph lattice(Random& random, int k, double stretched = 1) {
  BlockGraph graph;
  for (int i = 0; i < k * k; ++i)
    graph.add(1 + int(3 * std::abs(random.number())), Vec3(i % k, stretched * (i / k), 0));
  for (int i = 0; i < k * k; ++i) {
    if (i % k + 1 < k) graph.couple({i, i + 1});
    if (i + k < k * k) graph.couple({i, i + k});
  }
  graph.compress();
  return graph;
}

std::vector<int> sorted(std::vector<int> order) {
  std::sort(order.begin(), order.end());
  return order;
}

std::vector<int> all(const BlockGraph& graph) {
  std::vector<int> out(std::size_t(graph.blocks()));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// By elimination in a dense table of what is coupled.
double dense_work(const BlockGraph& graph, const std::vector<int>& order) {
  const int n = graph.blocks();
  std::vector<std::vector<char>> coupled(std::size_t(n), std::vector<char>(std::size_t(n), false));
  for (int a = 0; a < n; ++a)
    for (const int b : graph.neighbours[a]) coupled[a][b] = true;
  std::vector<char> gone(std::size_t(n), false);
  double work = 0;
  for (const int a : order) {
    gone[a] = true;
    double height = graph.sizes[a];
    for (int b = 0; b < n; ++b) {
      if (gone[b] || !coupled[a][b]) continue;
      height += graph.sizes[b];
      for (int c = 0; c < n; ++c)
        if (b != c && !gone[c] && coupled[a][c]) coupled[b][c] = true;
    }
    work += graph.sizes[a] * height * height;
  }
  return work;
}

}  // namespace

TEST_CASE("groups are coupled each with all, once, and without the blocks that have no unknowns") {
  BlockGraph graph;
  for (const int size : {1, 2, 0, 3}) graph.add(size, Vec3::Zero());
  graph.couple({0, 1, 2});
  graph.couple({3, 1, 1});
  graph.couple({0, 1});
  graph.compress();
  CHECK(graph.neighbours[0] == std::vector{1});
  CHECK(graph.neighbours[1] == std::vector{0, 3});
  CHECK(graph.neighbours[2].empty());
  CHECK(graph.neighbours[3] == std::vector{1});
}

TEST_CASE("orders have every block once, in whatever places") {
  Random random(1);
  for (const int k : {1, 2, 5, 9, 20}) {
    BlockGraph graph = lattice(random, k);
    const auto check = [&] {
      CHECK(sorted(by_minimum_degree(graph)) == all(graph));
      CHECK(sorted(NestedDissection(graph).order()) == all(graph));
      CHECK(sorted(elimination_order(graph)) == all(graph));
    };
    check();
    for (auto& place : graph.places) place = random.vector<3>();
    check();
    for (auto& place : graph.places) place = Vec3(place[0] > 0, 0, 0);  // two places
    check();
    for (auto& place : graph.places) place.setZero();
    check();
  }
  CHECK(elimination_order({}).empty());
}

TEST_CASE("the work is that of an elimination") {
  Random random(2);
  for (const int k : {1, 3, 6}) {
    const BlockGraph graph = lattice(random, k);
    auto order = all(graph);
    CHECK(elimination_work(graph, order) == dense_work(graph, order));
    std::reverse(order.begin(), order.end() - order.size() / 3);
    CHECK(elimination_work(graph, order) == dense_work(graph, order));
    order = by_minimum_degree(graph);
    CHECK(elimination_work(graph, order) == dense_work(graph, order));
  }
}

TEST_CASE("a long strip is cut across, whichever way it lies") {
  Random random(3);
  BlockGraph graph = lattice(random, 12, 1e-3);
  const double along_x = elimination_work(graph, NestedDissection(graph).order());
  for (auto& place : graph.places) place = Vec3(0, place[1] * 1e6, place[0] * 1e6);
  CHECK(elimination_work(graph, NestedDissection(graph).order()) == along_x);
}

TEST_CASE("of two orders the better one is kept, and large lattices are dissected well") {
  Random random(4);
  for (const int k : {8, 16, 32}) {
    const BlockGraph graph = lattice(random, k);
    const double degree = elimination_work(graph, by_minimum_degree(graph)),
                 cut = elimination_work(graph, NestedDissection(graph).order());
    CHECK(elimination_work(graph, elimination_order(graph)) == std::min(degree, cut));
    CHECK(cut < 2 * degree);
  }
}

TEST_CASE("where lines tie their blocks together, planes beat degrees") {
  // on each crossing of two sets of lines: one block of both, and one of each line alone
  BlockGraph graph;
  const int k = 16;
  const auto block = [&](int kind, int i, int j) { return 3 * (i * k + j) + kind; };
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j)
      for (int kind = 0; kind < 3; ++kind) graph.add(3, Vec3(i, j, 0));
  for (int i = 0; i < k; ++i)
    for (int j = 0; j + 1 < k; ++j) {
      graph.couple({block(0, i, j), block(1, i, j), block(0, i, j + 1), block(1, i, j + 1)});
      graph.couple({block(0, j, i), block(2, j, i), block(0, j + 1, i), block(2, j + 1, i)});
    }
  graph.compress();
  const double degree = elimination_work(graph, by_minimum_degree(graph));
  CHECK(elimination_work(graph, elimination_order(graph)) < 0.2 * degree);
}
