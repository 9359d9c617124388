// SPDX-License-Identifier: BSD-3-Clause
#include "bind.hpp"

#include "curve.hpp"

#include <pyrod/curve/averages.hpp>
#include <pyrod/curve/conversion.hpp>

namespace pyrod::bind {

CosseratCurve<Spatial> framed_curve(const Grid& grid, const Array& positions, const Array& frames,
                                    const std::optional<Array>& start_frame,
                                    const std::optional<Array>& end_frame, Measure measure) {
  auto r = vectors<3>(positions, "positions");
  auto q = quaternions(frames, "frames");
  require_count(Eigen::Index(r.size()), grid.vertices(), "positions", "one per vertex");
  require_count(Eigen::Index(q.size()), grid.edges(), "frames", "one per edge");
  require(!grid.closed() || !(start_frame || end_frame),
          "start_frame, end_frame: a closed curve has no ends");
  CosseratCurve<Spatial> curve;
  if (grid.closed()) {
    curve = closed(std::move(r), std::move(q));
  } else {
    curve.start_frame = start_frame ? quaternion(*start_frame, "start_frame") : q.front();
    curve.end_frame = end_frame ? quaternion(*end_frame, "end_frame") : q.back();
    curve.positions = std::move(r);
    curve.frames = std::move(q);
  }
  for (int j = 0; j < grid.vertices(); ++j) check_turn(difference(curve, j), j, measure);
  return curve;
}

namespace {

Grid grid_of(const Array& h, bool closed) {
  return Grid(numbers(h, "edge_lengths"), closed ? Closure::closed : Closure::open);
}

py::tuple arrays(CosseratCurve<Spatial>&& curve) {
  return py::make_tuple(handed_over(std::move(curve.positions)),
                        handed_over(std::move(curve.frames)), array(curve.end_frame));
}

/// Chords of turns reach 2 and no further.
void check_sizes(const std::vector<Vec3>& K, const Grid& grid, Measure measure) {
  if (measure != Measure::chord) return;
  for (int j = 0; j < grid.vertices(); ++j)
    require(grid.Δs(j) * K[j].norm() <= 2, "K[", j, "]: a chord of length ",
            grid.Δs(j) * K[j].norm(), "; no turn has one beyond 2, use more edges");
}

void bind_strains(py::module_& m) {
  m.def(
      "strains",
      [](const Array& h, const Array& r, const Array& q, const std::optional<Array>& start,
         const std::optional<Array>& end, const std::string& by, bool closed) {
        const Grid grid = grid_of(h, closed);
        const Measure how = measure(by);
        const auto curve = framed_curve(grid, r, q, start, end, how);
        auto out = [&] {
          const py::gil_scoped_release release;
          return strains(grid, curve, how);
        }();
        return py::make_tuple(handed_over(std::move(out.K)), handed_over(std::move(out.Γ)));
      },
      py::arg("edge_lengths"), py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
      py::arg("end_frame"), py::arg("measure"), py::arg("closed"));
  m.def(
      "reconstruct",
      [](const Array& h, const Array& K, const Array& Γ, const Array& r0, const Array& q0,
         const std::string& by) {
        const Grid grid = grid_of(h, false);
        const Strains<Spatial> given{vectors<3>(K, "K"), vectors<3>(Γ, "Gamma")};
        require_count(Eigen::Index(given.K.size()), grid.vertices(), "K", "one per vertex");
        require_count(Eigen::Index(given.Γ.size()), grid.edges(), "Gamma", "one per edge");
        const Measure how = measure(by);
        check_sizes(given.K, grid, how);
        return arrays(reconstruct<Spatial>(grid, given, vector3(r0, "position"),
                                           quaternion(q0, "frame"), how));
      },
      py::arg("edge_lengths"), py::arg("K"), py::arg("Gamma"), py::arg("position"),
      py::arg("frame"), py::arg("measure"));
}

void bind_conversions(py::module_& m) {
  m.def(
      "measured",
      [](const Array& angles, const std::string& by) {
        Vector out = numbers(angles, "angles");
        const Measure how = measure(by);
        for (double& θ : out) θ = measured(θ, how);
        return handed_over(std::move(out));
      },
      py::arg("angles"), py::arg("measure"));
  m.def(
      "bishop_curvature",
      [](const Array& κ, const Array& α) {
        const Vector curvature = numbers(κ, "curvature"), angles = numbers(α, "dihedral_angles");
        require_finite(curvature, "curvature");
        require_finite(angles, "dihedral_angles");
        require(angles.size() == curvature.size() || angles.size() == curvature.size() - 1,
                "dihedral_angles: expected one per edge for ", curvature.size(), " vertices, got ",
                angles.size());
        return computed([&] { return bishop_curvature(curvature, angles); });
      },
      py::arg("curvature"), py::arg("dihedral_angles"));
  m.def(
      "frenet_numbers",
      [](const Array& K) {
        const auto given = vectors<3>(K, "K");
        require(given.size() >= 2, "K: expected at least two vertices, got ", given.size());
        auto out = frenet_numbers(given);
        return py::make_tuple(handed_over(std::move(out.κ)), handed_over(std::move(out.α)));
      },
      py::arg("K"));
  m.def(
      "reconstruct_frenet",
      [](const Array& h, const Array& κ, const Array& τ, const Array& r0, const Array& q0,
         const std::string& by) {
        const Grid grid = grid_of(h, false);
        const Vector curvature = numbers(κ, "curvature"), torsion = numbers(τ, "torsion");
        require_finite(curvature, "curvature");
        require_finite(torsion, "torsion");
        require_count(curvature.size(), grid.vertices(), "curvature", "one per vertex");
        require_count(torsion.size(), grid.edges(), "torsion", "one per edge");
        const Measure how = measure(by);
        for (int j = 0; j < grid.edges() && how == Measure::chord; ++j)
          require(grid.h(j) * std::abs(torsion[j]) <= 2, "torsion[", j, "]: a chord of length ",
                  grid.h(j) * std::abs(torsion[j]), "; no turn has one beyond 2, use more edges");
        check_sizes(bishop_curvature(curvature, Vector()), grid, how);
        return arrays(reconstruct_frenet(grid, curvature, torsion, vector3(r0, "position"),
                                         quaternion(q0, "frame"), how));
      },
      py::arg("edge_lengths"), py::arg("curvature"), py::arg("torsion"), py::arg("position"),
      py::arg("frame"), py::arg("measure"));
}

void bind_framing(py::module_& m) {
  m.def(
      "adapted",
      [](const Array& frames, const Array& tangents, double limit) {
        auto q = quaternions(frames, "frames");
        const auto t = vectors<3>(tangents, "tangents");
        require_count(Eigen::Index(q.size()), Eigen::Index(t.size()), "frames", "one per edge");
        for (std::size_t j = 0; j < q.size(); ++j) {
          const double away = Turning(rotate(q[j], Vec3::UnitZ()), t[j]).angle();
          require(away <= limit, "frames[", j, "]: a3 is ", away,
                  " rad away from the edge; the third director must point along the curve");
          q[j] = adapted(q[j], t[j]);
        }
        return handed_over(std::move(q));
      },
      py::arg("frames"), py::arg("tangents"), py::arg("limit"));
  m.def(
      "twist_angles",
      [](const Array& h, const Array& r, const Array& q, const std::optional<Array>& start,
         const std::optional<Array>& end, bool closed) {
        const Grid grid = grid_of(h, closed);
        const auto curve = framed_curve(grid, r, q, start, end);
        return computed([&] { return twist_angles(grid, curve); });
      },
      py::arg("edge_lengths"), py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
      py::arg("end_frame"), py::arg("closed"));
  m.def(
      "vertex_frames",
      [](const Array& h, const Array& r, const Array& q, const std::optional<Array>& start,
         const std::optional<Array>& end, bool closed) {
        const Grid grid = grid_of(h, closed);
        const auto curve = framed_curve(grid, r, q, start, end);
        return computed([&] { return vertex_frames(grid, curve); });
      },
      py::arg("edge_lengths"), py::arg("positions"), py::arg("frames"), py::arg("start_frame"),
      py::arg("end_frame"), py::arg("closed"));
  m.def(
      "turned_about_tangents",
      [](const Array& frames, const Array& φ) {
        auto q = quaternions(frames, "frames");
        const Vector angles = numbers(φ, "angles");
        require_finite(angles, "angles");
        require_count(angles.size(), Eigen::Index(q.size()), "angles", "one per frame");
        return computed([&] { return turned_about_tangents(std::move(q), angles); });
      },
      py::arg("frames"), py::arg("angles"));
  m.def(
      "angles_about_tangents",
      [](const Array& from, const Array& to) {
        const auto a = quaternions(from, "from_frames"), b = quaternions(to, "frames");
        require_count(Eigen::Index(b.size()), Eigen::Index(a.size()), "frames", "one per edge");
        return computed([&] { return angles_about_tangents(a, b); });
      },
      py::arg("from_frames"), py::arg("frames"));
  m.def(
      "check_continued",
      [](const Array& frames) { check_continued(quaternions(frames, "frames")); },
      py::arg("frames"));
}

/// Values of any number of columns, (n, k), as columns of their own.
template <class F>
py::array_t<double> by_columns(const Array& values, Eigen::Index rows, const char* place, F&& f) {
  require(values.ndim() == 2, "values: expected an array of shape (n, k), got ", shape_of(values));
  require_count(values.shape(0), rows, "values", place);
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Table> in(values.data(), rows, values.shape(1));
  Table out;
  for (Eigen::Index k = 0; k < in.cols(); ++k) {
    const Vector column = in.col(k);
    const auto result = f(std::vector<double>(column.begin(), column.end()));
    if (k == 0) out.resize(Eigen::Index(result.size()), in.cols());
    out.col(k) = Eigen::Map<const Vector>(result.data(), out.rows());
  }
  const std::vector<py::ssize_t> shape{out.rows(), out.cols()};
  return handed_over(std::move(out), shape);
}

void bind_averages(py::module_& m) {
  m.def(
      "at_vertices",
      [](const Array& h, const Array& values, bool closed) {
        const Grid grid = grid_of(h, closed);
        return by_columns(values, grid.edges(), "one per edge",
                          [&](const std::vector<double>& x) { return at_vertices(grid, x); });
      },
      py::arg("edge_lengths"), py::arg("values"), py::arg("closed"));
  m.def(
      "at_centres",
      [](const Array& h, const Array& values, bool closed) {
        const Grid grid = grid_of(h, closed);
        return by_columns(values, grid.vertices(), "one per vertex",
                          [&](const std::vector<double>& x) { return at_centres(grid, x); });
      },
      py::arg("edge_lengths"), py::arg("values"), py::arg("closed"));
}

}  // namespace

void curve(py::module_& module) {
  auto m = module.def_submodule("curve", "Framed curves on the staggered grid.");
  bind_strains(m);
  bind_conversions(m);
  bind_framing(m);
  bind_averages(m);
}

}  // namespace pyrod::bind
