// SPDX-License-Identifier: BSD-3-Clause
/// \file Whether a shape may be strained beyond what edges or the model can mean.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <cmath>
#include <cstddef>
#include <type_traits>

namespace pyrod {

/// A quick look from the safe side: where it finds nothing, no strain reaches 0.9 and no cell turns
/// by 3 rad or more.
template <class Space>
class Strained {
 public:
  using Rotation = typename Space::Rotation;

  Strained(const NetworkProblem<Space>& problem, const NetworkState<Space>& x)
      : problem_(problem), layout_(problem.layout()), net_(layout_.network()), x_(x) {}

  bool perhaps() const {
    if (problem_.has_terms()) return true;
    for (int rod = 0; rod < int(net_.rods.size()); ++rod)
      if (turned(rod)) return true;
    return stretched();
  }

 private:
  static constexpr double most_turn = 3, most_strain = 0.9;

  /// By more than an angle θ < π, one way or the other; a quaternion tells its half.
  static bool turns_by_more(const Rotation& a, const Rotation& b, double θ) {
    if constexpr (std::is_same_v<Space, Spatial>)
      return !(a.dot(b) >= std::cos(θ / 2));
    else
      return !(std::abs(b.radians - a.radians) <= θ);
  }

  bool turned(int rod) const {
    const auto& r = net_.rods[rod];
    const int n = r.edges();
    const Rotation* q = x_.frames.data() + layout_.edge(rod, 0);
    const double half = std::cos(most_turn / 2);
    if constexpr (std::is_same_v<Space, Spatial>) {
      for (int j = 1; j < n; ++j)
        if (!(q[j - 1].dot(q[j]) >= half)) return true;
    } else {
      for (int j = 1; j < n; ++j)
        if (turns_by_more(q[j - 1], q[j], most_turn)) return true;
    }
    return (r.grid.closed() &&
            turns_by_more(q[n - 1], principal_near(q[0], q[n - 1]), most_turn)) ||
           turned_where_held(rod) || turned_at_free_ends(rod);
  }

  /// The same frame, named so that it is less than half a turn away from another.
  static Rotation principal_near(const Rotation& q, const Rotation& to) {
    return to * principal(to.conjugate() * q);
  }

  /// Halves of cells, each by half of it.
  bool turned_where_held(int rod) const {
    const auto& r = net_.rods[rod];
    for (const auto& a : layout_.attached(rod)) {
      if (!a.rigid) continue;
      const Rotation h = held_frame(x_, a);
      const bool closed = r.grid.closed();
      const int behind = a.vertex < r.edges() ? a.vertex
                         : closed             ? 0
                                              : -1,
                before = a.vertex > 0 ? a.vertex - 1
                         : closed     ? r.edges() - 1
                                      : -1;
      for (const int j : {before, behind}) {
        if (j < 0) continue;
        const Rotation& q = x_.frames[layout_.edge(rod, j)];
        if (turns_by_more(principal_near(q, h), h, most_turn / 2)) return true;
      }
    }
    return false;
  }

  /// By the moments there.
  bool turned_at_free_ends(int rod) const {
    const auto& r = net_.rods[rod];
    const auto& loads = net_.loads[rod];
    const auto turn = [&](int j, double moment) {
      return r.grid.Δs(j) * (r.K0[j].norm() + moment / r.bending[j].minCoeff());
    };
    return !(turn(0, loads.start_moment.norm()) <= most_turn / 2 &&
             turn(r.grid.vertices() - 1,
                  loads.end_moment.norm() + loads.follower_end_moment.norm()) <= most_turn / 2);
  }

  bool stretched() const {
    typename NetworkProblem<Space>::Acting changed;
    const auto& now = problem_.acting(x_, changed);
    for (int p = 0; p < int(layout_.spans().size()); ++p)
      for (int e = layout_.first_edge(p); e <= layout_.last_edge(p); ++e) {
        const double S = problem_.compliance(e).maxCoeff();
        if (S > 0 &&
            !(S * S * (now.known[e] + x_.forces[p]).squaredNorm() <= most_strain * most_strain))
          return true;
      }
    return false;
  }

  const NetworkProblem<Space>& problem_;
  const Layout<Space>& layout_;
  const Network<Space>& net_;
  const NetworkState<Space>& x_;
};

}  // namespace pyrod
