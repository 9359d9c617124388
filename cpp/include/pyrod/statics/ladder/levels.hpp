// SPDX-License-Identifier: BSD-3-Clause
/// \file A network on the levels of the accuracy ladder.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/refinement.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/solution/found.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_solve.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/start/outlook.hpp>
#include <pyrod/statics/start/prolongation.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// The network of a level, whose edges are those of level 0 cut in 2ᵏ.
template <class Space>
using PosedLevel = std::function<std::shared_ptr<const Posed<Space>>(int level)>;

/// One climb: it remembers what the level before said.
template <class Space>
class Levels {
 public:
  explicit Levels(PosedLevel<Space> source) : source_(std::move(source)) {}

  /// One level: from the level below if that was solved, else from `start`, on level 0, or from
  /// nothing. What is told is at the vertices and the edges of level 0, see `Recovery`; the moments
  /// of the loads are about the origin of space.
  Solution<Spatial> solve(int level, bool from_below, const std::optional<NetworkStart>& start,
                          const Options& options, NetworkOptions more, const Trace& trace) {
    more.rounding = true;
    more.anchored = from_below && neutral_;
    const auto posed = source_(level);
    check(posed->network(), level);
    begin(level, from_below, posed->network(), start);
    NetworkSolver<Space> solver(*posed, options, more, trace);
    auto reached = solved(solver, *posed, from_below);
    auto found = told(*posed, reached, 1 << level, true);
    if (level == 0) move_to_origin(found);
    outlook_.add(posed->layout(), reached.state);
    neutral_ = found.neutral;
    if (!found.mode.empty()) found.mode = thinned(found.mode, 1 << level);
    auto out = posed->in_space(std::move(found));
    for (auto& rod : out.rods)
      for (const auto& F : rod.load) rod.load_moment += posed->here().position.cross(F);
    return out;
  }

 private:
  /// Refuses a network that is not that of level 0 on finer grids.
  void check(const Network<Space>& network, int level) {
    if (level == 0) {
      edges_.clear(), attached_.clear();
      for (const auto& rod : network.rods) edges_.push_back(rod.edges());
      for (const auto& a : network.attachments) attached_.push_back(a.vertex);
    }
    require_level(Eigen::Index(network.rods.size()), Eigen::Index(edges_.size()), 0, "rods");
    for (std::size_t i = 0; i < edges_.size(); ++i)
      require_level(network.rods[i].edges(), edges_[i], level, "edges");
    require_level(Eigen::Index(network.attachments.size()), Eigen::Index(attached_.size()), 0,
                  "attachments");
    for (std::size_t i = 0; i < attached_.size(); ++i)
      require_level(network.attachments[i].vertex, attached_[i], level, "for an attached vertex");
  }

  Found<Space> solved(NetworkSolver<Space>& solver, const Posed<Space>& posed, bool from_below) {
    const StateNear<Space> near(posed.layout(), posed.here(), posed.network().nodes.size());
    if (from_below) return solver.find(near.state(outlook_.on(posed.layout())));
    return given_ ? solver.find(near.state(*given_)) : solver.find();
  }

  /// The start of this level. One that was given goes along on every level, in case all below fail.
  void begin(int level, bool from_below, const Network<Space>& network,
             const std::optional<NetworkStart>& start) {
    if (level == 0)
      given_ = start;
    else if (given_)
      given_->frames = halved(given_->frames, network);
    if (!from_below) outlook_.clear();
  }

  /// Frames of all rods on halved edges, one after another.
  static std::vector<Quaternion> halved(const std::vector<Quaternion>& frames,
                                        const Network<Space>& finer) {
    std::vector<Quaternion> out;
    Eigen::Index edges = 0;
    for (const auto& rod : finer.rods) edges += rod.edges() / 2;
    require_count(Eigen::Index(frames.size()), edges, "start", "one frame per edge");
    const Quaternion* from = frames.data();
    for (const auto& rod : finer.rods) {
      const Vector& h = rod.grid.edge_lengths();
      const Grid coarse(Vector(h.reshaped(2, h.size() / 2).colwise().sum().transpose()));
      prolong(Stretch(coarse), components(from, coarse.edges()), Stretch(rod.grid), out);
      from += coarse.edges();
    }
    return out;
  }

  /// Adds the moments of the forces about the origin, which a stride brings by itself.
  static void move_to_origin(Solution<Space>& found) {
    for (auto& rod : found.rods)
      for (std::size_t j = 0; j < rod.load.size() && j < rod.curve.positions.size(); ++j)
        rod.load_moment += cross(rod.curve.positions[j], rod.load[j]);
  }

  /// A mode on the edges of level 0: the mean of the two at each centre.
  static std::vector<Spin<Space>> thinned(const std::vector<Spin<Space>>& mode, int stride) {
    std::vector<Spin<Space>> out;
    for (std::size_t j = std::size_t(stride / 2); j < mode.size(); j += std::size_t(stride))
      out.push_back((mode[j] + mode[j - (stride > 1)]) / 2);
    return out;
  }

  PosedLevel<Space> source_;
  Outlook<Space> outlook_;
  std::vector<int> edges_, attached_;  ///< of rods, and vertices of attachments, on level 0
  std::optional<NetworkStart> given_;
  bool neutral_ = false;  ///< the level below
};

}  // namespace pyrod
