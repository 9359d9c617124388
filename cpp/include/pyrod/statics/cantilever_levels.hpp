// SPDX-License-Identifier: BSD-3-Clause
/// \file A cantilever on the levels of the accuracy ladder.
#pragma once

#include <pyrod/statics/ladder.hpp>
#include <pyrod/statics/prolongation.hpp>
#include <pyrod/statics/solve.hpp>

namespace pyrod {

/// A rod and its loads on one level, in space.
struct LoadedRod {
  const Rod<Spatial>& rod;
  const Loads<Spatial>& loads;
};

/// Keeps what each level needs, so that a second climb makes none of it again.
template <class Space, class Model>
class CantileverLevels {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;

  /// `source` gives the rod of a level, whose edges are those of level 0 cut in 2ᵏ.
  CantileverLevels(std::function<LoadedRod(int level)> source, const Clamp& clamp)
      : source_(std::move(source)), clamp_(clamp) {}

  /// One level of a climb: from the level below if that was solved, else from `start`, or from
  /// nothing.
  SceneSolution solve(int level, bool from_below, const Frames& start, const Options& options,
                      const Trace& trace) {
    const auto& here = at(level);
    prolonged_ = from_below ? prolonged(at(level - 1).rod().grid, frames_, prolonged_)
                            : Prolonged<Rotation>{start, {}};
    auto found = prolonged_.start.empty() ? here.find(options, trace)
                                          : here.find(prolonged_.start, options, trace);
    frames_ = found.state;
    auto told = placed(here.told(std::move(found), 1 << level), clamp_);
    about_origin(told, level);
    return scene_solution(std::move(told), here.rod().edges() * Space::spin);
  }

 private:
  const Cantilever<Space, Model>& at(int level) {
    while (int(levels_.size()) <= level) {
      const auto [rod, loads] = source_(int(levels_.size()));
      levels_.push_back(std::make_unique<Cantilever<Space, Model>>(
          restricted<Space>(rod), Point<Space>::Zero(), Space::Rotation::Identity(),
          restricted<Space>(loads, clamp_.frame)));
    }
    return *levels_[level];
  }

  /// The moment of all loads, about the origin of space instead of the clamp.
  void about_origin(RodSolution<Spatial>& told, int level) {
    if (level == 0) {
      for (std::size_t j = 0; j < told.load.size(); ++j)
        told.load_moment += told.curve.positions[j].cross(told.load[j]);
      return;
    }
    Point<Space> sum = Point<Space>::Zero();
    for (const auto& F : at(level).loads().force) sum += F;
    told.load_moment += clamp_.position.cross(rotate(clamp_.frame, embed(sum)));
  }

  std::function<LoadedRod(int)> source_;
  Clamp clamp_;
  std::vector<std::unique_ptr<Cantilever<Space, Model>>> levels_;
  Frames frames_;
  Prolonged<Rotation> prolonged_;
};

}  // namespace pyrod
