// SPDX-License-Identifier: BSD-3-Clause
/// \file Rows of a large sum on several threads, with the same result for any number of them.
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace pyrod {

/// Asked between rows, on the calling thread, whether to go on.
using KeepGoing = std::function<bool()>;

/// A long computation was told to stop.
struct Interrupted : std::exception {
  const char* what() const noexcept override { return "interrupted"; }
};

/// Calls row(i) once for each i in [0, rows), in no fixed order, on `threads` threads of which the
/// caller is one; 0: as many as the machine has cores. Rows must not share what they write. What a
/// row throws is thrown here, after all threads have ended.
template <class Row>
void for_each_row(int rows, int threads, const KeepGoing& keep_going, const Row& row) {
  if (threads <= 0) threads = int(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<int> next{0};
  std::exception_ptr failure;
  std::mutex guard;
  const auto fail = [&] {
    const std::lock_guard lock(guard);
    if (!failure) failure = std::current_exception();
    next = rows;
  };
  const auto work = [&](bool caller) {
    try {
      for (int i; (i = next++) < rows; row(i))
        if (caller && keep_going && !keep_going()) throw Interrupted();
    } catch (...) {
      fail();
    }
  };
  {
    std::vector<std::jthread> others;
    for (int t = 1; t < std::min(threads, rows); ++t) others.emplace_back(work, false);
    work(true);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace pyrod
