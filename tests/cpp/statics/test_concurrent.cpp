// SPDX-License-Identifier: BSD-3-Clause
// Solves on several threads at the same time. The thread sanitizer looks on, see CMakePresets.json.
#include "support/cantilever.hpp"
#include "support/models.hpp"
#include "support/near.hpp"
#include "support/network.hpp"

#include <barrier>
#include <thread>

using namespace pyrod;
using namespace pyrod::test;

namespace {

constexpr int threads = 4, repeats = 3;

/// What each thread finds when all begin together, again and again.
template <class Find>
auto together(const Find& find) {
  std::vector<decltype(find())> found(threads * repeats);
  std::barrier begin(threads);
  {
    std::vector<std::jthread> team;
    for (int t = 0; t < threads; ++t)
      team.emplace_back([&, t] {
        for (int i = 0; i < repeats; ++i) {
          begin.arrive_and_wait();
          found[std::size_t(t * repeats + i)] = find();
        }
      });
  }
  return found;
}

template <class Rotation, class Positions>
bool same(const std::vector<Rotation>& q, const Positions& r, const std::vector<Rotation>& p,
          const Positions& s) {
  return distance(q, p) == 0 && r == s;
}

}  // namespace

TEST_CASE_TEMPLATE("clamped rods on several threads are those on one, to the bit", Case,
                   EACH_MODEL) {
  const auto scene = rich_scene<typename Case::Space>(32);
  const auto find = [&] { return solved<typename Case::Space, typename Case::Model>(scene).curve; };
  const auto alone = find();
  for (const auto& curve : together(find))
    CHECK(same(curve.frames, curve.positions, alone.frames, alone.positions));
}

TEST_CASE_TEMPLATE("networks on several threads are those on one, to the bit", Space, EACH_SPACE) {
  Random random(3);
  const auto net = random_network<Space>(random, {});
  const auto find = [&] { return solved(net).rods; };
  const auto alone = find();
  for (const auto& rods : together(find)) {
    REQUIRE(rods.size() == alone.size());
    for (std::size_t i = 0; i < rods.size(); ++i)
      CHECK(same(rods[i].curve.frames, rods[i].curve.positions, alone[i].curve.frames,
                 alone[i].curve.positions));
  }
}
