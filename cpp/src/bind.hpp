// SPDX-License-Identifier: BSD-3-Clause
/// \file What all bindings share: NumPy arrays to and from the library's vectors, checked.
#pragma once

#include <pyrod/pyrod.hpp>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>
#include <vector>

namespace pyrod::bind {

namespace py = pybind11;
using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

void rotation(py::module_& module);
void section(py::module_& module);
void curve(py::module_& module);
void rod(py::module_& module);
void statics(py::module_& module);

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

/// (n, 4) unit quaternions, scalar first. A length that is off by more than 1e-6 is an error, not
/// rounding.
inline std::vector<Quaternion> quaternions(const Array& a, const char* name) {
  std::vector<Quaternion> out;
  for (const auto& p : vectors<4>(a, name)) {
    require(std::abs(p.norm() - 1) < 1e-6, name, "[", out.size(),
            "]: expected a unit quaternion (w, x, y, z), got length ", p.norm(),
            "; divide it by its length");
    out.push_back(Quaternion(p[0], p[1], p[2], p[3]).normalized());
  }
  return out;
}

inline Quaternion quaternion(const Array& a, const char* name) {
  require(a.ndim() == 1 && a.shape(0) == 4, name,
          ": expected a quaternion (w, x, y, z), got shape ", shape_of(a));
  return quaternions(a.attr("reshape")(1, 4), name)[0];
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

/// A single vector or quaternion as a one-dimensional array.
template <int N>
py::array_t<double> array(const Vec<N>& v) {
  return py::array_t<double>(N, v.data());
}
inline py::array_t<double> array(const Quaternion& q) { return array<4>(coefficients(q)); }

inline py::array_t<double> array(const Vector& v) {
  return py::array_t<double>(v.size(), v.data());
}

}  // namespace pyrod::bind
