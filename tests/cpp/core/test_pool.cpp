// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/core/pool.hpp>

#include <doctest/doctest.h>

#include <thread>

using namespace pyrod;

namespace {

struct Thing {
  std::size_t size = 1;
  std::size_t bytes() const { return size; }
};

std::unique_ptr<Thing> make() { return std::make_unique<Thing>(); }
std::unique_ptr<Thing> none() {
  FAIL("one was idle");
  return {};
}

}  // namespace

TEST_CASE("what was given back is taken again, by the same shape on the same thread only") {
  auto& pool = Pool<Thing>::of_this_thread();
  pool.clear();
  auto thing = pool.take(3, make);
  const Thing* address = thing.get();
  pool.give_back(3, std::move(thing));
  CHECK(pool.size() == 1);
  auto other = pool.take(4, make);
  CHECK(other.get() != address);
  std::jthread([] { CHECK(Pool<Thing>::of_this_thread().size() == 0); }).join();
  auto again = pool.take(3, none);
  CHECK(again.get() == address);
  CHECK(pool.size() == 0);
  CHECK(pool.take(3, make).get() != address);  // in use
}

TEST_CASE("a pool is bounded in number and in memory, and forgets what was idle longest") {
  using Things = Pool<Thing>;
  auto& pool = Things::of_this_thread();
  pool.clear();
  const int most = int(Things::most_objects);
  for (int shape = 0; shape <= most; ++shape) pool.give_back(shape, make());
  CHECK(pool.size() == Things::most_objects);
  bool made = false;
  pool.take(0, [&] { return made = true, make(); });
  CHECK(made);
  pool.take(most, none);

  pool.clear();
  const std::size_t half = Things::most_bytes / 2;
  for (int shape = 0; shape < 3; ++shape)
    pool.give_back(shape, std::make_unique<Thing>(Thing{half}));
  CHECK(pool.size() == 2);
  CHECK(pool.bytes() == Things::most_bytes);
  pool.give_back(9, std::make_unique<Thing>(Thing{Things::most_bytes + 1}));
  CHECK(pool.size() == 2);
  pool.take(2, none);
  pool.take(1, none);
}
