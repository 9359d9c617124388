// SPDX-License-Identifier: BSD-3-Clause
/// \file Whether what is shared may be changed.
#pragma once

#include <atomic>
#include <memory>

namespace pyrod {

/// Whether nobody else owns it. What other threads did with it before they let it go is done then:
/// the count alone does not tell that.
template <class T>
bool is_sole_owner(const std::shared_ptr<T>& owned) {
  if (owned.use_count() != 1) return false;
  std::atomic_thread_fence(std::memory_order_acquire);
  return true;
}

}  // namespace pyrod
