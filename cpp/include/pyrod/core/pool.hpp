// SPDX-License-Identifier: BSD-3-Clause
/// \file Storage that is kept from one use to the next.
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

namespace pyrod {

/// Idle objects of one type, each made for a shape, for the next user on the same thread that asks
/// for the same shape. T says by `bytes()` what it holds.
template <class T>
class Pool {
 public:
  static constexpr std::size_t most_objects = 8, most_bytes = std::size_t(64) << 20;

  static Pool& of_this_thread() {
    thread_local Pool pool;
    return pool;
  }

  /// One that is idle, or else what `make` returns.
  template <class Make>
  std::unique_ptr<T> take(int shape, const Make& make) {
    for (auto item = idle_.rbegin(); item != idle_.rend(); ++item) {
      if (item->first != shape) continue;
      std::unique_ptr<T> found = std::move(item->second);
      idle_.erase(std::next(item).base());
      return found;
    }
    return make();
  }

  /// Keeps it, unless it is too large; those that have been idle longest give way.
  void give_back(int shape, std::unique_ptr<T> object) {
    if (object->bytes() > most_bytes) return;
    idle_.emplace_back(shape, std::move(object));
    while (idle_.size() > most_objects || bytes() > most_bytes) idle_.erase(idle_.begin());
  }

  std::size_t size() const { return idle_.size(); }
  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const auto& item : idle_) sum += item.second->bytes();
    return sum;
  }
  void clear() { idle_.clear(); }

 private:
  Pool() { idle_.reserve(most_objects + 1); }

  std::vector<std::pair<int, std::unique_ptr<T>>> idle_;  // the one used last is at the end
};

}  // namespace pyrod
