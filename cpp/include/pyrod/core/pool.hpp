// SPDX-License-Identifier: BSD-3-Clause
/// \file Storage that is kept from one use to the next.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace pyrod {

/// Idle objects of one type, for the next user on the same thread whom one of them fits. T says by
/// `bytes()` what it holds.
template <class T>
class Pool {
 public:
  static constexpr std::size_t most_objects = 8, most_bytes = std::size_t(64) << 20;

  static Pool& of_this_thread() {
    thread_local Pool pool;
    return pool;
  }

  /// The one that was given back last of those that fit, or else what `make` returns.
  template <class Fits, class Make>
  std::unique_ptr<T> take(const Fits& fits, const Make& make) {
    for (auto item = idle_.rbegin(); item != idle_.rend(); ++item) {
      if (!fits(std::as_const(**item))) continue;
      std::unique_ptr<T> found = std::move(*item);
      idle_.erase(std::next(item).base());
      return found;
    }
    return make();
  }

  /// Keeps it, unless it is too large; those that have been idle longest give way.
  void give_back(std::unique_ptr<T> object) {
    if (object->bytes() > most_bytes) return;
    idle_.push_back(std::move(object));
    while (idle_.size() > most_objects || bytes() > most_bytes) idle_.erase(idle_.begin());
  }

  std::size_t size() const { return idle_.size(); }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& item : idle_) sum += item->bytes();
    return sum;
  }
  void clear() { idle_.clear(); }

 private:
  Pool() { idle_.reserve(most_objects + 1); }

  std::vector<std::unique_ptr<T>> idle_;  // the one used last is at the end
};

}  // namespace pyrod
