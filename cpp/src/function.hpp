// SPDX-License-Identifier: BSD-3-Clause
/// \file Functions of arc length that are written in Python.
#pragma once

#include "bind.hpp"

namespace pyrod::bind {

/// It may be called, copied and let go of by any thread: each call takes the lock of Python.
class Function {
 public:
  explicit Function(py::function f)
      : f_(new py::function(std::move(f)), [](py::function* held) {
          const py::gil_scoped_acquire gil;
          delete held;
        }) {}

  /// What `read` makes of the value at s.
  template <class Read>
  auto operator()(double s, const Read& read) const {
    const py::gil_scoped_acquire gil;
    return read((*f_)(s));
  }

 private:
  std::shared_ptr<py::function> f_;
};

}  // namespace pyrod::bind
