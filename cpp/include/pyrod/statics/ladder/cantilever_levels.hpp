// SPDX-License-Identifier: BSD-3-Clause
/// \file A cantilever on the levels of the accuracy ladder.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/refinement.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/ladder.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/scene_solution.hpp>
#include <pyrod/statics/solving/cantilever.hpp>
#include <pyrod/statics/solving/solve.hpp>
#include <pyrod/statics/start/prolongation.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace pyrod {

/// A rod and its loads on one level, in space.
struct LoadedRod {
  Rod<Spatial> rod;
  Loads<Spatial> loads;
};

/// Keeps what small levels need, so that a second climb makes none of it again.
template <class Space>
class CantileverLevels {
 public:
  using Rotation = typename Space::Rotation;
  using Frames = std::vector<Rotation>;
  static constexpr int most_kept = 1 << 14;  ///< edges of a level that is kept

  /// `source` gives the rod of a level, whose edges are those of level 0 cut in 2ᵏ.
  CantileverLevels(std::function<LoadedRod(int level)> source, const Placement<Spatial>& clamp)
      : source_(std::move(source)), clamp_(clamp) {}

  /// One level of a climb: from the level below if that was solved, else from `start`, frames on
  /// level 0, or from nothing.
  SceneSolution solve(int level, bool from_below, const Frames& start, const Options& options,
                      const Trace& trace) {
    const auto here = at(level);
    if (level == 0) edges_ = here->rod().edges();
    require_level(here->rod().edges(), edges_, level, "edges");
    begin(level, from_below, start);
    auto found = prolonged_.start.empty() ? here->find(options, trace)
                                          : here->find(prolonged_.start, options, trace);
    frames_ = found.state;
    grid_ = here->rod().grid;
    auto told = placed(here->told(std::move(found), 1 << level), clamp_);
    about_origin(told, here->loads(), level);
    return scene_solution(std::move(told), here->rod().edges() * Space::spin);
  }

 private:
  using Scene = Cantilever<Space>;

  /// Frames to start from. Those that were given go along on every level, in case all below fail.
  void begin(int level, bool from_below, const Frames& start) {
    if (level == 0)
      given_ = start;
    else if (!given_.empty())
      given_ = prolonged(grid_, given_).start;
    prolonged_ =
        from_below ? prolonged(grid_, frames_, prolonged_) : Prolonged<Rotation>{given_, {}};
  }

  std::shared_ptr<const Scene> at(int level) {
    if (level < int(kept_.size())) return kept_[level];
    const auto [rod, loads] = source_(level);
    require_count(Eigen::Index(loads.moment.size()), rod.edges(), "loads", "one per edge");
    auto made = std::make_shared<const Scene>(restricted<Space>(rod), Point<Space>::Zero(),
                                              Space::Rotation::Identity(),
                                              restricted<Space>(loads, clamp_.frame));
    if (rod.edges() <= most_kept && level == int(kept_.size())) kept_.push_back(made);
    return made;
  }

  /// The moment of all loads, about the origin of space instead of the clamp.
  void about_origin(RodSolution<Spatial>& told, const Loads<Space>& loads, int level) const {
    if (level == 0) {
      for (std::size_t j = 0; j < told.load.size(); ++j)
        told.load_moment += told.curve.positions[j].cross(told.load[j]);
      return;
    }
    Point<Space> sum = Point<Space>::Zero();
    for (const auto& F : loads.force) sum += F;
    told.load_moment += clamp_.position.cross(rotate(clamp_.frame, embed(sum)));
  }

  std::function<LoadedRod(int)> source_;
  Placement<Spatial> clamp_;
  std::vector<std::shared_ptr<const Scene>> kept_;
  Grid grid_ = Grid::uniform(1, 1);  ///< of the last level
  int edges_ = 0;                    ///< on level 0
  Frames frames_, given_;
  Prolonged<Rotation> prolonged_;
};

}  // namespace pyrod
