// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include <pyrod/solve/options.hpp>

namespace pyrod::bind {

namespace {

template <class T>
void assign(T& member, const py::handle& value, const char* name) {
  try {
    member = value.cast<T>();
  } catch (const py::cast_error&) {
    throw py::type_error(text(name, ": expected a ", std::is_integral_v<T> ? "whole " : "",
                              "number, got ", py::cast<std::string>(py::repr(value))));
  }
}

/// Keyword constructor, attributes, repr and pickling of a struct that lists its fields.
template <class T>
void bind_fields(py::module_& module, const char* name, const char* doc) {
  auto type = py::class_<T>(module, name, doc);
  const auto each = [](auto&& f) {
    std::apply([&](const auto&... field) { (f(field), ...); }, T::fields());
  };
  const auto from = [each](const py::dict& values) {
    T out;
    std::size_t known = 0;
    each([&](const auto& field) {
      if (!values.contains(field.name)) return;
      ++known;
      assign(out.*field.member, values[field.name], field.name);
    });
    if (known != values.size()) {
      std::string names;
      each([&](const auto& field) {
        names += (names.empty() ? "" : ", ") + std::string(field.name);
      });
      throw py::type_error("unknown option among the keywords; there are: " + names);
    }
    out.check();
    return out;
  };
  const auto to_dict = [each](const T& self) {
    py::dict values;
    each([&](const auto& field) { values[field.name] = self.*field.member; });
    return values;
  };
  type.def(py::init([from, name](const py::args& given, const py::kwargs& values) {
    if (!given.empty()) throw py::type_error(std::string(name) + ": give them by keyword");
    return from(values);
  }));
  each([&](const auto& field) { type.def_readonly(field.name, field.member, field.doc); });
  type.def("__repr__", [to_dict, name](const T& self) {
    std::string inside;
    for (const auto& [key, value] : to_dict(self))
      inside += text(inside.empty() ? "" : ", ", py::cast<std::string>(key), "=",
                     py::cast<std::string>(py::repr(value)));
    return std::string(name) + "(" + inside + ")";
  });
  type.def("__eq__", [to_dict](const T& a, const py::object& b) {
    return py::isinstance<T>(b) && to_dict(a).equal(to_dict(b.cast<const T&>()));
  });
  type.def("__hash__", [](const py::object& self) { return py::hash(py::repr(self)); });
  type.def(py::pickle(to_dict, from));
}

}  // namespace

void options(py::module_& module) {
  bind_fields<Options>(module, "Options", "What may be tuned in a solve; keywords only.");
}

}  // namespace pyrod::bind
