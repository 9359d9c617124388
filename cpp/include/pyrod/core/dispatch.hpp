// SPDX-License-Identifier: BSD-3-Clause
/// \file The widest vector registers of the machine a program runs on, whatever machine it was
/// compiled for.
///
/// A kernel is a function object with a member template `run<W>()`, which computes with packs of W
/// doubles. It is compiled as the translation unit is, and also for x86-64-v3 (AVX2, four lanes)
/// and x86-64-v4 (AVX-512, eight); `dispatch` runs the best of these that the machine can. Nothing
/// crosses between instruction sets but references, as a kernel takes no packs.
///
/// `PYROD_NO_DISPATCH` leaves the first alone, everywhere in a program. So does a translation unit
/// that is compiled for AVX (-march=native) or for another processor than an x86-64.
#pragma once

#if !defined(PYROD_NO_DISPATCH) && defined(__x86_64__) && defined(__GNUC__) && !defined(__AVX__)
#define PYROD_DISPATCH 1
#else
#define PYROD_DISPATCH 0
#endif

namespace pyrod {

enum class Instructions { baseline, avx2, avx512 };

/// What this machine has.
inline Instructions machine() {
#if PYROD_DISPATCH
  static const Instructions found = [] {
    __builtin_cpu_init();
    if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma") ||
        !__builtin_cpu_supports("bmi2"))
      return Instructions::baseline;
    const bool wide = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                      __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd");
    return wide ? Instructions::avx512 : Instructions::avx2;
  }();
  return found;
#else
  return Instructions::baseline;
#endif
}

namespace detail {

#if defined(__AVX512F__)
inline constexpr int lanes = 8;
#elif defined(__AVX__)
inline constexpr int lanes = 4;
#else
inline constexpr int lanes = 2;
#endif

// Flattened, so that all a kernel calls is compiled for the same instructions.
template <class Kernel>
[[gnu::flatten]] void run_baseline(const Kernel& kernel) {
  kernel.template run<lanes>();
}
#if PYROD_DISPATCH
template <class Kernel>
[[gnu::target("arch=x86-64-v3"), gnu::flatten]] void run_avx2(const Kernel& kernel) {
  kernel.template run<4>();
}
template <class Kernel>
[[gnu::target("arch=x86-64-v4"), gnu::flatten]] void run_avx512(const Kernel& kernel) {
  kernel.template run<8>();
}
#endif

}  // namespace detail

/// Runs a kernel with the given instructions, which the machine must have.
template <class Kernel>
void dispatch(const Kernel& kernel, Instructions instructions = machine()) {
#if PYROD_DISPATCH
  if (instructions == Instructions::avx512) return detail::run_avx512(kernel);
  if (instructions == Instructions::avx2) return detail::run_avx2(kernel);
#endif
  (void)instructions;
  detail::run_baseline(kernel);
}

}  // namespace pyrod
