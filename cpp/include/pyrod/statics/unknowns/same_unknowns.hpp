// SPDX-License-Identifier: BSD-3-Clause
/// \file Whether two networks have the same unknowns, whatever their numbers are.
#pragma once

#include <pyrod/rod/routed_tendon.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/unknowns/known_forces.hpp>
#include <pyrod/statics/unknowns/spans.hpp>

#include <algorithm>
#include <vector>

namespace pyrod {

namespace detail {

template <class Space>
bool same_unknowns(const Attachment<Space>& a, const Attachment<Space>& b) {
  return a.vertex == b.vertex && a.node == b.node && a.rigid == b.rigid &&
         a.hinge.has_value() == b.hinge.has_value() && a.hinge_number == b.hinge_number;
}
template <class Space>
bool same_unknowns(const Span<Space>& a, const Span<Space>& b) {
  return a.rod == b.rod && a.first == b.first && a.last == b.last && a.start == b.start &&
         a.end == b.end && a.open.cols() == b.open.cols();
}
template <class Space>
bool same_unknowns(const Node<Space>& a, const Node<Space>& b) {
  return a.free.cols() == b.free.cols() && a.turns.cols() == b.turns.cols();
}
inline bool same_unknowns(const RoutedTendon& a, const RoutedTendon& b) {
  return a.rod == b.rod && a.first == b.first && a.last == b.last &&
         a.length.has_value() == b.length.has_value();
}
template <class T>
bool same_unknowns(const std::vector<T>& a, const std::vector<T>& b) {
  return std::ranges::equal(a, b, [](const T& x, const T& y) { return same_unknowns(x, y); });
}

}  // namespace detail

template <class Space>
bool same_unknowns(const KnownForces<Space>& a, const KnownForces<Space>& b) {
  const auto &x = a.cut(), &y = b.cut();
  if (x.has_frame != y.has_frame || !detail::same_unknowns(x.spans, y.spans) ||
      !detail::same_unknowns(x.network.nodes, y.network.nodes) ||
      !detail::same_unknowns(x.attached, y.attached) ||
      !detail::same_unknowns(x.network.tendons, y.network.tendons))
    return false;
  for (int v = 0; v < int(x.network.nodes.size()); ++v)
    if (a.derived(v) != b.derived(v)) return false;
  return true;
}

}  // namespace pyrod
