// SPDX-License-Identifier: BSD-3-Clause
/// \file Tendons of given length that are longer than their way: they bear nothing.
#pragma once

#include <pyrod/rod/cell_kind.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/statics/equations/end_turn.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/equations/network_terms.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// How long the ways of all tendons are.
template <class Space>
std::vector<double> lengths_of_tendons(const NetworkProblem<Space>& problem,
                                       const NetworkState<Space>& x) {
  const auto& layout = problem.layout();
  const auto& net = layout.network();
  const auto terms = problem.terms(x);
  std::vector<double> out(net.tendons.size(), 0.);
  for (int rod = 0; rod < int(net.rods.size()); ++rod) {
    if (terms.none(rod)) continue;
    const auto add = [&](int j, CellKind kind, const Spin<Space>& u) {
      terms.for_each_tendon(rod, j, kind, u, [&](int i, double, const auto& length) {
        out[std::size_t(i)] += length.length;
      });
    };
    for_each_cell(layout, rod, [&](int j, CellKind kind, const Attachment<Space>* a) {
      add(j, kind, turn_of_cell(layout, x, rod, j, kind, a));
    });
    const Spin<Space> none = Spin<Space>::Zero();
    const auto end = [&](End which) {
      return turn_of_end<Space>(terms, net.rods[rod], rod, which, none, false);
    };
    const auto& on = layout.attached(rod);
    if (!on.front().rigid) add(0, CellKind::behind, Spin<Space>(-end(End::start)));
    if (!on.back().rigid) add(net.rods[rod].edges(), CellKind::before, end(End::end));
  }
  return out;
}

namespace detail {

template <class Space>
bool holds_lengths(const Layout<Space>& layout) {
  for (int i = 0; i < int(layout.network().tendons.size()); ++i)
    if (layout.tendon_block(i) >= 0) return true;
  return false;
}

}  // namespace detail

/// Of a start that does not tell, tendons are slack that are longer than their ways there.
template <class Space>
void loosen(const NetworkProblem<Space>& problem, NetworkState<Space>& x) {
  const auto& layout = problem.layout();
  if (!x.slack.empty() || !detail::holds_lengths(layout)) return;
  const auto lengths = lengths_of_tendons(problem, x);
  for (std::size_t i = 0; i < lengths.size(); ++i)
    x.slack.push_back(layout.tendon_block(int(i)) >= 0 &&
                      lengths[i] < *layout.network().tendons[i].length * (1 - 1e-12));
}

/// Lets tendons go slack that would push, and those bear again that are too short. Whether any did.
template <class Space>
bool settle(const NetworkProblem<Space>& problem, NetworkState<Space>& x) {
  const auto& layout = problem.layout();
  const auto& tendons = layout.network().tendons;
  bool any = false;
  if (!detail::holds_lengths(layout)) return false;
  x.slack.resize(tendons.size(), false), x.tensions.resize(tendons.size(), 0.);
  const auto lengths = lengths_of_tendons(problem, x);
  for (std::size_t i = 0; i < tendons.size(); ++i) {
    if (layout.tendon_block(int(i)) < 0) continue;
    const double rounding = 1e-12 * layout.unit_tension(int(i));
    if (!x.slack[i] && x.tensions[i] < -rounding)
      x.slack[i] = any = true, x.tensions[i] = 0;
    else if (x.slack[i] && lengths[i] > *tendons[i].length * (1 + 1e-12))
      x.slack[i] = false, any = true;
  }
  return any;
}

}  // namespace pyrod
