// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

namespace pyrod::bind {

namespace {

/// Applies f to every item of a list.
template <class Items, class F>
auto each(const Items& items, F&& f) {
  std::vector<std::decay_t<decltype(f(items[0]))>> out;
  out.reserve(items.size());
  for (const auto& item : items) out.push_back(f(item));
  return array(out);
}

/// Applies f to the items of two lists of one length.
template <class A, class B, class F>
auto pairwise(const A& a, const B& b, F&& f) {
  require(a.size() == b.size(), "expected as many rotations as vectors or second rotations, got ",
          a.size(), " and ", b.size());
  std::vector<std::decay_t<decltype(f(a[0], b[0]))>> out;
  out.reserve(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) out.push_back(f(a[i], b[i]));
  return array(out);
}

Quaternion from_matrix(const Mat3& R, std::size_t i) {
  const double error = (R.transpose() * R - Mat3::Identity()).norm();
  require(error < 1e-6 && R.determinant() > 0, "matrix[", i,
          "]: expected a rotation (orthonormal columns a1, a2, a3, right-handed), off by ", error);
  return Quaternion(R).normalized();
}

/// Rotations from vectors, and back.
void bind_measures(py::module_& m) {
  m.def(
      "exp",
      [](const Array& φ) {
        return each(vectors<3>(φ, "vector"), [](const Vec3& v) { return exp(v); });
      },
      py::arg("vector"));
  m.def(
      "log",
      [](const Array& q) {
        return each(quaternions(q, "quaternion"), [](const Quaternion& p) { return log(p); });
      },
      py::arg("quaternion"));
  m.def(
      "cayley",
      [](const Array& φ) {
        return each(vectors<3>(φ, "vector"), [](const Vec3& v) { return cayley(v); });
      },
      py::arg("vector"));
  m.def(
      "inverse_cayley",
      [](const Array& q) {
        return each(quaternions(q, "quaternion"),
                    [](const Quaternion& p) { return inverse_cayley(p); });
      },
      py::arg("quaternion"));
}

void bind_products_and_matrices(py::module_& m) {
  m.def(
      "multiply",
      [](const Array& a, const Array& b) {
        return pairwise(quaternions(a, "a"), quaternions(b, "b"),
                        [](const Quaternion& p, const Quaternion& q) { return Quaternion(p * q); });
      },
      py::arg("a"), py::arg("b"));
  m.def(
      "rotate",
      [](const Array& q, const Array& v) {
        return pairwise(quaternions(q, "quaternion"), vectors<3>(v, "vector"),
                        [](const Quaternion& p, const Vec3& x) { return rotate(p, x); });
      },
      py::arg("quaternion"), py::arg("vector"));
  m.def(
      "to_matrix",
      [](const Array& q) {
        const auto items = quaternions(q, "quaternion");
        py::array_t<double> out({py::ssize_t(items.size()), py::ssize_t(3), py::ssize_t(3)});
        for (std::size_t i = 0; i < items.size(); ++i)
          Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
              out.mutable_data(py::ssize_t(i), 0, 0)) = matrix(items[i]);
        return out;
      },
      py::arg("quaternion"));
  m.def(
      "from_matrix",
      [](const Array& R) {
        std::vector<Quaternion> out;
        for (const auto& entries : vectors<9>(R, "matrix"))
          out.push_back(from_matrix(
              Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(entries.data()),
              out.size()));
        return array(out);
      },
      py::arg("matrix"));
}

}  // namespace

void rotation(py::module_& module) {
  auto m = module.def_submodule("rotation", "Unit quaternions, scalar first, row by row.");
  bind_measures(m);
  bind_products_and_matrices(m);
}

}  // namespace pyrod::bind
