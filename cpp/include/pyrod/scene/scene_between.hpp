// SPDX-License-Identifier: BSD-3-Clause
/// \file Scenes between two others that differ in vectors: loads, and positions of supports.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/scene.hpp>
#include <pyrod/scene/supports.hpp>

#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace pyrod {

namespace detail {

/// a + t (b − a) of what parts of scenes consist of; what is no vector must be the same in both.
class Between {
 public:
  explicit Between(double t) : t_(t) {}

  template <class... Kinds>
  std::variant<Kinds...> parts(const std::variant<Kinds...>& a, const std::variant<Kinds...>& b,
                               const char* name) const {
    require(a.index() == b.index(), "family: the two scenes have ", name, " of different kinds");
    return std::visit(
        [&]<class Part>(const Part& one) -> std::variant<Kinds...> {
          Part out = one;
          std::apply(
              [&](const auto&... field) {
                ((out.*field.member =
                      value(one.*field.member, std::get<Part>(b).*field.member, field.name)),
                 ...);
              },
              Part::fields());
          return out;
        },
        a);
  }

 private:
  Vec3 value(const Vec3& a, const Vec3& b, const char*) const { return a + t_ * (b - a); }

  std::optional<Vec3> value(const std::optional<Vec3>& a, const std::optional<Vec3>& b,
                            const char* name) const {
    require(a.has_value() == b.has_value(), "family: only one of two parts has a ", name);
    return a ? std::optional(value(*a, *b, name)) : std::nullopt;
  }

  Along<Vec3> value(const Along<Vec3>& a, const Along<Vec3>& b, const char* name) const {
    require(a.index() == b.index(), "family: ", name, " is of different kinds in the two scenes");
    if (const auto* one = std::get_if<Vec3>(&a)) return value(*one, std::get<Vec3>(b), name);
    if (const auto* list = std::get_if<std::vector<Vec3>>(&a)) {
      const auto& other = std::get<std::vector<Vec3>>(b);
      require(list->size() == other.size(), "family: ", name, " has ", list->size(),
              " rows in one scene, and ", other.size(), " in the other");
      std::vector<Vec3> out;
      for (std::size_t i = 0; i < list->size(); ++i)
        out.push_back(value((*list)[i], other[i], name));
      return out;
    }
    return FunctionAlong<Vec3>([f = std::get<2>(a), g = std::get<2>(b), t = t_](double s) -> Vec3 {
      const Vec3 from = f(s);
      return from + t * (g(s) - from);
    });
  }

  std::optional<Quaternion> value(const std::optional<Quaternion>& a,
                                  const std::optional<Quaternion>& b, const char* name) const {
    require(a.has_value() == b.has_value() && (!a || a->coeffs() == b->coeffs()), "family: the ",
            name, " differs; give a function of the parameter instead of two scenes");
    return a;
  }

  template <class T>
  T value(const T& a, const T& b, const char* name) const {
    require(a == b, "family: ", name,
            " differs; give a function of the parameter instead of two "
            "scenes");
    return a;
  }

  double t_;
};

}  // namespace detail

/// The scene a for t = 0, b for t = 1. They must be the same but for vectors of loads and supports;
/// rods are taken from a.
inline Scene scene_between(const Scene& a, const Scene& b, double t) {
  require(a.loads.size() == b.loads.size() && a.supports.size() == b.supports.size() &&
              a.rods.size() == b.rods.size() && a.joints.size() == b.joints.size() &&
              a.space == b.space,
          "family: the two scenes have different numbers of parts, or spaces");
  Scene out = a;
  const detail::Between between(t);
  for (std::size_t i = 0; i < a.loads.size(); ++i)
    out.loads[i] = between.parts(a.loads[i], b.loads[i], "loads");
  for (std::size_t i = 0; i < a.supports.size(); ++i)
    out.supports[i] = between.parts(a.supports[i], b.supports[i], "supports");
  return out;
}

}  // namespace pyrod
