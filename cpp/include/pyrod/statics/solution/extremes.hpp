// SPDX-License-Identifier: BSD-3-Clause
/// \file The largest curvature, section force and moment of a rod, between its vertices too.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/solve/peak.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>

#include <cmath>
#include <cstddef>
#include <vector>

namespace pyrod {

/// Squared norms at all vertices, just behind them.
template <class Space>
class Extremes {
 public:
  explicit Extremes(const Rod<Space>& rod) : rod_(rod) {
    for (auto* list : {&K_, &moment_}) list->reserve(std::size_t(rod.edges() + 1));
    force_.resize(std::size_t(rod.edges() + 1));
  }

  /// Of the cell of the next vertex: its turn u, and M = C (u/Δs − K⁰). Seen from the middle of the
  /// turn, the moment that the cell transmits is that of theory (23), but for u⁴.
  /// `others`: what else than the diagonal law transmits.
  void add_cell(const Spin<Space>& u, const Spin<Space>& M,
                const Spin<Space>& others = Spin<Space>::Zero()) {
    const std::size_t j = K_.size();
    const auto seen = [&u](const Spin<Space>& moment) {
      Spin<Space> out = moment;
      if constexpr (Space::spin == 3) out -= u.cross(u.cross(moment)) / 24;
      return out;
    };
    const Spin<Space> own = seen(M);
    K_.push_back((rod_.K0[j] + own.cwiseQuotient(rod_.bending[j])).squaredNorm());
    moment_.push_back(others.isZero(0) ? own.squaredNorm() : seen(M + others).squaredNorm());
  }
  /// At an inner vertex; what is told at the ends takes the place of theirs.
  void set_force(int j, const Point<Space>& n) { force_[std::size_t(j)] = n.squaredNorm(); }

  /// `s`: told at every `stride`-th vertex, with both sides of those where something jumps.
  Largest largest(const RodSolution<Space>& s, int stride) {
    for (const int J : {0, rod_.edges() / stride}) {
      const Spin<Space> M = rotate_spin(s.vertex_frames[J].conjugate(), s.moment[J]);
      const Spin<Space> K =
          s.backbone_force.empty() ? rod_.sides(J * stride).K_behind(M) : s.strains.K[J];
      take(J * stride, K, s.vertex_force[J], s.moment[J]);
    }
    for (const auto& b : s.before)
      take(b.vertex * stride, s.strains.K[b.vertex], s.vertex_force[b.vertex], s.moment[b.vertex]);
    return {highest(K_, s, stride, [](const auto& b) { return b.K.squaredNorm(); }),
            highest(force_, s, stride, [](const auto& b) { return b.force.squaredNorm(); }),
            highest(moment_, s, stride, [](const auto& b) { return b.moment.squaredNorm(); })};
  }

 private:
  void take(int j, const Spin<Space>& K, const Point<Space>& n, const Spin<Space>& m) {
    K_[j] = K.squaredNorm(), force_[j] = n.squaredNorm(), moment_[j] = m.squaredNorm();
  }

  template <class Square>
  double highest(const std::vector<double>& squares, const RodSolution<Space>& s, int stride,
                 const Square& square_before) const {
    double best = 0;
    int first = 0;
    const auto look = [&](int last, double at_last) {
      const auto value = [&](int j) { return j == last ? at_last : squares[std::size_t(j)]; };
      best = std::max(best, Peak(rod_.grid.arc_lengths(), value, first, last).highest());
      first = last;
    };
    for (const auto& b : s.before) look(b.vertex * stride, square_before(b));
    look(rod_.edges(), squares.back());
    return std::sqrt(best);
  }

  const Rod<Space>& rod_;
  std::vector<double> K_, force_, moment_;
};

}  // namespace pyrod
