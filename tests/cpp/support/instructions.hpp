// SPDX-License-Identifier: BSD-3-Clause
/// \file Kernels with every instruction set that this machine has.
#pragma once

#include <pyrod/core/dispatch.hpp>
#include <pyrod/core/pack.hpp>

#include <doctest/doctest.h>

#include <vector>

namespace pyrod::test {

/// body(instructions) for each set.
template <class Body>
void with_each_instructions(const Body& body) {
  for (const auto set : {Instructions::baseline, Instructions::avx2, Instructions::avx512}) {
    if (set > machine()) break;
    CAPTURE(int(set));
    body(set);
  }
}

/// A kernel: f of packs, applied to numbers in the order in which they are given.
template <class F>
struct Mapped {
  const F& f;
  const std::vector<double>& in;
  std::vector<double>& out;

  template <int W>
  void run() const {
    for (std::size_t j = 0; j < in.size(); j += W) {
      Pack<W> x(0);
      const std::size_t lanes = std::min(in.size() - j, std::size_t(W));
      for (std::size_t i = 0; i < lanes; ++i) x.values[i] = in[j + i];
      const Pack<W> y = f(x);
      for (std::size_t i = 0; i < lanes; ++i) out[j + i] = y.values[i];
    }
  }
};

template <class F>
std::vector<double> mapped(const F& f, const std::vector<double>& in, Instructions set) {
  std::vector<double> out(in.size());
  dispatch(Mapped<F>{f, in, out}, set);
  return out;
}

/// The same numbers so shuffled that small and large ones share a pack.
inline std::vector<double> mixed(const std::vector<double>& in) {
  std::vector<double> out(in.size());
  const std::size_t step = 7919;  // a prime that no sample's size is a multiple of
  for (std::size_t i = 0; i < in.size(); ++i) out[i] = in[i * step % in.size()];
  return out;
}

}  // namespace pyrod::test
