// SPDX-License-Identifier: BSD-3-Clause
/// \file How what a rod is made of is made.
#pragma once

#include <pyrod/core/definition.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/framing.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/scene/rod_spec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

PYROD_DEFINITION double RodSpec::length() const { return Grid(edge_lengths).length(); }

PYROD_DEFINITION RodSpec RodSpec::placed(const Placement<Spatial>& at) const {
  require_rotation(at.frame, "frame");
  require_finite(at.position, "position");
  RodSpec out = *this;
  out.placement = at;
  return out;
}

namespace detail {

PYROD_DEFINITION std::vector<double> steps(const RodSpec& spec) {
  std::vector<double> out;
  const auto* list = std::get_if<std::vector<Section>>(&spec.section);
  const Grid base(spec.base);
  for (std::size_t i = 1; list && i < std::min(list->size(), std::size_t(base.edges())); ++i)
    if ((*list)[i] != (*list)[i - 1]) out.push_back(base.s(int(i)));
  return out;
}

inline constexpr double most_edges = 1e8;  // their unknowns are counted in 32 bits

PYROD_DEFINITION double natural_edges(double length, const Along<Vec3>& curvature) {
  require(std::isfinite(length) && length > 0, "length: must be positive, got ", length);
  require(curvature.index() != 1,
          "curvature: one per vertex needs edges; give their number, or a function");
  double K = 0;
  for (const auto& one : sampled(curvature, Vector::LinSpaced(257, 0, length), "curvature", "")) {
    require(one.allFinite(), "curvature: expected finite numbers, got ", one.transpose());
    K = std::max(K, one.norm());
  }
  constexpr double turn = 0.4;  // [rad], the most from edge to edge
  return std::max(16., 2 * std::ceil(length * K / turn / 2));
}

}  // namespace detail

PYROD_DEFINITION RodSpec precurved(const Vector& edge_lengths, const Along<Section>& section,
                                   const Along<Vec3>& curvature, std::optional<ModelKind> model) {
  RodSpec out{section, curvature, edge_lengths, edge_lengths};
  out.model = model;
  return out;
}

PYROD_DEFINITION RodSpec precurved(double length, std::optional<int> edges,
                                   const Along<Section>& section, const Along<Vec3>& curvature,
                                   std::optional<ModelKind> model) {
  const double n = edges ? *edges : detail::natural_edges(length, curvature);
  require(edges || n <= detail::most_edges, "curvature: the rod at rest turns so much that ", n,
          " edges would be needed");
  require(n <= detail::most_edges, "edges: must be at most ", detail::most_edges, ", got ", n);
  auto out = precurved(Grid::uniform(length, int(n)).edge_lengths(), section, curvature, model);
  out.chooses = !edges;
  if (out.chooses) out.kept = detail::steps(out);  // sections keep their ends on any grid
  return out;
}

PYROD_DEFINITION RodSpec discrete(const Vector& edge_lengths, RodArrays arrays,
                                  std::vector<Vec3> K0, ModelKind model) {
  const int n = Grid(edge_lengths).edges();
  require_count(Eigen::Index(arrays.bending.size()), n + 1, "bending", "one per vertex");
  require_count(Eigen::Index(arrays.stretching.size()), n, "stretching", "one per edge");
  require_count(Eigen::Index(K0.size()), n + 1, "K0", "one per vertex");
  if (arrays.mass.empty()) arrays.mass.assign(std::size_t(n), 0);
  require_count(Eigen::Index(arrays.mass.size()), n, "mass", "one per edge");
  auto out = precurved(edge_lengths, std::vector<Section>{}, std::move(K0), model);
  out.arrays = std::make_shared<const RodArrays>(std::move(arrays));
  return out;
}

PYROD_DEFINITION RodSpec straight(double length, std::optional<int> edges,
                                  const Along<Section>& section, std::optional<ModelKind> model) {
  return precurved(length, edges, section, Vec3(0, 0, 0), model);
}

PYROD_DEFINITION RodSpec from_curve(const std::vector<Vec3>& positions,
                                    std::vector<Quaternion> frames, const Along<Section>& section,
                                    std::optional<ModelKind> model) {
  const int n = int(positions.size()) - 1;
  require(n > 0, "positions: expected two vertices or more, got ", n + 1);
  require_frames(frames, n, "frames");
  Vector h(n);
  for (int j = 0; j < n; ++j) {
    const Vec3 edge = positions[j + 1] - positions[j];
    require(edge.allFinite() && edge.norm() > 0, "positions[", j + 1,
            "]: neighbours must not coincide, got ", positions[j + 1].transpose(), " twice");
    h[j] = edge.norm();
    const Vec3 t = edge / h[j], a3 = rotate(frames[j], Vec3::UnitZ());
    const double off = std::atan2(a3.cross(t).norm(), a3.dot(t));
    require(off <= 0.5, "frames[", j, "]: its a3 is ", off,
            " rad off the edge, more than 0.5; give frames whose a3 is along the curve");
    frames[j] = adapted(frames[j], t);
  }
  check_continued(frames);
  frames = continued(std::move(frames));
  const Grid grid(h);
  std::vector<Vec3> K(std::size_t(n + 1), Vec3::Zero());
  for (int j = 1; j < n; ++j) K[j] = log(frames[j - 1].conjugate() * frames[j]) / grid.Δs(j);
  if (n > 1) K.front() = K[1], K.back() = K[std::size_t(n) - 1];
  auto out = precurved(h, section, K, model);
  out.corners = true;
  out.placement = {positions[0], frames[0] * exp(Vec3(-h[0] / 2 * K[0]))};
  return out;
}

}  // namespace pyrod
