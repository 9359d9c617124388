// SPDX-License-Identifier: BSD-3-Clause
/// \file What the edges of a span say: stretch, section forces, and positions one after another.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/extremes.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// r_j = r_{j-1} + h R Γ, Linn (50), in one pass. See `Recovery` for the stride.
template <class Space>
class EdgesOfSpan {
 public:
  /// `load`: on the vertices of the rod; `sections`: the section forces of all edges.
  EdgesOfSpan(const NetworkProblem<Space>& problem, const Span<Space>& span, int stride,
              const std::vector<Point<Space>>& load, const std::vector<Point<Space>>& sections)
      : problem_(problem),
        layout_(problem.layout()),
        span_(span),
        load_(load),
        sections_(sections),
        stride_(stride) {}

  /// From the position of the start if that is given, else back from that of the end.
  void fill(RodSolution<Space>& s, const Point<Space>* start, const Point<Space>& end,
            Extremes<Space>& extremes) {
    walk(s, extremes);
    start_ = start ? *start : Point<Space>(end - reach_);
    end_ = start_ + reach_;
    for (int j = span_.first; j <= span_.last; j += stride_)
      s.curve.positions[j / stride_] += start_;
    if (stride_ > 1) s.load_moment += cross(start_, acted_);
  }

  const Point<Space>& start() const { return start_; }
  const Point<Space>& end() const { return end_; }

 private:
  /// From the start, so that far from the origin rounding does not add up.
  void walk(RodSolution<Space>& s, Extremes<Space>& extremes) {
    Point<Space> r = Point<Space>::Zero();
    const auto& rod = layout_.network().rods[span_.rod];
    const auto& loads = layout_.network().loads[span_.rod];
    s.curve.positions[span_.first / stride_] = r;
    act(s, r, span_.first);
    Point<Space> Γ_before = axis<Space>(), n_before = Point<Space>::Zero(), share_before = n_before;
    for (int j = span_.first; j < span_.last; ++j) {
      const int e = layout_.edge(span_.rod, j);
      const Point<Space>& n = sections_[e];
      const Mat<Space::dim> R = matrix(s.curve.frames[j]);
      const Point<Space> N = R.transpose() * n, strain = problem_.compliance(e).cwiseProduct(N),
                         Γ = axis<Space>() + strain, share = loads.share(j, s.curve.frames[j]);
      s.stretch_shear_energy += rod.grid.h(j) / 2 * strain.dot(N);
      if (stride_ == 1)
        s.force[j] = n, s.material_force[j] = N, s.strains.Γ[j] = Γ;
      else if (j % stride_ == stride_ / 2)
        s.force[j / stride_] = (n_before + n) / 2, s.strains.Γ[j / stride_] = (Γ_before + Γ) / 2;
      extremes.set_force(j, j == span_.first
                                ? Point<Space>(n + share)
                                : Point<Space>((n_before - share_before + n + share) / 2));
      r += rod.grid.h(j) * (R * Γ);
      if ((j + 1) % stride_ == 0) s.curve.positions[(j + 1) / stride_] = r;
      if (j + 1 < span_.last || span_.last == rod.edges()) act(s, r, j + 1);
      Γ_before = Γ, n_before = n, share_before = share;
    }
    reach_ = r;
  }

  /// The moment of what acts on vertex j.
  void act(RodSolution<Space>& s, const Point<Space>& r, int j) {
    if (stride_ == 1) return;
    s.load_moment += cross(r, load_[j]);
    acted_ += load_[j];
  }

  const NetworkProblem<Space>& problem_;
  const Layout<Space>& layout_;
  const Span<Space>& span_;
  const std::vector<Point<Space>>&load_, &sections_;
  int stride_;
  Point<Space> start_, end_, reach_, acted_ = Point<Space>::Zero();
};

}  // namespace pyrod
