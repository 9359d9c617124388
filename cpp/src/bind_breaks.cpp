// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/scene/break_search.hpp>

namespace pyrod::bind {

namespace {

/// A function in Python, which gives a number or an array, of as many numbers at every place.
class Asked {
 public:
  explicit Asked(const py::function& function) : function_(function) {}

  void operator()(std::span<const double> s, Samples& values) const {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Array row(function_(s[i]));
      const Eigen::Map<const Eigen::RowVectorXd> numbers(row.data(), row.size());
      if (i == 0) values.resize(std::ssize(s), row.size());
      require(row.size() == values.cols(), "a function of arc length gives ", row.size(),
              " numbers at ", s[i], ", and ", values.cols(), " at ", s[0]);
      values.row(Eigen::Index(i)) = numbers;
    }
  }

 private:
  const py::function& function_;
};

}  // namespace

void breaks(py::module_& module) {
  module.def(
      "breaks",
      [](const py::function& function, double length) {
        const auto found = breaks_of(Asked(function), length);
        return py::make_tuple(py::tuple(py::cast(found.at)), found.unresolved);
      },
      py::arg("function"), py::arg("length"),
      "Where a function of arc length jumps or has kinks, and whether there is more of that.");
}

}  // namespace pyrod::bind
