// SPDX-License-Identifier: BSD-3-Clause
/// \file How a scene is solved: as a cantilever or as a network, on its edges or to a tolerance.
#pragma once

#include <pyrod/scene/scene_network.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_ladder.hpp>

namespace pyrod::detail {

/// One rod, clamped at its start and free at its end, under loads that do not follow it.
inline bool is_cantilever(const Scene& scene) {
  if (scene.rods.size() != 1 || !scene.joints.empty() || scene.supports.size() != 1) return false;
  const auto* clamp = std::get_if<Clamp>(&scene.supports[0]);
  return clamp && clamp->turns == 0 && clamp->at.rod == 0 && !scene.has_followers() &&
         clamp->at.on(Grid(scene.rods[0].edge_lengths)) == 0;
}

/// A template, so that only who solves a scene compiles all the solvers. `S`: `Settings`.
template <class S>
class SceneSolver {
 public:
  SceneSolver(const Scene& given, const S& settings)
      : settings_(settings), given_loads_(given.loads) {
    given.check_places();
    tol_ = settings.tol;
    if (!tol_ && given.chooses_edges()) tol_ = 1e-6;
    if (tol_) require(*tol_ > 0 && *tol_ <= 0.1, "tol: must be a number in (0, 0.1], got ", *tol_);
    settings.options.check();
    scene_.emplace(with_vertices_at_places(given, tol_.has_value()));
    if (tol_ && (settings.start || !settings.frames.empty()))
      given_ = with_vertices_at_places(given, false).rods;
    level0_.emplace(*scene_);
    network_ = network_of(*level0_);
  }

  Equilibrium solve() {
    bool cantilever = is_cantilever(*scene_) && settings_.stable && !settings_.eigenvalue;
    auto out = found(cantilever, start());
    if (cantilever && out.found.index > 0) {  // a saddle can be left as a network only
      NetworkStart from;
      from.frames = out.rod().curve.frames;
      out = found(false, from);
    }
    return out;
  }

 private:
  using Start = std::optional<NetworkStart>;

  Start start() const {
    const bool frames = !settings_.frames.empty();
    require(!frames || !settings_.start, "start: give it or frames, not both");
    if (!settings_.start && !frames) return std::nullopt;
    NetworkStart out;
    if (settings_.start)
      for (const auto& rod : settings_.start->found.rods)
        out.frames.insert(out.frames.end(), rod.curve.frames.begin(), rod.curve.frames.end());
    else
      out.frames = settings_.frames;
    if (brought(out.frames)) return out;
    if (settings_.start) return start_from(settings_.start->found.rods, network_.network);
    if (scene_->rods.size() == 1) continue_signs(out.frames);
    return out;
  }

  /// Frames of the edges that were given, on those of level 0, where that has more vertices.
  bool brought(std::vector<Quaternion>& frames) const {
    std::size_t edges = 0;
    for (const auto& rod : given_) edges += std::size_t(rod.edges());
    std::vector<Quaternion> out;
    std::size_t first = 0;
    for (std::size_t i = 0; i < given_.size() && frames.size() == edges; ++i) {
      const Grid old(given_[i].edge_lengths);
      const auto& ends = old.arc_lengths();
      for (const double s : centres(network_.network.rods[i].grid.arc_lengths())) {
        const auto behind = std::upper_bound(ends.begin(), ends.end(), s) - ends.begin();
        out.push_back(frames[first + std::size_t(std::clamp<std::ptrdiff_t>(behind - 1, 0,
                                                                            old.edges() - 1))]);
      }
      first += std::size_t(old.edges());
    }
    if (out.empty() || out.size() == frames.size()) return false;
    frames = std::move(out);
    return true;
  }

  /// A turn of the first cell may reach 2π: the signs go on from where the rod is held.
  void continue_signs(std::vector<Quaternion>& frames) const {
    Quaternion before = network_.plane.frame;
    for (auto& q : frames) {
      if (before.dot(q) < 0) q.coeffs() *= -1;
      before = q;
    }
  }

  /// Frames of a start on level 0 must be those of its edges.
  void check(const Start& start) const {
    int edges = 0;
    for (const auto& rod : network_.network.rods) edges += rod.edges();
    if (start) require_frames(start->frames, edges, "start");
  }

  Equilibrium found(bool cantilever, const Start& start) {
    check(start);
    Equilibrium out;
    out.made = network_.network.rods;
    if (tol_) {
      ReadyLadder ladder(out.made, level(cantilever), has_corners());
      auto climbed = ladder.climb(start, settings_.options, more(), *tol_, settings_.trace);
      out.found = std::move(climbed.solution);
      out.accuracy = Accuracy{*tol_, climbed.reached};
      if (cantilever) {  // its reactions are told by the forces and moments at the clamp
        auto& errors = out.accuracy->reached.errors;
        for (const auto& [told, by] : {std::pair(Quantity::reactions, Quantity::forces),
                                       std::pair(Quantity::reaction_moments, Quantity::moments)})
          errors[std::size_t(told)] = errors[std::size_t(by)];
      }
    } else {
      out.found = cantilever ? as_cantilever(start) : as_network(start);
    }
    react(out, cantilever);
    refuse_drift(out);
    look_at(out);
    return out;
  }

  NetworkOptions more() const {
    return {.stable = settings_.stable, .eigenvalue = settings_.eigenvalue};
  }

  Placement<Spatial> clamped_at() const { return network_.plane; }
  const Rod<Spatial>& rod() const { return network_.network.rods[0]; }

  SceneSolution as_cantilever(const Start& start) const {
    const auto frames = start ? start->frames : std::vector<Quaternion>{};
    return in_space(scene_->space, [&]<class Space>(Space) {
      return scene_solution(pyrod::solve<Space>(rod(), clamped_at(), level0_->loads(0), frames,
                                                settings_.options, settings_.trace),
                            rod().edges() * Space::spin);
    });
  }

  SceneSolution as_network(const Start& start) const {
    return in_space(scene_->space, [&]<class Space>(Space) {
      return scene_solution(run<Space>(network_.network, network_.plane, start, settings_.options,
                                       more(), settings_.trace));
    });
  }

  Level level(bool cantilever) const {
    return in_space(scene_->space, [&]<class Space>(Space) -> Level {
      if (!cantilever)
        return network_level<Space>([this](int level) -> PlacedNetwork {
          if (level == 0) return {network_.network, network_.plane};
          auto made = network_of(SceneOnGrids(*scene_, level));
          return {std::move(made.network), made.plane};
        });
      return cantilever_level<Space>(
          [this](int level) -> LoadedRod {
            const SceneOnGrids on(*scene_, level);
            return {on.rod(0), on.loads(0)};
          },
          clamped_at());
    });
  }

  /// A cantilever's reaction is what is missing to the balance at its clamp.
  void react(Equilibrium& out, bool cantilever) const {
    for (std::size_t i = 0; i < scene_->supports.size(); ++i) {
      const auto& at = place_of(scene_->supports[i]);
      const auto& found = out.found.rods[std::size_t(at.rod)];
      out.held.push_back(found.curve.positions[std::size_t(level0_->vertex(at))]);
      if (!cantilever) {
        const auto& node = out.found.nodes[std::size_t(network_.support_nodes[i])];
        out.reactions.push_back({node.reaction_force, node.reaction_moment});
        continue;
      }
      Vec3 sum = Vec3::Zero();
      for (const auto& F : found.load) sum += F;
      out.reactions.push_back({-sum, -found.moment[0] - level0_->loads(0).start_couple});
    }
  }

  bool has_corners() const {
    for (std::size_t i = 0; i < scene_->rods.size(); ++i)
      if (scene_->rods[i].corners &&
          std::ranges::any_of(level0_->rod(int(i)).K0, [](const Vec3& K) { return !K.isZero(0); }))
        return true;
    return false;
  }

  /// Forces that follow the rods, in directions in which nothing holds these: no equilibrium. Of
  /// dead forces it is known before the solve.
  void refuse_drift(const Equilibrium& out) const {
    if (!out.converged() || !scene_->has_followers()) return;
    Vec3 left = Vec3::Zero();
    double sizes = 0;
    const auto act = [&](const Vec3& F) { left += F, sizes += F.norm(); };
    for (const auto& rod : out.found.rods)
      for (const auto& F : rod.load) act(F);
    for (const auto& reaction : out.reactions) act(reaction.force);
    for (std::size_t i = 0; i < out.reactions.size(); ++i) {
      const auto& node = network_.network.nodes[std::size_t(network_.support_nodes[i])];
      if (node.spring == 0) left -= node.free * (node.free.transpose() * out.reactions[i].force);
    }
    require(left.norm() <= 1e-6 * sizes, "supports: nothing holds the rods against the force ",
            left.transpose(), " of the loads that follow them; hold a point of them");
  }

  /// Whether a user's function is asked on every grid; steps of lists have vertices.
  bool asks_functions() const {
    const auto of_load = [](const Load& load) {
      if (const auto* along = std::get_if<DistributedForce>(&load))
        return is_function(along->force_per_length);
      if (const auto* along = std::get_if<DistributedMoment>(&load))
        return is_function(along->moment_per_length);
      return false;
    };
    return std::ranges::any_of(given_loads_, of_load) ||
           std::ranges::any_of(scene_->rods, [](const auto& rod) {
             return is_function(rod.section) || is_function(rod.curvature);
           });
  }

  /// What a user should know before trusting it.
  void look_at(Equilibrium& out) const {
    const auto doubt = [&](const auto&... words) { out.doubts.push_back(text(words...)); };
    if (out.index() > 0 && settings_.stable)
      doubt("the equilibrium is unstable (index ", out.index(),
            "): a disturbed rod leaves it; start from a shape on the side that it would fall to");
    if (out.accuracy && out.converged() && !out.accuracy->reached.regular)
      doubt("the grids converge with order ", out.accuracy->reached.order,
            " instead of 2, so the results are those of the finest, ", out.accuracy->reached.edges,
            " edges");
    if (out.accuracy && out.converged() && out.accuracy->largest() > *tol_)
      doubt("rounding allows no more than ", out.accuracy->largest(),
            ": small differences of large numbers, as the stretch of a stiff member is of lengths");
    if (out.accuracy && out.converged() && asks_functions())
      doubt(
          "functions of arc length are taken to be smooth between vertices: give the places where "
          "one jumps or has a kink vertices (with_vertices), else errors may be told too small");
    for (std::size_t i = 0; i < out.made.size(); ++i) look_at(out, int(i), doubt);
  }

  template <class Doubt>
  static void look_at(const Equilibrium& out, int i, const Doubt& doubt) {
    const auto& rod = out.made[std::size_t(i)];
    const auto& strains = out.rod(i).strains;
    const std::string of = out.made.size() > 1 ? text(" of rod ", i) : "";
    for (std::size_t j = 0; j < strains.Γ.size(); ++j) {
      const Vec3 strain = strains.Γ[j] - Vec3::UnitZ();
      if (strains.Γ[j].z() <= 0)
        return doubt("edge ", j, of, " is compressed to ", strains.Γ[j].z(),
                     " of its length, turned inside out: the loads exceed what EA allows");
      if (strain.lpNorm<Eigen::Infinity>() > 3)
        return doubt("edge ", j, of, " is stretched or sheared by ",
                     strain.lpNorm<Eigen::Infinity>(),
                     ": EA or GA and the loads do not fit, look at their units");
    }
    for (std::size_t j = 0; j < strains.K.size() && !out.accuracy; ++j)
      if (const double turn = rod.grid.Δs(int(j)) * strains.K[j].norm(); turn > std::numbers::pi)
        return doubt("the rod turns by ", turn, " rad at vertex ", j, of,
                     ": more edges are needed for the shape to mean anything");
  }

  const S& settings_;
  const std::vector<Load>& given_loads_;
  std::optional<double> tol_;
  std::optional<Scene> scene_;  ///< with vertices at all places
  std::vector<RodSpec> given_;  ///< as a start has them, if these may have fewer
  std::optional<SceneOnGrids> level0_;
  SceneNetwork network_;
};

}  // namespace pyrod::detail
