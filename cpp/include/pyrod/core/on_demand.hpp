// SPDX-License-Identifier: BSD-3-Clause
/// \file A value that is made when it is first asked for.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <utility>

namespace pyrod {

/// Made once, whoever asks first; what it is made from is let go then. Threads may ask at once.
template <class T>
class OnDemand {
 public:
  explicit OnDemand(T known) : value_(std::move(known)) {}
  explicit OnDemand(std::function<T()> make) : make_(std::move(make)) {}

  const T& get() const {
    std::function<T()> done;  // let go when others may ask again: that may run code of users
    std::call_once(once_, [&] {
      if (value_) return;
      value_ = make_();
      done.swap(make_);
    });
    return *value_;
  }

 private:
  mutable std::once_flag once_;
  mutable std::function<T()> make_;
  mutable std::optional<T> value_;
};

}  // namespace pyrod
