// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/core/pool.hpp>

#include <doctest/doctest.h>

#include <thread>

using namespace pyrod;

namespace {

struct Thing {
  int shape;
  std::size_t size = 1;
  std::size_t bytes() const { return size; }
};

std::unique_ptr<Thing> make() { return std::make_unique<Thing>(Thing{3}); }
std::unique_ptr<Thing> made(int shape) { return std::make_unique<Thing>(Thing{shape}); }
auto of(int shape) {
  return [shape](const Thing& thing) { return thing.shape == shape; };
}
std::unique_ptr<Thing> none() {
  FAIL("one was idle");
  return {};
}

}  // namespace

TEST_CASE("what was given back is taken again, by the same shape on the same thread only") {
  auto& pool = Pool<Thing>::of_this_thread();
  pool.clear();
  auto thing = pool.take(of(3), make);
  const Thing* address = thing.get();
  pool.give_back(std::move(thing));
  CHECK(pool.size() == 1);
  auto other = pool.take(of(4), make);
  CHECK(other.get() != address);
  std::jthread([] { CHECK(Pool<Thing>::of_this_thread().size() == 0); }).join();
  auto again = pool.take(of(3), none);
  CHECK(again.get() == address);
  CHECK(pool.size() == 0);
  CHECK(pool.take(of(3), make).get() != address);  // in use
}

TEST_CASE("a pool is bounded in number and in memory, and forgets what was idle longest") {
  using Things = Pool<Thing>;
  auto& pool = Things::of_this_thread();
  pool.clear();
  const int most = int(Things::most_objects);
  for (int shape = 0; shape <= most; ++shape) pool.give_back(made(shape));
  CHECK(pool.size() == Things::most_objects);
  bool new_one = false;
  pool.take(of(0), [&] { return new_one = true, make(); });
  CHECK(new_one);
  pool.take(of(most), none);

  pool.clear();
  const std::size_t half = Things::most_bytes / 2;
  for (int shape = 0; shape < 3; ++shape)
    pool.give_back(std::make_unique<Thing>(Thing{shape, half}));
  CHECK(pool.size() == 2);
  CHECK(pool.bytes() == Things::most_bytes);
  pool.give_back(std::make_unique<Thing>(Thing{9, Things::most_bytes + 1}));
  CHECK(pool.size() == 2);
  pool.take(of(2), none);
  pool.take(of(1), none);
}
