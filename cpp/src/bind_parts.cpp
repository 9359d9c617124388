// SPDX-License-Identifier: BSD-3-Clause
/// \file Supports, loads and joints: made from the values of their fields, in their order.
#include "function.hpp"
#include "parts.hpp"

namespace pyrod::bind {

namespace {

// What a field of each type is read from ----------------------------------------------------------

void read(const py::handle& given, const char* name, Vec3& out) {
  out = vector3(given.cast<Array>(), name);
}
void read(const py::handle& given, const char* name, Quaternion& out) {
  out = quaternion(given.cast<Array>(), name);
}
void read(const py::handle& given, const char*, Place& out) { out = place(given); }
void read(const py::handle& given, const char*, std::vector<Place>& out) {
  for (const auto& point : given.cast<py::tuple>()) out.push_back(place(point));
}
void read(const py::handle& given, const char*, JointKind& out) {
  const auto kind = given.cast<std::string>();
  out = kind == "rigid" ? JointKind::rigid : kind == "hinge" ? JointKind::hinge : JointKind::ball;
}
void read(const py::handle& given, const char* name, bool& out) {
  try {
    out = given.cast<bool>();
  } catch (const py::cast_error&) {
    throw py::type_error(
        text(name, ": expected True or False, got ", py::cast<std::string>(py::repr(given))));
  }
}
void read(const py::handle& given, const char*, int& out) { out = given.cast<int>(); }
void read(const py::handle& given, const char*, double& out) { out = given.cast<double>(); }
Vec2 vector2(const Array& a, const char* name) {
  require(a.ndim() == 1 && a.shape(0) == 2, name, ": expected 2 numbers, got shape ", shape_of(a));
  const Vec2 v = Eigen::Map<const Vec2>(a.data());
  require(v.allFinite(), name, ": expected finite numbers, got ", v.transpose());
  return v;
}
Vec<2> vector(const Array& a, const char* name, const Vec2*) { return vector2(a, name); }
Vec<3> vector(const Array& a, const char* name, const Vec3*) { return vector3(a, name); }
/// (N,), (n, N) or a function of arc length.
template <int N>
void read(const py::handle& given, const char* name, Along<Vec<N>>& out) {
  constexpr const Vec<N>* kind = nullptr;
  if (PyCallable_Check(given.ptr())) {
    const Function f(py::reinterpret_borrow<py::function>(given));
    out = FunctionAlong<Vec<N>>([f, name](double s) {
      return f(s, [name](const py::object& v) { return vector(v.cast<Array>(), name, kind); });
    });
    return;
  }
  const auto a = given.cast<Array>();
  if (a.ndim() == 1)
    out = vector(a, name, kind);
  else
    out = vectors<N>(a, name);
}
void read(const py::handle& given, const char* name, Along<Vec2>& out) {
  read<2>(given, name, out);
}
void read(const py::handle& given, const char* name, Along<Vec3>& out) {
  read<3>(given, name, out);
}
template <class T>
void read(const py::handle& given, const char* name, std::optional<T>& out) {
  if (given.is_none()) return;
  T value{};
  read(given, name, value);
  out = value;
}

/// The class of one kind.
template <class T>
void part(py::module_& module, const char* kind) {
  py::class_<T> type(module, kind);
  type.attr("fields") = std::apply(
      [](const auto&... field) { return py::list(py::make_tuple(field.name...)); }, T::fields());
  type.def(py::init([kind](const py::args& values) {
    T out{};
    std::size_t i = 0;
    const auto next = [&](const auto& field) { read(values[i++], field.name, out.*field.member); };
    std::apply(
        [&](const auto&... field) {
          if (values.size() != sizeof...(field))
            throw py::type_error(text(kind, ": expected ", sizeof...(field), " values"));
          (next(field), ...);
        },
        T::fields());
    return out;
  }));
}

/// The classes of all kinds of a variant.
template <class... T>
void parts(py::module_& module, const std::variant<T...>*) {
  (part<T>(module, T::kind), ...);
}

}  // namespace

Place place(const py::handle& at) {
  const auto on = [](const py::handle& one, auto&& make) {
    if (!py::isinstance<py::str>(one)) return make(one.cast<double>());
    return make(one.cast<std::string>() == "start" ? End::start : End::end);
  };
  if (!py::isinstance<py::tuple>(at)) return on(at, [](auto end) { return Place(end); });
  const auto pair = at.cast<py::tuple>();
  return on(pair[1], [rod = pair[0].cast<int>()](auto end) { return Place(rod, end); });
}

void parts(py::module_& module) {
  parts(module, static_cast<const Support*>(nullptr));
  parts(module, static_cast<const Load*>(nullptr));
  parts(module, static_cast<const Actuator*>(nullptr));
  part<Joint>(module, "Joint");
}

}  // namespace pyrod::bind
