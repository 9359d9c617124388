// SPDX-License-Identifier: BSD-3-Clause
/// \file CHOLMOD's memory, counted, and refused from a given allocation on.
#pragma once

#include <SuiteSparse_config.h>

#include <cstdlib>
#include <limits>

namespace pyrod::test {

/// While it lives, CHOLMOD gets `allowed` allocations and then none.
class FailingMemory {
 public:
  explicit FailingMemory(int allowed = std::numeric_limits<int>::max()) {
    left_ = allowed;
    used_ = 0;
    set(allocate, clear, resize);
  }
  ~FailingMemory() { set(std::malloc, std::calloc, std::realloc); }
  FailingMemory(const FailingMemory&) = delete;
  FailingMemory& operator=(const FailingMemory&) = delete;

  int used() const { return used_; }

 private:
  using Allocate = void* (*)(std::size_t);
  using Clear = void* (*)(std::size_t, std::size_t);
  using Resize = void* (*)(void*, std::size_t);

  static void set(Allocate a, Clear c, Resize r) {
#if SUITESPARSE_MAIN_VERSION >= 7
    SuiteSparse_config_malloc_func_set(a);
    SuiteSparse_config_calloc_func_set(c);
    SuiteSparse_config_realloc_func_set(r);
#else
    SuiteSparse_config.malloc_func = a;
    SuiteSparse_config.calloc_func = c;
    SuiteSparse_config.realloc_func = r;
#endif
  }
  static bool granted() {
    ++used_;
    return left_-- > 0;
  }
  static void* allocate(std::size_t size) { return granted() ? std::malloc(size) : nullptr; }
  static void* clear(std::size_t count, std::size_t size) {
    return granted() ? std::calloc(count, size) : nullptr;
  }
  static void* resize(void* p, std::size_t size) {
    return granted() ? std::realloc(p, size) : nullptr;
  }

  inline static int left_ = 0, used_ = 0;
};

}  // namespace pyrod::test
