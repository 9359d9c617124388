// SPDX-License-Identifier: BSD-3-Clause
/// \file Timing: medians over repeated batches, so that a busy machine shows less.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

namespace pyrod::benchmark {

/// Median over `batches` of the mean time [s] of one call, each batch at least `least` seconds
/// long.
template <class F>
double seconds(F&& call, int batches = 7, double least = 0.02) {
  using Clock = std::chrono::steady_clock;
  const auto time = [&](int calls) {
    const auto began = Clock::now();
    for (int i = 0; i < calls; ++i) call();
    return std::chrono::duration<double>(Clock::now() - began).count();
  };
  int calls = 1;
  while (time(calls) < least && calls < 1 << 20) calls *= 2;
  std::vector<double> means;
  for (int i = 0; i < batches; ++i) means.push_back(time(calls) / calls);
  std::nth_element(means.begin(), means.begin() + batches / 2, means.end());
  return means[std::size_t(batches / 2)];
}

}  // namespace pyrod::benchmark
