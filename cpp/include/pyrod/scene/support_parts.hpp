// SPDX-License-Identifier: BSD-3-Clause
/// \file What supports of all kinds have.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/scene/place.hpp>
#include <pyrod/scene/supports.hpp>

#include <optional>
#include <variant>

namespace pyrod {

inline const char* kind_of(const Support& support) {
  return std::visit([](const auto& s) { return s.kind; }, support);
}
inline const Place& place_of(const Support& support) {
  return std::visit([](const auto& s) -> const Place& { return s.at; }, support);
}
inline const std::optional<Vec3>& position_of(const Support& support) {
  return std::visit([](const auto& s) -> const auto& { return s.position; }, support);
}
inline std::optional<Quaternion> frame_of(const Support& support) {
  return std::visit(
      [](const auto& s) -> std::optional<Quaternion> {
        if constexpr (requires { s.frame; }) return s.frame;
        return std::nullopt;
      },
      support);
}

}  // namespace pyrod
