// SPDX-License-Identifier: BSD-3-Clause
/// \file What depends on arc length: one value for all, one per place, or a function.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/scene/breaks.hpp>

#include <concepts>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

/// A function of arc length. Copies share what is found of it.
template <class T>
class FunctionAlong {
 public:
  template <class F>
    requires(std::is_invocable_r_v<T, F&, double> && !std::same_as<F, FunctionAlong>)
  FunctionAlong(F function) : shared_(std::make_shared<Shared>()) {
    shared_->function = std::move(function);
  }

  T operator()(double s) const { return shared_->function(s); }
  explicit operator bool() const { return bool(shared_->function); }

  /// Its jumps and kinks on a rod so long, that `find()` finds the first time.
  template <class Find>
  const Breaks& breaks(double length, const Find& find) const {
    const std::lock_guard lock(shared_->busy);
    const auto known = shared_->breaks.find(length);
    if (known != shared_->breaks.end()) return known->second;
    return shared_->breaks.emplace(length, find()).first->second;
  }

 private:
  struct Shared {
    std::function<T(double)> function;
    std::map<double, Breaks> breaks;
    std::mutex busy;
  };
  std::shared_ptr<Shared> shared_;
};

template <class T>
using Along = std::variant<T, std::vector<T>, FunctionAlong<T>>;

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
