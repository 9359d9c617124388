// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/core/parallel.hpp>

#include <doctest/doctest.h>

#include <numeric>
#include <stdexcept>
#include <string>

using namespace pyrod;

namespace {

std::string thrown_by(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "(nothing)";
}

/// How many are inside at the moment, and how many were.
struct Visitors {
  std::atomic<int> inside{0}, all{0};
};

struct Visit {
  explicit Visit(Visitors& at) : visitors(at) { ++visitors.inside, ++visitors.all; }
  ~Visit() { --visitors.inside; }
  Visitors& visitors;
};

void wait_for(const std::atomic<bool>& flag) {
  while (!flag) std::this_thread::yield();
}

}  // namespace

TEST_CASE("each row is computed once, by any number of threads") {
  for (const int threads : {-1, 0, 1, 2, 3, 8})
    for (const int rows : {0, 1, 2, 7, 1000}) {
      CAPTURE(threads);
      CAPTURE(rows);
      std::vector<std::atomic<int>> calls(std::size_t(rows) + 1);
      for_each_row(rows, threads, {}, [&](int i) { ++calls[std::size_t(i)]; });
      for (int i = 0; i < rows; ++i) CHECK(calls[std::size_t(i)] == 1);
      CHECK(calls.back() == 0);
    }
}

TEST_CASE("one thread is the caller's, and takes the rows in order") {
  std::vector<int> order;
  const auto caller = std::this_thread::get_id();
  for_each_row(50, 1, {}, [&](int i) {
    CHECK(std::this_thread::get_id() == caller);
    order.push_back(i);
  });
  std::vector<int> expected(50);
  std::iota(expected.begin(), expected.end(), 0);
  CHECK(order == expected);
}

TEST_CASE("no more threads than rows, and several at a time") {
  std::mutex guard;
  std::vector<std::thread::id> ids;
  std::atomic<int> arrived{0};
  for_each_row(3, 20, {}, [&](int) {
    const std::lock_guard lock(guard);
    ids.push_back(std::this_thread::get_id());
  });
  std::sort(ids.begin(), ids.end());
  CHECK(std::unique(ids.begin(), ids.end()) - ids.begin() <= 3);
  for_each_row(3, 3, {}, [&](int) {  // ends only if all three are at work together
    ++arrived;
    while (arrived < 3) std::this_thread::yield();
  });
  CHECK(arrived == 3);
}

TEST_CASE("what a row throws on another thread arrives at the caller, after all have ended") {
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> failed{false};
  Visitors visitors;
  CHECK(thrown_by([&] {
          for_each_row(1000000, 2, {}, [&](int) {
            const Visit visit(visitors);
            if (std::this_thread::get_id() == caller) return wait_for(failed);
            failed = true;
            throw std::runtime_error("from another thread");
          });
        }) == "from another thread");
  CHECK(visitors.inside == 0);
  CHECK(visitors.all < 1000000);  // the others stop
}

TEST_CASE("what a row throws on the calling thread is thrown after all have ended") {
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> failed{false};
  Visitors visitors;
  CHECK(thrown_by([&] {
          for_each_row(1000000, 3, {}, [&](int) {
            const Visit visit(visitors);
            if (std::this_thread::get_id() != caller) return wait_for(failed);
            failed = true;
            throw std::runtime_error("from the caller");
          });
        }) == "from the caller");
  CHECK(visitors.inside == 0);
  CHECK(visitors.all < 1000000);
}

TEST_CASE("all rows throw: one exception arrives") {
  for (const int threads : {1, 2, 8})
    CHECK(thrown_by([&] {
            for_each_row(100, threads, {}, [](int) { throw std::out_of_range("row"); });
          }) == "row");
}

TEST_CASE("told to stop, it throws Interrupted") {
  int left = 5, rows = 0;
  CHECK_THROWS_AS(
      for_each_row(100, 1, [&] { return left-- > 0; }, [&](int) { ++rows; }), Interrupted);
  CHECK(rows == 5);
  std::atomic<int> many{0};
  std::atomic<bool> asked{false};
  CHECK(thrown_by([&] {
          for_each_row(
              1000000, 4, [&] { return asked = true, false; },
              [&](int) {
                wait_for(asked);
                ++many;
              });
        }) == "interrupted");
  CHECK(many < 1000000);
}

TEST_CASE("whether to go on is asked on the calling thread, once for each of its rows") {
  const auto caller = std::this_thread::get_id();
  int rows = 0;
  std::atomic<int> asked{0};
  std::atomic<bool> wrong{false}, others{false};
  const auto ask = [&] {
    wrong = wrong || std::this_thread::get_id() != caller;
    ++asked;
    return true;
  };
  for_each_row(1000, 3, ask, [&](int) {
    if (std::this_thread::get_id() != caller)
      others = true;
    else
      ++rows, wait_for(others);
  });
  CHECK(asked == rows);
  CHECK_FALSE(wrong);
  asked = 0;
  for_each_row(0, 3, ask, [](int) {});
  CHECK(asked == 0);
}

TEST_CASE("an exception thrown while asking is passed on as it is") {
  CHECK(thrown_by([] {
          for_each_row(10, 2, []() -> bool { throw std::runtime_error("signal"); }, [](int) {});
        }) == "signal");
}
