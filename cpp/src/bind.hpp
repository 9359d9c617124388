// SPDX-License-Identifier: BSD-3-Clause
/// \file What all bindings share: NumPy arrays to and from the library's vectors, checked.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rotation/measure.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include <span>
#include <string>
#include <vector>

namespace pyrod::bind {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

void rotation(py::module_& module);
void section(py::module_& module);
void curve(py::module_& module);
void arc(py::module_& module);
void rod(py::module_& module);
void options(py::module_& module);
void breaks(py::module_& module);
void parts(py::module_& module);
void equilibrium(py::module_& module);
void scene(py::module_& module);
void linear(py::module_& module);
void paths(py::module_& module);

inline std::string shape_of(const Array& a) {
  return py::str(py::tuple(a.attr("shape"))).cast<std::string>();
}

/// An (n, N) array as n vectors, all numbers finite.
template <int N>
std::vector<Vec<N>> vectors(const Array& a, const char* name) {
  require(a.ndim() == 2 && a.shape(1) == N, name, ": expected an array of shape (n, ", N, "), got ",
          shape_of(a));
  std::vector<Vec<N>> out(std::size_t(a.shape(0)));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = Eigen::Map<const Vec<N>>(a.data(py::ssize_t(i), 0));
    require(out[i].allFinite(), name, "[", i, "]: expected finite numbers, got ",
            out[i].transpose());
  }
  return out;
}

/// The same without a copy, and without looking at the numbers. The array must outlive the view.
inline std::span<const Vec3> view3(const Array& a, const char* name) {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  require(a.ndim() == 2 && a.shape(1) == 3, name, ": expected an array of shape (n, 3), got ",
          shape_of(a));
  return {reinterpret_cast<const Vec3*>(a.data()), std::size_t(a.shape(0))};
}

inline Vec3 vector3(const Array& a, const char* name) {
  require(a.ndim() == 1 && a.shape(0) == 3, name, ": expected 3 numbers, got shape ", shape_of(a));
  const Vec3 v = Eigen::Map<const Vec3>(a.data());
  require(v.allFinite(), name, ": expected finite numbers, got ", v.transpose());
  return v;
}

/// One number per edge or vertex.
inline Vector numbers(const Array& a, const char* name) {
  require(a.ndim() == 1, name, ": expected one number each, shape (n,), got ", shape_of(a));
  return Eigen::Map<const Vector>(a.data(), a.shape(0));
}

/// Four numbers as a unit quaternion, scalar first. A length that is off by more than 1e-6 is an
/// error, not rounding.
template <class... Name>
Quaternion unit_quaternion(const double* numbers, const Name&... name) {
  const Vec<4> p = Eigen::Map<const Vec<4>>(numbers);
  require(p.allFinite(), name..., ": expected finite numbers, got ", p.transpose());
  require(std::abs(p.norm() - 1) < 1e-6, name...,
          ": expected a unit quaternion (w, x, y, z), got length ", p.norm(),
          "; divide it by its length");
  return Quaternion(p[0], p[1], p[2], p[3]).normalized();
}

/// (n, 4)
inline std::vector<Quaternion> quaternions(const Array& a, const char* name) {
  require(a.ndim() == 2 && a.shape(1) == 4, name, ": expected an array of shape (n, 4), got ",
          shape_of(a));
  std::vector<Quaternion> out(std::size_t(a.shape(0)));
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = unit_quaternion(a.data(py::ssize_t(i), 0), name, "[", i, "]");
  return out;
}

inline Quaternion quaternion(const Array& a, const char* name) {
  require(a.ndim() == 1 && a.shape(0) == 4, name,
          ": expected a quaternion (w, x, y, z), got shape ", shape_of(a));
  return unit_quaternion(a.data(), name, "[0]");
}

template <int N>
py::array_t<double> array(const std::vector<Vec<N>>& rows) {
  py::array_t<double> out({py::ssize_t(rows.size()), py::ssize_t(N)});
  for (std::size_t i = 0; i < rows.size(); ++i)
    Eigen::Map<Vec<N>>(out.mutable_data(py::ssize_t(i), 0)) = rows[i];
  return out;
}

inline Vec<4> coefficients(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

inline py::array_t<double> array(const std::vector<Quaternion>& rows) {
  py::array_t<double> out({py::ssize_t(rows.size()), py::ssize_t(4)});
  for (std::size_t i = 0; i < rows.size(); ++i)
    Eigen::Map<Vec<4>>(out.mutable_data(py::ssize_t(i), 0)) = coefficients(rows[i]);
  return out;
}

/// A long list as an array that takes it over instead of copying it.
template <class List>
py::array_t<double> handed_over(List&& list, std::vector<py::ssize_t> shape) {
  using Owned = std::decay_t<List>;
  auto owned = std::make_unique<Owned>(std::forward<List>(list));
  const auto* data = reinterpret_cast<const double*>(owned->data());
  const py::capsule owner(owned.release(), [](void* p) { delete static_cast<Owned*>(p); });
  return py::array_t<double>(std::move(shape), data, owner);
}
inline py::array_t<double> handed_over(std::vector<Vec3>&& rows) {
  const auto n = py::ssize_t(rows.size());
  return handed_over(std::move(rows), {n, 3});
}
inline py::array_t<double> handed_over(Vector&& values) {
  const auto n = py::ssize_t(values.size());
  return handed_over(std::move(values), {n});
}
inline py::array_t<double> handed_over(std::vector<Quaternion>&& rows) {
  for (auto& q : rows) q.coeffs() = Vec<4>(q.w(), q.x(), q.y(), q.z());  // scalar first
  const auto n = py::ssize_t(rows.size());
  return handed_over(std::move(rows), {n, 4});
}

/// f() as an array, computed while other threads of Python may run.
template <class F>
py::array_t<double> computed(F&& f) {
  return handed_over([&] {
    const py::gil_scoped_release release;
    return f();
  }());
}

/// The measure of a turn, by its name.
inline Measure measure(std::string_view given) {
  for (const Measure m : {Measure::log, Measure::chord, Measure::cayley})
    if (given == name(m)) return m;
  throw InvalidArgument(text("measure: expected log, chord or cayley, got '", given, "'"));
}

/// A single vector or quaternion as a one-dimensional array.
template <int N>
py::array_t<double> array(const Vec<N>& v) {
  return py::array_t<double>(N, v.data());
}
inline py::array_t<double> array(const Quaternion& q) { return array<4>(coefficients(q)); }

inline py::array_t<double> array(const Vector& v) {
  return py::array_t<double>(v.size(), v.data());
}

/// The array, read-only from now on.
inline py::array locked(py::array a) {
  py::detail::array_proxy(a.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return a;
}

}  // namespace pyrod::bind
