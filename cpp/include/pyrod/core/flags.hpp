// SPDX-License-Identifier: BSD-3-Clause
/// \file Compiler flags that pyrod cannot do with, and those that all units of a program must
/// share.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "pyrod needs infinities and NaN: compile without -ffast-math and -ffinite-math-only"
#endif

#include <Eigen/Core>

// Eigen aligns its vectors, and with them our data types, as the instruction set asks. Two units of
// a program that differ in this take each other's data for something else. So each of them defines
// one symbol, whose value is the alignment of heap and stack: linkers take the same value twice,
// and refuse two. From inside a function, as link-time optimisation looks at symbols outside of
// any.
#if defined(__ELF__) && defined(__GNUC__)
#define PYROD_TEXT_OF(x) #x
#define PYROD_TEXT(x) PYROD_TEXT_OF(x)
namespace pyrod::detail {
namespace {
[[gnu::used]] void mark_alignment() {
  asm(".globl pyrod_error_all_units_need_the_same_march\n\t"
      ".hidden pyrod_error_all_units_need_the_same_march\n\t"
      ".set pyrod_error_all_units_need_the_same_march, "
      "256 * (" PYROD_TEXT(EIGEN_DEFAULT_ALIGN_BYTES) ") "
      "+ (" PYROD_TEXT(EIGEN_MAX_STATIC_ALIGN_BYTES) ")");
}
}  // namespace
}  // namespace pyrod::detail
#undef PYROD_TEXT
#undef PYROD_TEXT_OF
#endif
