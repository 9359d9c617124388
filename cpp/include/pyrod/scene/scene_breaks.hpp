// SPDX-License-Identifier: BSD-3-Clause
/// \file Vertices where the functions of arc length in a scene jump or have kinks.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/scene/actuator.hpp>
#include <pyrod/scene/along.hpp>
#include <pyrod/scene/break_search.hpp>
#include <pyrod/scene/breaks.hpp>
#include <pyrod/scene/load.hpp>
#include <pyrod/scene/rod_spec.hpp>
#include <pyrod/scene/samples.hpp>
#include <pyrod/scene/scene.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace pyrod {

/// What is known of the functions of arc length in a scene.
struct Smoothness {
  bool unresolved = false;  ///< one has more jumps and kinks than can be told apart
  /// What may be why, if grids do not converge as they should.
  std::string reason = "something in the scene is smaller than the edges";
};

namespace detail {

inline Vec3 numbers_of(const Vec3& v) { return v; }
inline Vec2 numbers_of(const Vec2& v) { return v; }
/// Rigid strains are zero compliances.
inline Vec<7> numbers_of(const Section& c) {
  return {c.EI1, c.EI2, c.GJ, 1 / c.GA1, 1 / c.GA2, 1 / c.EA, c.mass_per_length};
}

template <class T>
Breaks breaks_along(const FunctionAlong<T>& function, double length) {
  return breaks_of(
      [&](std::span<const double> s, Samples& values) {
        values.resize(std::ssize(s), decltype(numbers_of(function(0)))::RowsAtCompileTime);
        for (std::size_t i = 0; i < s.size(); ++i)
          values.row(Eigen::Index(i)) = numbers_of(function(s[i]));
      },
      length);
}

/// The rod with vertices at the breaks; they are vertices that are there, if so near.
inline RodSpec broken(RodSpec rod, std::vector<double> at) {
  if (at.empty()) return rod;
  const double length = rod.length();
  std::vector<double> there = rod.kept;
  there.insert(there.end(), {0, length});
  if (!rod.chooses) {
    const Grid grid(rod.edge_lengths);
    there.assign(grid.arc_lengths().begin(), grid.arc_lengths().end());
  }
  for (double& s : at) {
    const auto off = [&](double vertex) { return std::abs(vertex - s); };
    const double nearest = std::ranges::min(there, {}, off);
    if (off(nearest) < 1e-8 * length) s = nearest;
  }
  return with_vertices(std::move(rod), at);
}

/// Gives rods vertices at the breaks of functions.
class BreakFinder {
 public:
  explicit BreakFinder(Scene& scene) : scene_(scene) {}

  /// Functions that are empty are refused where they are sampled. What is found; null: nothing.
  template <class T>
  const Breaks* look(const Along<T>& along, int rod, const std::string& name) {
    const auto* function = std::get_if<FunctionAlong<T>>(&along);
    if (!function || !*function) return nullptr;
    auto& spec = scene_.rods[std::size_t(rod)];
    const double length = spec.length();
    const auto find = [&] { return breaks_along(*function, length); };
    const auto& breaks = function->breaks(length, find);
    spec = broken(std::move(spec), breaks.at);
    if (smooth_.unresolved) return &breaks;
    smooth_.unresolved = breaks.unresolved;
    smooth_.reason =
        breaks.unresolved
            ? name + " has more jumps and kinks than can be told apart, or is singular"
            : "a load, a section or the curvature may jump where that was not found; give it a "
              "vertex (Rod.with_vertices)";
    return &breaks;
  }

  /// Kinks of a polygon are known.
  void look(Tendon& tendon, const std::string& name) {
    if (tendon.kinks.empty())
      if (const auto* breaks = look(tendon.offset, tendon.rod, name)) tendon.kinks = breaks->at;
  }

  void look(const std::vector<Load>& loads) {
    for (std::size_t i = 0; i < loads.size(); ++i)
      visit_along(loads[i], [&](const Along<Vec3>& along, int rod, const char*) {
        look(along, rod, text("load ", i));
      });
  }

  const Smoothness& smoothness() const { return smooth_; }

 private:
  Scene& scene_;
  Smoothness smooth_;
};

}  // namespace detail

/// Gives the rods of a scene, which have vertices at all places, some where functions break, too.
/// Loads brought to the grid as by levers, or what jumps inside an edge, would leave errors that
/// are not regular. `given`: the scene's loads, before lists became steps, which have vertices.
inline Smoothness add_vertices_at_breaks(Scene& scene, const std::vector<Load>& given) {
  detail::BreakFinder finder(scene);
  finder.look(given);
  for (int i = 0; i < int(scene.rods.size()); ++i) {
    const auto& rod = scene.rods[std::size_t(i)];
    finder.look(rod.section, i, text("the section of rod ", i));
    finder.look(rod.curvature, i, text("the curvature of rod ", i));
  }
  for (std::size_t i = 0; i < scene.actuators.size(); ++i)
    finder.look(std::get<Tendon>(scene.actuators[i]), text("the offset of tendon ", i));
  return finder.smoothness();
}

}  // namespace pyrod
