// SPDX-License-Identifier: BSD-3-Clause
/// \file A rod as it is made, on one grid: stiffnesses and curvature of its cells and edges.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/along.hpp>
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

/// A discrete rod, and the masses per length of its edges.
struct RodOnGrid {
  Rod<Spatial> rod;
  std::vector<double> mass;
  ModelKind richest;  ///< that its finite stiffnesses allow
};

namespace detail {

class RodMaker {
 public:
  RodMaker(const RodSpec& spec, const Vector& h)
      : spec_(spec),
        grid_(h),
        base_(spec.base),
        same_(h.size() == spec.base.size() && h == spec.base) {}

  RodOnGrid make() {
    on_edges_ = sections();
    RodOnGrid out{{grid_, bending(), {}, curvature()}, {}, ModelKind::inextensible};
    for (const auto& c : on_edges_) {
      out.rod.stretching.emplace_back(c.GA1, c.GA2, c.EA);
      out.mass.push_back(c.mass_per_length);
      const auto allowed = !std::isinf(c.GA1)  ? ModelKind::cosserat
                           : !std::isinf(c.EA) ? ModelKind::extensible
                                               : ModelKind::inextensible;
      out.richest = std::min(out.richest, allowed);
    }
    for (const int j : jumping_vertices()) add_jump(j, out.rod);
    return out;
  }

 private:
  static Vec3 bending_of(const Section& c) { return {c.EI1, c.EI2, c.GJ}; }
  const Vector& s() const { return grid_.arc_lengths(); }

  /// The edge of the base grid that the arc length is on.
  int base_edge(double at) const {
    const auto& ends = base_.arc_lengths();
    const auto behind = std::upper_bound(ends.begin(), ends.end(), at) - ends.begin();
    return std::clamp(int(behind) - 1, 0, base_.edges() - 1);
  }

  std::vector<Section> sections() const {
    const auto* list = std::get_if<std::vector<Section>>(&spec_.section);
    if (!list) return sampled(spec_.section, centres(s()), "section", "edge");
    require_count(Eigen::Index(list->size()), base_.edges(), "section", "one per edge");
    if (same_) return *list;
    std::vector<Section> out;
    for (const double at : centres(s())) out.push_back((*list)[std::size_t(base_edge(at))]);
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
    return spec_.corners ? at_corners(*list) : interpolated(*list);
  }

  std::vector<Vec3> interpolated(const std::vector<Vec3>& given) const {
    std::vector<Vec3> out;
    for (const double at : s()) {
      const int j = base_edge(at);
      const double part = std::clamp((at - base_.s(j)) / base_.h(j), 0., 1.);
      out.push_back((1 - part) * given[std::size_t(j)] + part * given[std::size_t(j) + 1]);
    }
    return out;
  }

  /// Curvature whose turns, those of the polygon, are all at its vertices.
  std::vector<Vec3> at_corners(const std::vector<Vec3>& given) const {
    std::vector<Vec3> out(std::size_t(grid_.vertices()), Vec3::Zero());
    const Vector middle = centres(s());
    for (int j = 0; j < base_.vertices(); ++j) {
      const auto at = std::lower_bound(middle.begin(), middle.end(), base_.s(j)) - middle.begin();
      out[std::size_t(at)] = given[std::size_t(j)] * (base_.Δs(j) / grid_.Δs(int(at)));
    }
    return out;
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

/// Lengths of edges with more vertices; within 1e-9 of an edge's length of a vertex there is one.
inline Vector cut(const Vector& h, const std::vector<double>& at) {
  const Grid grid(h);
  std::vector<double> s(grid.arc_lengths().begin(), grid.arc_lengths().end());
  const std::size_t there = s.size();
  for (const double place : at) {
    const auto behind = std::upper_bound(s.begin(), s.begin() + std::ptrdiff_t(there), place);
    const int j = std::clamp(int(behind - s.begin()) - 1, 0, grid.edges() - 1);
    const double part = (place - grid.s(j)) / grid.h(j);
    const auto is_there = [&](double other) { return std::abs(other - place) <= 1e-9 * grid.h(j); };
    const bool told = std::any_of(s.begin() + std::ptrdiff_t(there), s.end(), is_there);
    if (part > 1e-9 && part < 1 - 1e-9 && !told) s.push_back(place);
  }
  if (s.size() == there) return h;
  std::ranges::sort(s);
  s.erase(std::ranges::unique(s).begin(), s.end());
  Vector out(Eigen::Index(s.size()) - 1);
  for (Eigen::Index j = 0; j < out.size(); ++j) out[j] = s[std::size_t(j) + 1] - s[std::size_t(j)];
  return out;
}

/// About as many edges, equal between the breaks and at least two there.
inline Vector graded(double length, const std::vector<double>& breaks, int edges) {
  std::vector<double> h;
  double from = 0;
  const auto piece = [&](double to) {
    const int count = std::max(2, int(std::lrint(edges * (to - from) / length)));
    h.insert(h.end(), std::size_t(count), (to - from) / count);
    from = to;
  };
  for (const double s : breaks) piece(s);
  piece(length);
  return Eigen::Map<const Vector>(h.data(), Eigen::Index(h.size()));
}

}  // namespace detail

/// On the grid that it asks for, with every edge cut in so many.
inline RodOnGrid on_grid(const RodSpec& spec, int parts = 1) {
  Vector h(spec.edge_lengths.size() * parts);
  for (Eigen::Index j = 0; j < h.size(); ++j) h[j] = spec.edge_lengths[j / parts] / parts;
  auto out = detail::RodMaker(spec, h).make();
  out.rod = in_model(std::move(out.rod), spec.model.value_or(out.richest));
  return out;
}

/// The same rod with vertices at the arc lengths [m]. Where the solver chooses the grid, they are
/// kept.
inline RodSpec with_vertices(RodSpec spec, const std::vector<double>& at) {
  const Grid grid(spec.edge_lengths);
  for (const double s : at) grid.on_rod(s);
  if (is_function(spec.section) || is_function(spec.curvature))
    spec.marks.insert(spec.marks.end(), at.begin(), at.end());
  if (!spec.chooses) {
    spec.edge_lengths = detail::cut(spec.edge_lengths, at);
    return spec;
  }
  const double length = spec.length(), near = 1e-9 * length;
  const std::size_t before = spec.kept.size();
  for (const double s : at) {
    const auto is = [&](double other) { return std::abs(other - s) <= near; };
    if (!is(0) && !is(length) && std::ranges::none_of(spec.kept, is)) spec.kept.push_back(s);
  }
  if (spec.kept.size() == before) return spec;
  std::ranges::sort(spec.kept);
  spec.edge_lengths = detail::graded(length, spec.kept, spec.edges());
  return spec;
}

}  // namespace pyrod
