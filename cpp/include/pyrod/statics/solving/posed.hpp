// SPDX-License-Identifier: BSD-3-Clause
/// \file A network on its grid as a problem that is ready to be solved, again and again.
#pragma once

#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/scene/placement.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/solution/solution.hpp>
#include <pyrod/statics/start/coarsening.hpp>
#include <pyrod/statics/start/restricted.hpp>
#include <pyrod/statics/start/restricted_network.hpp>
#include <pyrod/statics/unknowns/layout.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <numbers>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace pyrod {

/// Several threads may use it at once. The problem keeps a reference to the layout: not to be
/// moved.
template <class Space>
class Posed {
 public:
  /// Refuses what is no network.
  explicit Posed(Network<Space> network) : given_(checked(std::move(network))), layout_(given_) {
    problem_.emplace(layout_);
  }

  /// In the plane of `at`, or in space.
  Posed(const Network<Spatial>& network, const Placement<Spatial>& at)
    requires(!std::is_same_v<Space, Spatial>)
      : Posed(in_plane(network, at)) {
    here_ = at;
  }
  Posed(const Network<Spatial>& network, const Placement<Spatial>&)
    requires std::is_same_v<Space, Spatial>
      : Posed(network) {}

  Posed(const Posed&) = delete;
  Posed& operator=(const Posed&) = delete;

  /// The same network with other numbers: places, lengths, stiffnesses, curvatures, loads. Not
  /// while anybody uses it.
  void change(const Network<Spatial>& network, const Placement<Spatial>& at);

  /// The same under other loads. Not while anybody uses it. False, and nothing has changed, where
  /// these decide more than numbers, see `KnownForces`.
  bool change_loads(const std::vector<Loads<Spatial>>& loads);

  /// The same with its nodes at other places, in other frames, in space. False, and nothing has
  /// changed, if they differ in more.
  bool move_nodes(const Network<Spatial>& network);

  /// As it was given: what the layout makes of it has units of its own, and nodes at free ends.
  const Network<Space>& network() const { return given_; }
  const Layout<Space>& layout() const { return layout_; }
  const NetworkProblem<Space>& problem() const { return *problem_; }
  /// Where the plane of the computation is.
  const Placement<Spatial>& here() const { return here_; }

  Solution<Spatial> in_space(Solution<Space>&& found) const {
    if constexpr (std::is_same_v<Space, Spatial>)
      return std::move(found);
    else
      return placed(std::move(found), here_);
  }

  /// How many coarser grids there are.
  int coarser() const {
    const std::lock_guard lock(coarse_->busy);
    return int(grids().size());
  }

  /// The same on a coarser grid, of which the first has fewest edges: made when it is first asked
  /// for.
  const Posed& coarser(int grid) const {
    const std::lock_guard lock(coarse_->busy);
    return *made(std::size_t(grid));
  }

 private:
  static constexpr int coarsest = 16, refinement = 4;
  /// Where the loads tell all forces, all edges at once are as quick if they are but that many
  /// times the coarsest ones.
  static constexpr int coarsest_clamped = 64, least_clamped = 12;

  static Network<Space> checked(Network<Space> network) {
    network.check();
    return network;
  }

  static Network<Space> in_plane(const Network<Spatial>& network, const Placement<Spatial>& at) {
    require_rotation(at.frame, "at.frame");
    return restricted<Space>(network, at);
  }

  struct Coarse {
    int edges;  ///< of a span
    std::unique_ptr<const Posed> posed;
  };
  using Coarser = std::vector<Coarse>;

  /// The third from the finest one, and the first two from that.
  const std::unique_ptr<const Posed>& made(std::size_t grid) const {
    auto& [edges, posed] = grids()[grid];
    const std::size_t base = std::min<std::size_t>(2, grids().size() - 1);
    if (!posed)
      posed = std::make_unique<const Posed>(
          coarsened(grid < base ? made(base)->given_ : given_, edges));
    return posed;
  }

  /// The coarsest first, such that a start does not turn by more than half a radian from edge to
  /// edge.
  Coarser& grids() const {
    auto& out = coarse_->grids;
    if (out) return *out;
    out.emplace();
    int longest = 0;
    for (const auto& span : layout_.spans()) longest = std::max(longest, span.last - span.first);
    if (longest < 2 * coarsest) return *out;
    const bool clamped = layout_.determinate();
    const int first =
        (clamped ? coarsest_clamped : coarsest) * std::max(1, int(std::ceil(turn() / 8)));
    if (longest < (clamped ? least_clamped : 2) * first) return *out;
    for (int n = first; n == first || refinement * n <= longest; n *= refinement)
      out->push_back({n, nullptr});
    return *out;
  }

  /// By which a rod may turn, at rest and from one attachment to the next, at the most.
  double turn() const {
    int turns = 0;
    for (const auto& a : given_.attachments) turns = std::max(turns, std::abs(a.turns));
    double rest = 0;
    for (const auto& rod : given_.rods) {
      double sum = 0;
      for (int j = 0; j < rod.grid.vertices(); ++j) sum += rod.grid.Δs(j) * rod.K0[j].norm();
      rest = std::max(rest, sum);
    }
    return 2 * std::numbers::pi * turns + rest;
  }

  Network<Space> given_;
  Layout<Space> layout_;
  std::optional<NetworkProblem<Space>> problem_;
  Placement<Spatial> here_;
  struct Shared {
    std::mutex busy;
    std::optional<Coarser> grids;  ///< once they are asked for
  };
  std::unique_ptr<Shared> coarse_ = std::make_unique<Shared>();
};

template <class Space>
void Posed<Space>::change(const Network<Spatial>& network, const Placement<Spatial>& at) {
  Network<Space> given = [&] {
    if constexpr (std::is_same_v<Space, Spatial>)
      return network;
    else
      return in_plane(network, at);
  }();
  given.check();
  Layout<Space> layout(given, std::move(layout_));  // whatever is refused, is so before it takes
  problem_.reset();
  given_ = std::move(given);
  layout_ = std::move(layout);
  problem_.emplace(layout_);
  if constexpr (!std::is_same_v<Space, Spatial>) here_ = at;
  coarse_ = std::make_unique<Shared>();
}

template <class Space>
bool Posed<Space>::move_nodes(const Network<Spatial>& network) {
  if constexpr (std::is_same_v<Space, Spatial>) {
    if (!given_.differs_in_places_only(network)) return false;
    network.check_nodes();
    layout_.move_nodes(network);
    given_.placements = network.placements;
    given_.nodes = network.nodes;
    coarse_ = std::make_unique<Shared>();
    return true;
  }
  return false;  // the plane may be another, and what leaves it is refused with all else
}

template <class Space>
bool Posed<Space>::change_loads(const std::vector<Loads<Spatial>>& loads) {
  std::vector<Loads<Space>> here;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    if constexpr (std::is_same_v<Space, Spatial>)
      here.push_back(loads[i]);
    else
      here.push_back(restricted<Space>(loads[i], here_.frame));
    here[i].check(given_.rods[i].edges());
  }
  auto given = here;
  if (!layout_.take_loads(here)) return false;
  given_.loads = std::move(given);
  problem_->renew_loads();
  coarse_ = std::make_unique<Shared>();
  return true;
}

}  // namespace pyrod
