// SPDX-License-Identifier: BSD-3-Clause
/// \file What acts on rods: forces and moments, fixed in space or following the rod.
///
/// Each kind says here what it consists of, and what it adds to a rod on a grid; that is all that
/// is known of it. `at` is a point that it acts on, `rod` the number of the rod; with neither it
/// acts on all rods. One that has `follower` may turn with the rod. Values of type `Along` belong
/// to its rod; where they jump, the rod gets vertices. `On` is a `LoadedGrid`, a template so that
/// who only tells loads need not compile grids.
#pragma once

#include <pyrod/core/field.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/place.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

namespace pyrod {

/// A force [N] on one point of a rod. A follower turns with the rod, and its components are those
/// of the frame there; else it is dead, fixed in space. A follower has no potential.
struct Force {
  Vec3 force;
  Place at = End::end;
  bool follower = false;

  static constexpr const char* kind = "Force";
  static constexpr auto fields() {
    return std::tuple{Field{"force", &Force::force}, Field{"at", &Force::at},
                      Field{"follower", &Force::follower}};
  }
  template <class On>
  void act(On& on) const {
    const auto& rod = on.rod();
    if (follower)
      on.loads().add_follower_force(rod.grid, force, on.site(at), {rod.K0.front(), rod.K0.back()});
    else
      on.loads().add_force(rod.grid, force, on.site(at));
  }
};

/// A moment [N m] on one cross-section. In space neither a dead one nor a follower has a potential.
struct Moment {
  Vec3 moment;
  Place at = End::end;
  bool follower = false;

  static constexpr const char* kind = "Moment";
  static constexpr auto fields() {
    return std::tuple{Field{"moment", &Moment::moment}, Field{"at", &Moment::at},
                      Field{"follower", &Moment::follower}};
  }
  template <class On>
  void act(On& on) const {
    const auto& rod = on.rod();
    const auto site = on.site(at);
    if (!follower) return on.loads().add_moment(rod.grid, moment, site);
    const auto vertex = std::size_t(site.edge + (site.part >= 0.5));
    on.loads().add_follower_moment(rod.grid, moment, site, rod.bending[vertex].cwiseInverse());
  }
};

/// A force per length at rest [N/m]: one for all, one per edge, or a function of arc length, which
/// is taken at the centres of the edges.
struct DistributedForce {
  Along<Vec3> force_per_length;
  int rod = 0;
  bool follower = false;

  static constexpr const char* kind = "DistributedForce";
  static constexpr auto fields() {
    using Self = DistributedForce;
    return std::tuple{Field{"force_per_length", &Self::force_per_length}, Field{"rod", &Self::rod},
                      Field{"follower", &Self::follower}};
  }
  template <class On>
  void act(On& on) const {
    const auto f = on.on_edges(force_per_length, "force_per_length");
    follower ? on.loads().add_follower_force_per_length(on.grid(), f)
             : on.loads().add_force_per_length(on.grid(), f);
  }
};

/// A moment per length at rest [N].
struct DistributedMoment {
  Along<Vec3> moment_per_length;
  int rod = 0;
  bool follower = false;

  static constexpr const char* kind = "DistributedMoment";
  static constexpr auto fields() {
    using Self = DistributedMoment;
    return std::tuple{Field{"moment_per_length", &Self::moment_per_length},
                      Field{"rod", &Self::rod}, Field{"follower", &Self::follower}};
  }
  template <class On>
  void act(On& on) const {
    const auto l = on.on_edges(moment_per_length, "moment_per_length");
    follower ? on.loads().add_follower_moment_per_length(on.grid(), l)
             : on.loads().add_moment_per_length(on.grid(), l);
  }
};

/// A body on the axis of a rod, fixed to one cross-section. It acts by its weight, where there is
/// `Gravity`, and vibrates with the rod.
struct PointMass {
  double mass;  ///< [kg]
  Place at = End::end;

  static constexpr const char* kind = "PointMass";
  static constexpr auto fields() {
    return std::tuple{Field{"mass", &PointMass::mass}, Field{"at", &PointMass::at}};
  }
  template <class Rods, class Loads>
  void check(const Rods&, const Loads&) const {
    require(mass > 0 && std::isfinite(mass), "mass: must be positive and finite, got ", mass);
  }
  template <class On>
  void act(On& on) const {
    if (on.gravity().isZero(0)) return;
    on.loads().add_force(on.grid(), mass * on.gravity(), on.site(at));
  }
};

/// The weight of all rods whose sections have a mass per length, and of point masses.
struct Gravity {
  Vec3 acceleration = {0, 0, -9.81};  ///< [m/s²]

  static constexpr const char* kind = "Gravity";
  static constexpr auto fields() {
    return std::tuple{Field{"acceleration", &Gravity::acceleration}};
  }
  template <class Rods, class Loads>
  static void check(const Rods& rods, const Loads& loads) {
    const auto heavy = [](const auto& rod) {
      return std::ranges::any_of(rod.mass, [](double m) { return m > 0; });
    };
    const auto has_mass = [](const auto& load) { return std::holds_alternative<PointMass>(load); };
    require(std::ranges::any_of(rods, heavy) || std::ranges::any_of(loads, has_mass),
            "Gravity: no rod has a mass; give its material a density, or its section a "
            "mass_per_length");
  }
  template <class On>
  void act(On& on) const {
    std::vector<Vec3> f;
    for (const double m : on.mass()) f.push_back(m * acceleration);
    on.loads().add_force_per_length(on.grid(), f);
  }
};

using Load = std::variant<Force, Moment, DistributedForce, DistributedMoment, Gravity, PointMass>;

// What loads have in common.
inline const char* kind_of(const Load& load) {
  return std::visit([](const auto& l) { return l.kind; }, load);
}
/// The point that it acts on, if it acts on one.
inline const Place* point_of(const Load& load) {
  return std::visit(
      [](const auto& l) -> const Place* {
        if constexpr (requires { l.at; }) return &l.at;
        return nullptr;
      },
      load);
}
/// The rod that it acts on; none: all.
inline std::optional<int> rod_of(const Load& load) {
  if (const auto* at = point_of(load)) return at->rod;
  return std::visit(
      [](const auto& l) -> std::optional<int> {
        if constexpr (requires { l.rod; }) return l.rod;
        return std::nullopt;
      },
      load);
}
inline bool follows(const Load& load) {
  return std::visit(
      [](const auto& l) {
        if constexpr (requires { l.follower; }) return l.follower;
        return false;
      },
      load);
}
/// Refuses what no rod can feel, beside these loads.
template <class Rods>
void check_load(const Load& load, const Rods& rods, const std::vector<Load>& loads) {
  std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.check(rods, loads); }) l.check(rods, loads);
      },
      load);
}
/// What pulls at all masses [m/s²].
inline Vec3 gravity_of(const std::vector<Load>& loads) {
  Vec3 sum = Vec3::Zero();
  for (const auto& load : loads)
    if (const auto* one = std::get_if<Gravity>(&load)) sum += one->acceleration;
  return sum;
}

namespace detail {

/// visit(one, its field) for all fields of type T of a load, constant or not.
template <class T, class L, class Visit>
void visit_fields(L& load, const Visit& visit) {
  const auto look = [&visit](auto& one, const auto& field) {
    if constexpr (std::same_as<std::remove_cvref_t<decltype(one.*field.member)>, T>)
      visit(one, field);
  };
  std::visit(
      [&](auto& one) {
        std::apply([&](const auto&... field) { (look(one, field), ...); }, one.fields());
      },
      load);
}

}  // namespace detail

/// visit(values, number of the rod, name) for all that a load has along its rod.
template <class L, class Visit>
void visit_along(L& load, const Visit& visit) {
  detail::visit_fields<Along<Vec3>>(load, [&visit](auto& one, const auto& field) {
    visit(one.*field.member, one.rod, field.name);
  });
}
/// visit(vector) for all that are the same along the rod.
template <class Visit>
void visit_vectors(const Load& load, const Visit& visit) {
  detail::visit_fields<Vec3>(
      load, [&visit](const auto& one, const auto& field) { visit(one.*field.member); });
}

}  // namespace pyrod
