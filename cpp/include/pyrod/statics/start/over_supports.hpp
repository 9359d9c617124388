// SPDX-License-Identifier: BSD-3-Clause
/// \file A rod over several supports: one start for all of its spans.
///
/// Where a support leaves the direction of the rod to it, neighbouring bows must fit each other.
/// Each such support may be passed on the level, upwards or downwards; the best combination is
/// found along the rod, span by span, by the energies of the bows between.
#pragma once

#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/statics/start/arch.hpp>
#include <pyrod/statics/start/bow.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace pyrod {

template <class Space>
class OverSupports {
 public:
  using Rotation = typename Space::Rotation;
  using Shape = Bow<Space>;
  using Anchor = typename Shape::Anchor;

  /// Whether the rod goes on over supports, with no more than a turn at rest from one to the next.
  static bool goes_on(const Rod<Space>& r, const std::vector<Anchor>& held) {
    if (held.size() < 2 || r.grid.closed()) return false;
    const bool hangs_over = (held.front().vertex > 0 && !held.front().clamped) ||
                            (held.back().vertex < r.edges() && !held.back().clamped);
    if (held.size() == 2 && !hangs_over) return false;
    for (std::size_t k = 1; k < held.size(); ++k) {
      Spin<Space> turn = Spin<Space>::Zero();
      for (int j = held[k - 1].vertex; j < held[k].vertex; ++j) turn += r.grid.Δs(j) * r.K0[j];
      if (turn.norm() > 2 * std::numbers::pi || (Space::spin == 1 && held[k].turns != 0))
        return false;
    }
    return true;
  }

  /// Where bows go: with the loads, else the way the rod is bent at rest, else the way it is
  /// softest.
  static Point<Space> up(const Rod<Space>& r, const Loads<Space>& loads,
                         const std::vector<Anchor>& held, const std::vector<Rotation>& frames) {
    Point<Space> sum = Point<Space>::Zero();
    double size = 0;
    for (std::size_t k = 1; k < held.size(); ++k) {
      const Point<Space> t = (held[k].position - held[k - 1].position).normalized();
      Point<Space> across = Point<Space>::Zero();
      for (int j = held[k - 1].vertex + 1; j < held[k].vertex; ++j)
        across += loads.force[j] - loads.force[j].dot(t) * t, size += loads.force[j].norm();
      sum += sum.dot(across) < 0 ? Point<Space>(-across) : across;
    }
    if (sum.norm() > 1e-6 * size) return sum.normalized();
    const int j = (held.front().vertex + held.back().vertex) / 2;
    const Rotation& middle = frames[std::min(j, r.edges() - 1)];
    const Point<Space> t = rotate(middle, axis<Space>());
    const Point<Space> bent = -Shape::lever(rotate_spin(middle, r.K0[j]), t);
    if (bent.norm() * r.grid.length() > 1e-6) return bent.normalized();
    return rotate(middle, Shape::soft_direction(r.bending[j]));
  }

  /// `first`: the frame at the first held point, but for its direction where that is free. `up`:
  /// where bows go, a direction. `level`: whether supports are passed on the level only.
  OverSupports(const Rod<Space>& rod, const Loads<Space>& loads, const std::vector<Anchor>& held,
               const Rotation& first, const Point<Space>& up, bool level)
      : rod_(rod), loads_(loads), held_(held), first_(first), level_(level) {
    for (std::size_t k = 0; k + 1 < held.size(); ++k) spans_.push_back(span(k));
    for (auto& span : spans_) span.axis = across(up, span.along);
    for (std::size_t k = 0; k < held.size(); ++k) passages_.push_back(passages(k));
  }

  /// Lays the frames of the edges between the first held point and the last; the frames there.
  std::vector<Rotation> lay(std::vector<Rotation>& frames) const {
    const std::vector<int> level(held_.size(), 0);
    const std::vector<Rotation> rough = carried(level);
    const Path path = best(rough, twists(rough));
    const std::vector<Rotation> at = carried(path.passages);
    const std::vector<double> ψ = twists(at);
    std::vector<Rotation> out;
    for (std::size_t k = 0; k < held_.size(); ++k) out.push_back(Shape::twisted(at[k], ψ[k]));
    for (std::size_t k = 0; k < spans_.size(); ++k) {
      const auto arch = this->arch(k, path.passages[k], path.passages[k + 1], path.sides[k]);
      arch.lay(rod_.grid, held_[k].vertex, held_[k + 1].vertex, arch.base(at[k]), ψ[k], ψ[k + 1],
               frames.begin() + held_[k].vertex);
    }
    return out;
  }

 private:
  /// Straight from one held point to the next.
  struct Straight {
    Point<Space> along;  ///< unit vector
    double length, reach;
    Spin<Space> axis = Spin<Space>::Zero();  ///< turns `along` to where bows go
  };

  /// Directions in which the rod may pass a held point, on the level first.
  using Passages = std::vector<Point<Space>>;

  struct Path {
    std::vector<int> passages, sides;
  };

  Straight span(std::size_t k) const {
    const auto &a = held_[k], &b = held_[k + 1];
    const double length = rod_.grid.s(b.vertex) - rod_.grid.s(a.vertex);
    Point<Space> chord = b.position - a.position;
    const double apart = chord.norm();
    if (apart < 1e-6 * length) chord = rotate(first_, axis<Space>());
    return {chord.normalized(), length, std::min(1., apart / length)};
  }

  static Spin<Space> across(Point<Space> up, const Point<Space>& along) {
    up -= up.dot(along) * along;
    if (up.norm() < 1e-6) up = Shape::any_across(along);
    return cross(along, Point<Space>(up.normalized()));
  }

  /// As steep as the flatter of the bows beside would be by itself.
  Passages passages(std::size_t k) const {
    if (held_[k].clamped) return {rotate(held_[k].frame, axis<Space>())};
    Point<Space> mean = Point<Space>::Zero();
    Spin<Space> axis = Spin<Space>::Zero();
    double slope = 1.9;
    const auto add = [&](std::size_t span, std::size_t other) {
      mean += spans_[span].along;
      axis = spans_[span].axis;
      slope = std::min(slope, Arch<Space>::slope(spans_[span].reach, held_[other].clamped));
    };
    if (k > 0) add(k - 1, k - 1);
    if (k + 1 < held_.size()) add(k, k + 1);
    if (mean.norm() < 1e-6) mean = spans_[std::min(k, spans_.size() - 1)].along;
    mean.normalize();
    if (level_) return {mean};
    const auto turned = [&](double angle) {
      return Point<Space>(rotate(exp(Spin<Space>(angle * axis)), mean));
    };
    return {mean, turned(slope), turned(-slope)};
  }

  Arch<Space> arch(std::size_t k, int from, int to, int side) const {
    const auto& span = spans_[k];
    return Arch<Space>(span.along, span.axis, span.reach, passages_[k][from], passages_[k + 1][to],
                       side);
  }

  /// The frames at the held points without any twist between them.
  std::vector<Rotation> carried(const std::vector<int>& passages) const {
    std::vector<Rotation> at{Shape::turned_towards(first_, passages_[0][passages[0]])};
    for (std::size_t k = 0; k < spans_.size(); ++k)
      at.push_back(arch(k, passages[k], passages[k + 1], 1).carried(at.back()));
    return at;
  }

  /// What twists the carried frames into those that are held, spread evenly between these.
  std::vector<double> twists(const std::vector<Rotation>& at) const {
    std::vector<double> ψ(at.size(), 0.);
    if constexpr (Space::spin == 3) {
      const std::vector<double> rest = twists_at_rest();
      int last = -1, turns = 0;
      for (int k = 0; k < int(at.size()); ++k) {
        turns += k == 0 ? 0 : held_[k].turns;
        const double before = last < 0 ? 0. : ψ[last], there = rest[k] - rest[std::max(last, 0)];
        ψ[k] = before + there;
        if (!held_[k].clamped) continue;
        const double held = twist_angle(at[k].conjugate() * held_[k].frame);
        const double missing =
            std::remainder(held - ψ[k], 2 * std::numbers::pi) + 2 * std::numbers::pi * turns;
        spread(missing, last, k, ψ);
        last = k, turns = 0;
      }
    }
    return ψ;
  }

  std::vector<double> twists_at_rest() const {
    std::vector<double> out{0.};
    for (std::size_t k = 0; k + 1 < held_.size(); ++k) {
      double sum = 0;
      for (int j = held_[k].vertex + 1; j < held_[k + 1].vertex; ++j)
        sum += rod_.grid.Δs(j) * rod_.K0[j].tail(1)[0];
      out.push_back(out.back() + sum);
    }
    return out;
  }

  /// Adds a twist that grows evenly from the held point `last` to `k`; all of it where no point
  /// before is clamped.
  void spread(double missing, int last, int k, std::vector<double>& ψ) const {
    const auto s = [&](int i) { return rod_.grid.s(held_[i].vertex); };
    for (int i = last + 1; i <= k; ++i)
      ψ[i] += last < 0 ? missing : missing * (s(i) - s(last)) / (s(k) - s(last));
  }

  /// The least energy on the way to each passage of each held point, and back along the best.
  Path best(const std::vector<Rotation>& at, const std::vector<double>& ψ) const {
    struct Step {
      double energy;
      int from, side;
    };
    std::vector<std::vector<Step>> steps{{}};
    steps[0].assign(passages_[0].size(), {0., -1, 0});
    std::vector<Rotation> room(rod_.edges()), bases;
    for (std::size_t k = 0; k < spans_.size(); ++k) bases.push_back(arch(k, 0, 0, 1).base(at[k]));
    for (std::size_t k = 0; k < spans_.size(); ++k) {
      steps.emplace_back(passages_[k + 1].size(),
                         Step{std::numeric_limits<double>::infinity(), 0, 1});
      for (int to = 0; to < int(passages_[k + 1].size()); ++to)
        for (int from = 0; from < int(passages_[k].size()); ++from)
          for (const int side : {1, -1}) {
            const double sum = steps[k][from].energy +
                               energy(k, arch(k, from, to, side), bases[k], ψ[k], ψ[k + 1], room);
            if (sum < steps[k + 1][to].energy) steps[k + 1][to] = {sum, from, side};
          }
    }
    return traced(steps);
  }

  template <class Steps>
  static Path traced(const Steps& steps) {
    const auto& last = steps.back();
    int at = int(std::min_element(last.begin(), last.end(),
                                  [](auto& a, auto& b) { return a.energy < b.energy; }) -
                 last.begin());
    Path path{{at}, {}};
    for (std::size_t k = steps.size() - 1; k > 0; --k) {
      path.sides.insert(path.sides.begin(), steps[k][at].side);
      path.passages.insert(path.passages.begin(), at = steps[k][at].from);
    }
    return path;
  }

  /// Of bending and twisting, and of the dead loads against the chord.
  double energy(std::size_t k, const Arch<Space>& arch, const Rotation& base, double from,
                double to, std::vector<Rotation>& room) const {
    const Grid& grid = rod_.grid;
    const int a = held_[k].vertex, b = held_[k + 1].vertex;
    const auto bent = [&](int j, double cell, const Rotation& before, const Rotation& behind) {
      const Spin<Space> u = log(principal(before.conjugate() * behind));
      const Spin<Space> ΔK = u / cell - rod_.K0[j];
      return cell / 2 * ΔK.dot(rod_.bending[j].cwiseProduct(ΔK));
    };
    arch.lay(grid, a, b, base, from, to, room.begin());
    double sum = bent(a, grid.h(a) / 2, Shape::twisted(arch.start(base), from), room[0]) +
                 bent(b, grid.h(b - 1) / 2, room[b - a - 1], Shape::twisted(arch.end(base), to));
    Point<Space> r = Point<Space>::Zero(), at_end = r;  // what loads would do at the end
    for (int j = a; j < b; ++j) {
      if (j > a) {
        sum += bent(j, grid.Δs(j), room[j - a - 1], room[j - a]) - loads_.force[j].dot(r);
        at_end += loads_.force[j] * (grid.s(j) - grid.s(a)) / spans_[k].length;
      }
      r += grid.h(j) * rotate(room[j - a], axis<Space>());
    }
    return sum + at_end.dot(r);
  }

  const Rod<Space>& rod_;
  const Loads<Space>& loads_;
  const std::vector<Anchor>& held_;
  Rotation first_;
  bool level_;
  std::vector<Straight> spans_;
  std::vector<Passages> passages_;
};

}  // namespace pyrod
