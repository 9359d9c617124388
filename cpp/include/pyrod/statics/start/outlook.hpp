// SPDX-License-Identifier: BSD-3-Clause
/// \file What equilibria on coarser grids make expect on a finer one.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/start/prolongation.hpp>
#include <pyrod/statics/unknowns/kinks.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace pyrod {

/// Frames go on cubically from kink to kink, and change as errors of second order do; so does all
/// else that is unknown.
template <class Space>
class Outlook {
 public:
  using Rotation = typename Space::Rotation;
  using State = NetworkState<Space>;

  /// What was reached on the next grid.
  void add(const Layout<Space>& layout, const State& x) {
    before_ = std::move(now_);
    now_.emplace(layout, x);
  }
  void clear() { now_.reset(), before_.reset(); }

  /// Whether two grids are known, so that what changes is.
  bool sees_change() const { return before_.has_value(); }

  /// Once something is known.
  State on(const Layout<Space>& finer) const;

 private:
  using Values = std::vector<Components<Rotation>>;

  /// Of a rod, where its frames are smooth: the edges [first, last).
  struct Smooth {
    std::size_t rod;
    int first, last;
  };

  struct Known {
    std::vector<Grid> grids;  ///< of the rods
    std::vector<Smooth> spans, parts;
    State x;

    Known(const Layout<Space>& layout, const State& reached)
        : spans(smooth(layout, false)), parts(smooth(layout, true)), x(reached) {
      for (const auto& rod : layout.network().rods) grids.push_back(rod.grid);
    }

    Stretch part(bool parted, std::size_t p) const {
      const auto& [rod, first, last] = (parted ? parts : spans)[p];
      return {grids[rod], first, last};
    }
    int edges() const { return int(x.frames.size()); }
  };

  /// The spans, or parts of them between kinks, in the order of their edges.
  static std::vector<Smooth> smooth(const Layout<Space>& layout, bool parted);

  static constexpr double most_ = 0.1;  ///< a larger change is none of second order

  /// Of the frames of each part, since the grid before: none, if it is too large to tell anything.
  std::vector<Values> changes(bool parted) const;
  static void carry_on(const State& before, double part, State& out);

  std::optional<Known> now_, before_;
};

template <class Space>
auto Outlook<Space>::smooth(const Layout<Space>& layout, bool parted) -> std::vector<Smooth> {
  std::vector<Smooth> out;
  const auto& net = layout.network();
  std::size_t rod = net.rods.size();
  std::vector<int> cuts;
  for (const auto& span : layout.spans()) {
    if (parted && std::size_t(span.rod) != rod) {
      rod = std::size_t(span.rod);
      cuts = kinks(net.rods[rod], net.loads[rod]);
    }
    int first = span.first;
    for (const int j : cuts)
      if (j > first && j < span.last)
        out.push_back({std::size_t(span.rod), std::exchange(first, j), j});
    out.push_back({std::size_t(span.rod), first, span.last});
  }
  return out;
}

template <class Space>
auto Outlook<Space>::changes(bool parted) const -> std::vector<Values> {
  const auto count = [&](const Known& on) { return (parted ? on.parts : on.spans).size(); };
  if (!before_ || count(*before_) != count(*now_)) return {};
  std::vector<Values> out;
  const Rotation *then = before_->x.frames.data(), *frames = now_->x.frames.data();
  for (std::size_t p = 0; p < count(*now_); ++p) {
    const Stretch from = before_->part(parted, p);
    Values change = interpolated(from, components(then, from.edges()), now_->part(parted, p));
    for (auto& c : change) {
      c = detail::components(*frames++) - c;
      if (!(c.template lpNorm<Eigen::Infinity>() <= most_)) return {};
    }
    then += from.edges();
    out.push_back(std::move(change));
  }
  return out;
}

template <class Space>
auto Outlook<Space>::on(const Layout<Space>& finer) const -> State {
  State out = now_->x;
  out.frames.clear();
  out.frames.reserve(std::size_t(finer.edges()));
  auto there = smooth(finer, true);
  const bool parted = there.size() == now_->parts.size();
  if (!parted) there = smooth(finer, false);
  const auto change = changes(parted);
  const Rotation* frames = now_->x.frames.data();
  for (std::size_t p = 0; p < there.size(); ++p) {
    const Stretch from = now_->part(parted, p),
                  to(finer.network().rods[there[p].rod].grid, there[p].first, there[p].last);
    Values values = components(frames, from.edges());
    if (!change.empty()) {
      const double part = still_to_come(before_->part(parted, p).edges(), from.edges(), to.edges());
      for (std::size_t j = 0; j < values.size(); ++j) values[j] += part * change[p][j];
    }
    prolong(from, values, to, out.frames);
    frames += from.edges();
  }
  if (!change.empty())
    carry_on(before_->x, still_to_come(before_->edges(), now_->edges(), finer.edges()), out);
  return out;
}

/// All but the frames of edges.
template <class Space>
void Outlook<Space>::carry_on(const State& before, double part, State& out) {
  const auto go_on = [&](auto& list, const auto& was) {
    for (std::size_t i = 0; i < list.size(); ++i) list[i] += part * (list[i] - was[i]);
  };
  go_on(out.forces, before.forces);
  go_on(out.positions, before.positions);
  go_on(out.hinge_angles, before.hinge_angles);
  if (out.tensions.size() == before.tensions.size() && out.slack == before.slack)
    go_on(out.tensions, before.tensions);
  for (std::size_t v = 0; v < out.node_frames.size(); ++v) {
    const Components<Rotation> q = detail::components(out.node_frames[v]),
                               change = q - detail::components(before.node_frames[v]);
    if (change.template lpNorm<Eigen::Infinity>() <= most_)
      out.node_frames[v] = detail::rotation(Components<Rotation>(q + part * change));
  }
}

}  // namespace pyrod
