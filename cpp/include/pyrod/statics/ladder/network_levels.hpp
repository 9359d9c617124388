// SPDX-License-Identifier: BSD-3-Clause
/// \file A network on the levels of the accuracy ladder.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/refinement.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/statics/ladder/ladder.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/scene_solution.hpp>
#include <pyrod/statics/solving/network_options.hpp>
#include <pyrod/statics/solving/network_run.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/start/prolongation.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// A network on one level, and the plane it is in if its space is one.
struct PlacedNetwork {
  Network<Spatial> network;
  Placement<Spatial> plane;
};

template <class Space>
class NetworkLevels {
 public:
  /// `source` gives the network of a level, whose edges are those of level 0 cut in 2ᵏ.
  explicit NetworkLevels(std::function<PlacedNetwork(int level)> source)
      : source_(std::move(source)) {}

  /// One level of a climb: from the level below if that was solved, else from `start`, on level 0,
  /// or from nothing.
  SceneSolution solve(int level, bool from_below, const std::optional<NetworkStart>& start,
                      const Options& options, NetworkOptions more, const Trace& trace) {
    more.rounding = true;
    more.anchored = from_below && neutral_;
    const auto [network, plane] = source_(level);
    check(network, level);
    begin(level, from_below, start);
    auto out = scene_solution(run<Space>(network, plane, start_, options, more, trace));
    below_.clear(), grids_.clear();
    for (std::size_t i = 0; i < out.rods.size(); ++i) {
      below_.push_back(out.rods[i].curve.frames);
      grids_.push_back(network.rods[i].grid);
      out.rods[i] = seen(out.rods[i], 1 << level);
    }
    nodes_ = out.nodes;
    neutral_ = out.neutral;
    if (!out.mode.empty()) out.mode = thinned(out.mode, 1 << level);
    return out;
  }

 private:
  /// Refuses a network that is not that of level 0 on finer grids.
  void check(const Network<Spatial>& network, int level) {
    if (level == 0) {
      edges_.clear(), attached_.clear();
      for (const auto& rod : network.rods) edges_.push_back(rod.edges());
      for (const auto& a : network.attachments) attached_.push_back(a.vertex);
    }
    require_level(Eigen::Index(network.rods.size()), Eigen::Index(edges_.size()), 0, "rods");
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      require_level(network.rods[i].edges(), edges_[i], level, "edges");
      require_level(Eigen::Index(network.loads[i].moment.size()), edges_[i], level, "loaded edges");
    }
    require_level(Eigen::Index(network.attachments.size()), Eigen::Index(attached_.size()), 0,
                  "attachments");
    for (std::size_t i = 0; i < attached_.size(); ++i)
      require_level(network.attachments[i].vertex, attached_[i], level, "for an attached vertex");
  }

  /// The start of this level. One that was given goes along on every level, in case all below fail.
  void begin(int level, bool from_below, const std::optional<NetworkStart>& start) {
    if (level == 0)
      given_ = start;
    else if (given_)
      given_->frames = halved(given_->frames);
    if (!from_below) prolonged_.clear();
    start_ = from_below ? refined() : given_;
  }

  /// Frames of all rods on halved edges, one after another.
  std::vector<Quaternion> halved(const std::vector<Quaternion>& frames) const {
    std::vector<Quaternion> out;
    Eigen::Index edges = 0;
    for (const auto& grid : grids_) edges += grid.edges();
    require_count(Eigen::Index(frames.size()), edges, "start", "one frame per edge");
    auto from = frames.begin();
    for (const auto& grid : grids_) {
      const auto more = prolonged(grid, std::vector<Quaternion>(from, from + grid.edges())).start;
      out.insert(out.end(), more.begin(), more.end());
      from += grid.edges();
    }
    return out;
  }

  NetworkStart refined() {
    NetworkStart out;
    prolonged_.resize(grids_.size());
    for (std::size_t i = 0; i < grids_.size(); ++i) {
      prolonged_[i] = prolonged(grids_[i], below_[i], prolonged_[i]);
      const auto& frames = prolonged_[i].start;
      out.frames.insert(out.frames.end(), frames.begin(), frames.end());
    }
    for (const auto& node : nodes_) {
      out.positions.push_back(node.position);
      out.node_frames.push_back(node.frame);
    }
    return out;
  }

  /// A mode on the edges of level 0: the mean of the two at each centre.
  static std::vector<Vec3> thinned(const std::vector<Vec3>& mode, int stride) {
    std::vector<Vec3> out;
    for (std::size_t j = std::size_t(stride / 2); j < mode.size(); j += std::size_t(stride))
      out.push_back((mode[j] + mode[j - (stride > 1)]) / 2);
    return out;
  }

  std::function<PlacedNetwork(int)> source_;
  std::vector<std::vector<Quaternion>> below_;
  std::vector<Prolonged<Quaternion>> prolonged_;
  std::vector<Grid> grids_;
  std::vector<int> edges_, attached_;  ///< of rods, and vertices of attachments, on level 0
  std::vector<NodeSolution<Spatial>> nodes_;
  std::optional<NetworkStart> given_, start_;
  bool neutral_ = false;  ///< the level below
};

}  // namespace pyrod
