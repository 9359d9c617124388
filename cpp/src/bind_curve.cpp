// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include "curve.hpp"

namespace pyrod::bind {

CosseratCurve<Spatial> framed_curve(const Grid& grid, const Array& positions, const Array& frames,
                                    const std::optional<Array>& start_frame,
                                    const std::optional<Array>& end_frame) {
  CosseratCurve<Spatial> curve;
  curve.positions = vectors<3>(positions, "positions");
  curve.frames = quaternions(frames, "frames");
  require_count(Eigen::Index(curve.positions.size()), grid.vertices(), "positions",
                "one per vertex");
  require_count(Eigen::Index(curve.frames.size()), grid.edges(), "frames", "one per edge");
  curve.start_frame = start_frame ? quaternion(*start_frame, "start_frame") : curve.frames.front();
  curve.end_frame = end_frame ? quaternion(*end_frame, "end_frame") : curve.frames.back();
  for (int j = 0; j <= grid.edges(); ++j) {
    const Quaternion W = curve.frame_before(j).conjugate() * curve.frame_behind(j);
    require(W.w() > 0 || W.vec().norm() > 5e-7, "frames[", j,
            "]: turned by 2 pi from its neighbour, so that the axis of the turn is lost; "
            "use the other sign of the quaternion, or more edges");
  }
  return curve;
}

void curve(py::module_& module) {
  auto m = module.def_submodule("curve", "Discrete Cosserat curves on the staggered grid.");
  m.def(
      "strains",
      [](const Array& h, const Array& r, const Array& q, const std::optional<Array>& start,
         const std::optional<Array>& end) {
        const Grid grid(numbers(h, "edge_lengths"));
        const auto out = strains(grid, framed_curve(grid, r, q, start, end));
        return py::make_tuple(array<3>(out.K), array<3>(out.Γ));
      },
      py::arg("edge_lengths"), py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
      py::arg("end_frame"));
  m.def(
      "reconstruct",
      [](const Array& h, const Array& K, const Array& Γ, const Array& r0, const Array& q0) {
        const Grid grid(numbers(h, "edge_lengths"));
        const Strains<Spatial> given{vectors<3>(K, "K"), vectors<3>(Γ, "Gamma")};
        require_count(Eigen::Index(given.K.size()), grid.vertices(), "K", "one per vertex");
        require_count(Eigen::Index(given.Γ.size()), grid.edges(), "Gamma", "one per edge");
        const auto curve =
            reconstruct<Spatial>(grid, given, vector3(r0, "position"), quaternion(q0, "frame"));
        return py::make_tuple(array<3>(curve.positions), array(curve.frames),
                              array(curve.end_frame));
      },
      py::arg("edge_lengths"), py::arg("K"), py::arg("Gamma"), py::arg("position"),
      py::arg("frame"));
}

}  // namespace pyrod::bind
