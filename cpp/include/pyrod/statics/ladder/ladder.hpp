// SPDX-License-Identifier: BSD-3-Clause
/// \file The accuracy ladder: equilibria on ever finer grids, each started from the one below, and
/// what they tend to, until the error wanted is reached (docs/theory.md, "The ladder").
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/solve/extrapolation.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/ladder/error_scales.hpp>
#include <pyrod/statics/ladder/free_turn.hpp>
#include <pyrod/statics/ladder/ladder_scene.hpp>
#include <pyrod/statics/ladder/rung.hpp>
#include <pyrod/statics/solution/quantity.hpp>
#include <pyrod/statics/solution/reached.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/solution.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace pyrod {

class Ladder {
 public:
  /// tolerance: largest relative error wanted of vertices and sums. most_edges: of all rods
  /// together on the finest grid; three levels are climbed in any case.
  Ladder(LadderScene scene, double tolerance, int most_edges)
      : scene_(std::move(scene)), tolerance_(tolerance), most_edges_(most_edges) {
    require(tolerance > 0 && tolerance <= 0.1, "tol: must lie in (0, 0.1], got ", tolerance);
    double stiffness = 0, count = 0;
    for (const auto& rod : scene_.rods) {
      edges_ += rod.edges();
      longest_ = std::max(longest_, rod.edges());
      length_ = std::max(length_, rod.grid.length());
      for (const auto& C : rod.bending) stiffness += std::log(C.maxCoeff()), ++count;
    }
    force_ = std::exp(stiffness / count) / (length_ * length_);
  }

  Climbed climb() {
    bool from_below = false;
    for (int level = 0;; ++level) {
      solution_ = scene_.solve(level, from_below, step_tolerance());
      note_record();
      if (solution_.status == Status::interrupted) return finished(level, Ended::interrupted);
      if (solution_.converged()) {
        add(1 << level);
        judge(level);
        if (best_.error <= tolerance_) return finished(level, Ended::reached);
      } else if (best_.level >= 0) {
        return finished(level, Ended::failed);
      } else {
        forget();
      }
      from_below = solution_.converged();
      if (const auto ended = exhausted(level)) return finished(level, *ended);
    }
  }

 private:
  /// The best that the rungs said so far.
  struct Best {
    double error = std::numeric_limits<double>::infinity();
    Extrapolated vertices;
    int level = -1;
    std::size_t rungs = 0;  ///< that it is from
  };

  /// Newton's steps s are followed by such of C s², and C has been seen: the last step may be so
  /// large that what follows is nothing beside rounding, and the error wanted.
  double step_tolerance() const {
    if (quadratic_ == 0) return 1e-8;
    const double left = std::min(1e-13, 0.01 * tolerance_);
    const double most = std::min(1e-4, left / soft_left());
    return std::clamp(std::sqrt(left / quadratic_), 1e-12, std::max(most, 1e-12));
  }

  /// The part of a step along a soft mode that the next one has still to go; where it is neutral,
  /// nothing tells where it ends.
  double soft_left() const { return solution_.neutral ? 0 : solution_.softness.left(); }

  /// Along a motion that costs nothing small steps are rounding, and tell nothing of C.
  void note_record() {
    const auto& steps = solution_.record;
    const double least = solution_.neutral ? 1e-3 : 0;
    for (std::size_t i = 1; i < steps.size(); ++i) {
      const double s = steps[i - 1].step, next = steps[i].step;
      if (s > least && s < 0.1 && steps[i - 1].fraction == 1 && next > 1e-11)
        quadratic_ = std::max(quadratic_, next / (s * s));
    }
    auto& all = record_;
    all.insert(all.end(), solution_.record.begin(), solution_.record.end());
    descents_ += solution_.descents;
    load_steps_ += solution_.load_steps;
  }

  /// An equilibrium of another kind than those below begins the ladder anew; so does one that tells
  /// jumps at other vertices.
  void add(int stride) {
    for (std::size_t i = 0; i < solution_.rods.size(); ++i)
      take_curvatures(solution_.rods[i], scene_.rods[i]);
    const bool other = !rungs_.empty() && !rungs_.back().same_places(solution_.rods);
    if (solution_.descents > 0 || solution_.index != index_ || other) forget();
    index_ = solution_.index;
    const Rung* before = rungs_.empty() ? nullptr : &rungs_.back();
    rungs_.push_back({std::move(solution_), stride, before});
    if (rungs_.size() > 1 && solution_.neutral)
      undo_free_turn(rungs_.back(), rungs_[rungs_.size() - 2], solution_.mode);
    numbers_.push_back(rungs_.back().vertices());
  }

  void forget() {
    rungs_.clear();
    numbers_.clear();
    best_ = {};
  }

  void judge(int level) {
    if (rungs_.size() < 3) return;
    const auto all = scales();
    auto found = extrapolated(all);
    all.restore(found.errors, 0);
    order_ = found.order;
    add_soft_errors(found.errors, all);
    const double error = all.judged(found.errors);
    if (error > best_.error) return;
    best_ = {error, std::move(found), level, rungs_.size()};
  }

  /// Together; or if some do not converge as they should, as frames in a layer thinner than the
  /// edges, each quantity by itself.
  Extrapolated extrapolated(const ErrorScales& all) const {
    const auto rows = rungs_[0].vertex_rows();
    const auto of = [&](std::vector<Row> some) {
      return extrapolation(numbers_, std::move(some), all, 0, vertex_quantities,
                           rungs_.back().one_axis)
          .result();
    };
    auto found = of(rows);
    if (found.regular) return found;
    for (int q = 0; q < vertex_quantities; ++q) {
      std::vector<Row> own;
      std::copy_if(rows.begin(), rows.end(), std::back_inserter(own),
                   [q](const Row& row) { return row.quantity == q; });
      if (own.empty()) continue;
      const auto alone = of(own);
      if (!alone.regular) continue;
      for (const auto& row : own)
        found.values.segment(row.first, row.width) = alone.values.segment(row.first, row.width);
      found.errors[std::size_t(q)] = alone.errors[std::size_t(q)];
    }
    return found;
  }

  /// Of results without what is proportional to h, if corners make such, theory (27).
  Extrapolation extrapolation(const std::vector<Vector>& numbers, std::vector<Row> rows,
                              const ErrorScales& all, int first, int count, bool even) const {
    Judgement judgement{std::move(rows), all.levelled(first, count), even, all.noise};
    if (scene_.corners && !rungs_.back().one_axis && numbers.size() > 1)
      return {from_second_order(numbers), std::move(judgement)};
    return {numbers, std::move(judgement)};
  }

  /// How far along a soft mode the finest grid may be from its equilibrium: differences of grids,
  /// each of which errs as much, tell its order only. Of the energy it is a square.
  void add_soft_errors(std::vector<double>& errors, const ErrorScales& all) const {
    const auto& soft = solution_.softness;
    if (!soft.soft() || solution_.record.empty()) return;
    const double open = solution_.neutral ? 0 : soft.drift / 8;  // else it is undone as a motion
    const double turn = open + 2 * solution_.record.back().step * soft.left();
    const auto add = [&](Quantity what, double size) {
      auto& error = errors[std::size_t(what)];
      error += std::min(size, 2 * std::max(error - all.noise, 0.) + all.noise / 2);
    };
    const auto of = [&](Quantity what) { return all.size[std::size_t(what)]; };
    for (const auto what : {Quantity::positions, Quantity::frames}) add(what, turn);
    for (const auto what : {Quantity::curvatures, Quantity::moments, Quantity::reaction_moments})
      add(what, turn * std::max(1., soft.bend / of(Quantity::curvatures)));
    for (const auto what : {Quantity::forces, Quantity::reactions})
      add(what, turn * soft.push / of(what));
  }

  static std::vector<Vector> from_second_order(const std::vector<Vector>& results) {
    std::vector<Vector> out;
    for (std::size_t k = 1; k < results.size(); ++k) out.push_back(2 * results[k] - results[k - 1]);
    return out;
  }

  /// What the rungs up to the best one say of edges.
  Extrapolated judge_edges() const {
    std::vector<Vector> edges;
    for (std::size_t i = 0; i < best_.rungs; ++i)
      if (rungs_[i].stride > 1) edges.push_back(rungs_[i].edges());
    const auto all = scales();
    auto edge = extrapolation(edges, rungs_[0].edge_rows(), all, vertex_quantities, edge_quantities,
                              rungs_[best_.rungs - 1].one_axis);
    auto found = best_.vertices.regular ? edge.trusted() : edge.result();
    all.restore(found.errors, vertex_quantities);
    return found;
  }

  ErrorScales scales() const {
    return {rungs_.back(), length_, force_, solution_.rounding, noise()};
  }

  /// Relative rounding errors on the finest grid, as observed.
  double noise() const {
    return 16 * std::numeric_limits<double>::epsilon() * longest_ * rungs_.back().stride;
  }

  /// At most_edges, or where levels are no better than one before: by rounding, which along a
  /// motion that costs next to nothing is large.
  std::optional<Ended> exhausted(int level) const {
    const int worse = best_.level < 0 ? 0 : level - best_.level;
    const bool rounding = (worse > 1 && best_.error < 1e-8) || (worse > 3 && best_.error < 1e-4);
    if (level >= 2 && rounding) return Ended::rounding;
    if (level >= 2 && edges_ > (most_edges_ >> (level + 1))) return Ended::edges;
    if (scene_.has_time && !scene_.has_time({level + 1, edges_ << level, best_.error}))
      return Ended::time;
    return std::nullopt;
  }

  Climbed finished(int level, Ended ended) {
    Climbed out;
    out.reached.errors.fill(std::numeric_limits<double>::infinity());
    if (rungs_.empty()) rungs_.emplace_back(std::move(solution_), 1 << level, nullptr);
    if (best_.level >= 0) tell_best(out.reached);
    out.reached.order = order_;
    out.reached.levels = level + 1;
    out.reached.edges = edges_ << level;
    out.reached.ended = ended;
    finish(rungs_.back());
    if (ended == Ended::failed || (solution_.converged() && !(best_.error <= tolerance_)))
      solution_.status = Status::not_accurate;
    out.solution = std::move(solution_);
    return out;
  }

  /// Puts what the best rungs say into the last.
  void tell_best(Reached& out) {
    const auto edges = judge_edges();
    const auto sizes = scales().size;
    out.regular = best_.vertices.regular;
    rungs_.back().set(best_.vertices.values, edges.values);
    std::ranges::copy(best_.vertices.errors, out.errors.begin());
    std::ranges::copy(edges.errors, out.errors.begin() + vertex_quantities);
    out.errors[std::size_t(Quantity::extremes)] =
        tell_extremes({rungs_.data(), best_.rungs}, sizes, noise(), rungs_.back());
  }

  /// Puts the rung in the place of the finest grid, with what follows from its numbers.
  void finish(Rung& rung) {
    for (std::size_t i = 0; i < rung.rods.size(); ++i) complete(rung.rods[i], i);
    solution_.rods = std::move(rung.rods);
    solution_.nodes = std::move(rung.nodes);
    solution_.record = std::move(record_);
    solution_.descents = descents_;
    solution_.load_steps = load_steps_;
  }

  void complete(RodSolution<Spatial>& rod, std::size_t i) const {
    rod.material_force.resize(rod.force.size());
    for (std::size_t j = 0; j < rod.force.size(); ++j)
      rod.material_force[j] = unrotate(rod.curve.frames[j], rod.force[j]);
    take_curvatures(rod, scene_.rods[i]);
    for (std::size_t j = 0; j < rod.load.size(); ++j)
      rod.load_moment -= rod.curve.positions[j].cross(rod.load[j]);
  }

  LadderScene scene_;
  double tolerance_;
  int most_edges_;
  double length_ = 0, force_ = 0;  ///< units of the scene
  int edges_ = 0, longest_ = 0;    ///< on level 0: of all rods, and of that with most
  std::vector<Rung> rungs_;
  std::vector<Vector> numbers_;  ///< of the rungs' vertices
  Solution<Spatial> solution_;
  std::vector<Iteration> record_;
  Best best_;
  double quadratic_ = 0;  ///< C above; 0: not seen yet
  int index_ = -1, descents_ = 0, load_steps_ = 0;
  double order_ = std::numeric_limits<double>::quiet_NaN();
};

}  // namespace pyrod
