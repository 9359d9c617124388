// SPDX-License-Identifier: BSD-3-Clause
/// \file A rod as it is made, on one grid: stiffnesses and curvature of its cells and edges.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/arrays_on_grid.hpp>
#include <pyrod/scene/choice.hpp>
#include <pyrod/scene/rod_spec.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

namespace detail {

class RodMaker {
 public:
  RodMaker(const RodSpec& spec, const Vector& h)
      : spec_(spec),
        grid_(h),
        base_(spec.base),
        same_(h.size() == spec.base.size() && h == spec.base) {}

  RodOnGrid make() {
    if (spec_.arrays) return ArraysOnGrid(spec_, grid_, base_, same_).make();
    on_edges_ = sections();
    RodOnGrid out{{grid_, bending(), {}, curvature()}, {}, ModelKind::inextensible};
    for (const auto& c : on_edges_) {
      out.rod.stretching.emplace_back(c.GA1, c.GA2, c.EA);
      out.mass.push_back(c.mass_per_length);
      out.richest = std::min(out.richest, richest(out.rod.stretching.back()));
    }
    for (const int j : jumping_vertices()) add_jump(j, out.rod);
    return out;
  }

 private:
  static Vec3 bending_of(const Section& c) { return {c.EI1, c.EI2, c.GJ}; }
  const Vector& s() const { return grid_.arc_lengths(); }

  std::vector<Section> sections() const {
    const auto* list = std::get_if<std::vector<Section>>(&spec_.section);
    if (!list) return sampled(spec_.section, centres(s()), "section", "edge");
    require_count(Eigen::Index(list->size()), base_.edges(), "section", "one per edge");
    if (same_) return *list;
    std::vector<Section> out;
    for (const double at : centres(s())) out.push_back((*list)[std::size_t(edge_at(base_, at))]);
    return out;
  }

  /// Of the cells. Halves of two sections bend one after the other, so compliances add.
  std::vector<Vec3> bending() const {
    std::vector<Vec3> out;
    const int n = grid_.edges();
    if (const auto* one = std::get_if<Section>(&spec_.section))
      return std::vector<Vec3>(std::size_t(n + 1), bending_of(*one));
    if (is_function(spec_.section)) {
      for (const auto& c : sampled(spec_.section, s(), "section", "vertex"))
        out.push_back(bending_of(c));
      return out;
    }
    for (int j = 0; j <= n; ++j) {
      const Vec3 a = bending_of(on_edges_[std::size_t(std::max(j - 1, 0))]),
                 b = bending_of(on_edges_[std::size_t(std::min(j, n - 1))]);
      const double before = j == 0 ? 0 : grid_.h(j - 1), behind = j == n ? 0 : grid_.h(j);
      const Vec3 compliance = before * a.cwiseInverse() + behind * b.cwiseInverse();
      out.push_back((before + behind) * compliance.cwiseInverse());
    }
    return out;
  }

  std::vector<Vec3> curvature() const {
    const auto* list = std::get_if<std::vector<Vec3>>(&spec_.curvature);
    if (!list) return sampled(spec_.curvature, s(), "curvature", "vertex");
    require_count(Eigen::Index(list->size()), base_.edges() + 1, "curvature", "one per vertex");
    if (same_) return *list;
    return spec_.corners ? at_corners(*list, base_, grid_) : interpolated(*list, base_, s());
  }

  /// Inner vertices at which sections of a list differ, or functions may jump.
  std::vector<int> jumping_vertices() const {
    std::vector<double> places = steps(spec_);
    if (is_function(spec_.section) || is_function(spec_.curvature))
      places.insert(places.end(), spec_.marks.begin(), spec_.marks.end());
    std::vector<int> out;
    for (const double at : places) {
      const double before = at - 1e-9 * grid_.length();
      const int j = int(std::lower_bound(s().begin(), s().end(), before) - s().begin());
      if (j > 0 && j < grid_.edges()) out.push_back(j);
    }
    std::ranges::sort(out);
    out.erase(std::ranges::unique(out).begin(), out.end());
    return out;
  }

  /// Stiffness and curvature just before or behind vertex j.
  std::pair<Vec3, Vec3> side(int j, int to, const Rod<Spatial>& rod) const {
    const double at = grid_.s(j) + to * 1e-9 * grid_.length();
    const auto* section = std::get_if<2>(&spec_.section);
    const auto* K0 = std::get_if<2>(&spec_.curvature);
    const std::size_t edge = std::size_t(to < 0 ? j - 1 : j);
    return {bending_of(section ? (*section)(at) : on_edges_[edge]),
            K0 ? (*K0)(at) : rod.K0[std::size_t(j)]};
  }

  /// The cell of a vertex where something jumps has halves of either side.
  void add_jump(int j, Rod<Spatial>& rod) const {
    const auto [C, K] = side(j, -1, rod);
    const auto [D, L] = side(j, 1, rod);
    const auto differ = [](const Vec3& a, const Vec3& b) {
      return (a - b).lpNorm<Eigen::Infinity>() > 1e-6 * a.lpNorm<Eigen::Infinity>();
    };
    if (!differ(C, D) && !differ(K, L)) return;
    const double before = grid_.h(j - 1), behind = grid_.h(j);
    const Vec3 compliance = before * C.cwiseInverse() + behind * D.cwiseInverse();
    rod.bending[std::size_t(j)] = (before + behind) * compliance.cwiseInverse();
    rod.K0[std::size_t(j)] = (before * K + behind * L) / (before + behind);
    rod.jumps.push_back({j, C, K, D, L});
  }

  const RodSpec& spec_;
  Grid grid_, base_;
  bool same_;
  std::vector<Section> on_edges_;
};

}  // namespace detail

/// On the grid that it asks for, with every edge cut in so many; whatever its model is.
inline RodOnGrid made_on_grid(const RodSpec& spec, int parts = 1) {
  if (parts == 1) return detail::RodMaker(spec, spec.edge_lengths).make();
  Vector h(spec.edge_lengths.size() * parts);
  for (Eigen::Index j = 0; j < h.size(); ++j) h[j] = spec.edge_lengths[j / parts] / parts;
  return detail::RodMaker(spec, h).make();
}

/// The same in its model, as it is solved.
inline RodOnGrid on_grid(const RodSpec& spec, int parts = 1) {
  auto out = made_on_grid(spec, parts);
  out.rod = in_model(std::move(out.rod), spec.model.value_or(out.richest));
  return out;
}

}  // namespace pyrod
