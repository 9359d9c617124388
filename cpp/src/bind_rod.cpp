// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"
#include "curve.hpp"

#include <pyrod/rod/energy.hpp>
#include <pyrod/rod/refinement.hpp>

#include <algorithm>

namespace pyrod::bind {

namespace {

/// The full Hessian as compressed columns: data, row numbers, column starts.
py::tuple columns(Eigen::SparseMatrix<double> H) {
  H.makeCompressed();
  const py::ssize_t entries = H.nonZeros(), starts = H.cols() + 1;
  return py::make_tuple(py::array_t<double>(entries, H.valuePtr()),
                        py::array_t<int>(entries, H.innerIndexPtr()),
                        py::array_t<int>(starts, H.outerIndexPtr()));
}

EnergyJet energy_of(const Rod<Spatial>& rod, ModelKind model, const CosseratCurve<Spatial>& curve,
                    HeldEnds held) {
  return energy(in_model(rod, model), curve, held);
}

}  // namespace

void rod(py::module_& module) {
  py::enum_<ModelKind>(module, "Model")
      .value("cosserat", ModelKind::cosserat)
      .value("extensible", ModelKind::extensible)
      .value("inextensible", ModelKind::inextensible);

  // sides: one (4, 3) for each jump, bending stiffness and rest curvature before, and behind
  py::class_<Rod<Spatial>>(module, "Rod")
      .def(py::init([](const Array& h, const Array& bending, const Array& stretching,
                       const Array& K0, const std::vector<int>& jumps, const Array& sides) {
             require(sides.ndim() == 3 && sides.shape(0) == py::ssize_t(jumps.size()) &&
                         sides.shape(1) == 4 && sides.shape(2) == 3,
                     "sides: expected shape (", jumps.size(), ", 4, 3), got ", shape_of(sides));
             require(stretching.ndim() == 2 && stretching.shape(1) == 3,
                     "stretching: expected an array of shape (n, 3), got ", shape_of(stretching));
             Rod<Spatial> rod{Grid(numbers(h, "edge_lengths")),
                              vectors<3>(bending, "bending"),
                              {},
                              vectors<3>(K0, "K0")};
             for (py::ssize_t j = 0; j < stretching.shape(0); ++j)  // may be infinite
               rod.stretching.emplace_back(Eigen::Map<const Vec3>(stretching.data(j, 0)));
             for (std::size_t i = 0; i < jumps.size(); ++i) {
               const auto side = [&](int k) { return Vec3(sides.data(py::ssize_t(i), k, 0)); };
               rod.jumps.push_back({jumps[i], side(0), side(1), side(2), side(3)});
             }
             rod.check();
             return rod;
           }),
           py::arg("edge_lengths"), py::arg("bending"), py::arg("stretching"), py::arg("K0"),
           py::arg("jumps"), py::arg("sides"))
      .def(
          "at_rest",
          [](const Rod<Spatial>& rod, const Array& r0, const Array& q0) {
            const auto curve = rod.at_rest(vector3(r0, "position"), quaternion(q0, "frame"));
            return py::make_tuple(array<3>(curve.positions), array(curve.frames));
          },
          py::arg("position"), py::arg("frame"))
      .def(
          "energy",
          [](const Rod<Spatial>& rod, ModelKind model, const Array& r, const Array& q,
             const std::optional<Array>& start, const std::optional<Array>& end) {
            const auto curve = framed_curve(rod.grid, r, q, start, end);
            const auto jet = energy_of(rod, model, curve, {start.has_value(), end.has_value()});
            return py::make_tuple(jet.bend_twist, jet.stretch_shear, array(jet.gradient),
                                  columns(jet.hessian));
          },
          py::arg("model"), py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
          py::arg("end_frame"))
      .def_property_readonly("arc_lengths",
                             [](const Rod<Spatial>& rod) { return array(rod.grid.arc_lengths()); })
      .def_property_readonly("length", [](const Rod<Spatial>& rod) { return rod.grid.length(); });
}

}  // namespace pyrod::bind
