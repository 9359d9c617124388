// SPDX-License-Identifier: BSD-3-Clause
/// \file What depends on arc length: one value for all, one per place, or a function.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>

#include <cstddef>
#include <functional>
#include <string_view>
#include <variant>
#include <vector>

namespace pyrod {

template <class T>
using Along = std::variant<T, std::vector<T>, std::function<T(double s)>>;

template <class T>
bool is_function(const Along<T>& along) {
  return along.index() == 2;
}

/// Values at the arc lengths `s`, of which a list has one each.
template <class T>
std::vector<T> sampled(const Along<T>& along, const Vector& s, std::string_view name,
                       std::string_view place) {
  if (const auto* one = std::get_if<T>(&along)) return std::vector<T>(std::size_t(s.size()), *one);
  if (const auto* list = std::get_if<std::vector<T>>(&along)) {
    require(Eigen::Index(list->size()) == s.size(), name, ": expected ", s.size(), ", one per ",
            place, ", got ", list->size());
    return *list;
  }
  const auto& function = std::get<2>(along);
  require(bool(function), name, ": the function is empty");
  std::vector<T> out;
  out.reserve(std::size_t(s.size()));
  for (const double at : s) out.push_back(function(at));
  return out;
}

/// The arc lengths of the centres of the edges.
inline Vector centres(const Vector& arc_lengths) {
  const auto n = arc_lengths.size() - 1;
  return (arc_lengths.head(n) + arc_lengths.tail(n)) / 2;
}

}  // namespace pyrod
