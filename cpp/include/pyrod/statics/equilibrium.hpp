// SPDX-License-Identifier: BSD-3-Clause
/// \file The answer: a scene in equilibrium, and how it was found.
#pragma once

#include <pyrod/core/on_demand.hpp>
#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/solve/iteration.hpp>
#include <pyrod/solve/options.hpp>
#include <pyrod/solve/status.hpp>
#include <pyrod/statics/solution/quantity.hpp>
#include <pyrod/statics/solution/reached.hpp>
#include <pyrod/statics/solution/rod_solution.hpp>
#include <pyrod/statics/solution/solution.hpp>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pyrod {

/// What a support exerts on the rods, the moment about its own point.
struct Reaction {
  Vec3 force, moment;
};

/// How far a solution is from that of the continuous rods: what was asked for, and what was
/// reached. Errors are those of the discretisation, see `quantity_names` for what is told.
struct Accuracy {
  double tol;
  Reached reached;
  std::string reason = {};  ///< what may be why, if the grids do not converge as they should
  bool unresolved = false;  ///< a function has more jumps and kinks than can be told apart

  double error(Quantity what) const { return reached.errors[std::size_t(what)]; }
  /// The largest of those that `tol` is for: vertices and sums.
  double largest() const {
    return *std::max_element(reached.errors.begin(), reached.errors.begin() + vertex_quantities);
  }
};

/// What one should know before trusting an equilibrium, in words.
struct Doubt {
  enum class Kind { unstable, accuracy, strain } kind;
  std::string words;
};

/// What there is to know of a shape in equilibrium.
struct Shape {
  std::vector<RodSolution<Spatial>> rods;
  std::vector<Reaction> reactions = {};               ///< of the supports, in their order
  std::vector<Vec3> held = {};                        ///< the points that they hold
  std::vector<Rod<Spatial>> made = {};                ///< the rods as they were solved
  std::vector<TendonSolution<Spatial>> tendons = {};  ///< in the order of the scene's actuators
};

/// Everything there is to know; values like any other. The shape is worked out when it is first
/// asked for.
class Equilibrium {
 public:
  Course course;                          ///< how it was found
  std::vector<Vec3> mode = {};            ///< of all edges, see `Solution`
  std::optional<Accuracy> accuracy = {};  ///< of a solve with a tolerance
  std::vector<Doubt> doubts = {};         ///< what one should know before trusting it

  Equilibrium() = default;
  explicit Equilibrium(Shape known)
      : shape_(std::make_shared<const OnDemand<Shape>>(std::move(known))) {}
  Equilibrium(Course found, std::function<Shape()> shape)
      : course(std::move(found)),
        shape_(std::make_shared<const OnDemand<Shape>>(std::move(shape))) {}

  bool converged() const { return course.converged(); }
  Status status() const { return course.status; }
  /// What happened and what to try.
  std::string_view advice() const { return pyrod::advice(course.status); }
  /// Number of unstable modes; −1: the loads have no potential.
  int index() const { return course.index; }
  bool stable() const { return course.index == 0; }

  const Shape& shape() const {
    require(shape_ != nullptr, "shape: nothing was solved");
    return shape_->get();
  }
  const std::vector<RodSolution<Spatial>>& rods() const { return shape().rods; }
  const RodSolution<Spatial>& rod(int i = 0) const { return rods()[std::size_t(i)]; }
  const Vec3& tip(int i = 0) const { return rod(i).curve.positions.back(); }
  const Quaternion& tip_frame(int i = 0) const { return rod(i).vertex_frames.back(); }
  const std::vector<Reaction>& reactions() const { return shape().reactions; }
  const std::vector<TendonSolution<Spatial>>& tendons() const { return shape().tendons; }

  /// Elastic energy [J].
  double energy() const {
    double sum = 0;
    for (const auto& r : rods()) sum += r.bend_twist_energy + r.stretch_shear_energy;
    return sum;
  }

  /// What is missing to the balance of all forces and of all moments, relative to their sizes. From
  /// positions, loads and reactions alone, by no formula of the solver.
  std::pair<double, double> balance() const {
    Sum force, moment;
    double most_force = 0, most_moment = 0, length = 0;
    for (const auto& r : rods()) {
      for (std::size_t j = 0; j < r.load.size(); ++j) {
        force.add(r.load[j]);
        moment.add(r.curve.positions[j].cross(r.load[j]));
      }
      moment.add(r.load_moment);
      for (const auto& n : r.force) most_force = std::max(most_force, n.norm());
      for (const auto& m : r.moment) most_moment = std::max(most_moment, m.norm());
      if (r.backbone_force.empty()) continue;  // else sums may be nothing beside their parts
      for (const auto& n : r.backbone_force) most_force = std::max(most_force, n.norm());
      for (const auto& m : r.material_moment) most_moment = std::max(most_moment, m.norm());
    }
    for (std::size_t i = 0; i < reactions().size(); ++i) {
      force.add(reactions()[i].force);
      moment.add(shape().held[i].cross(reactions()[i].force));
      moment.add(reactions()[i].moment);
    }
    for (const auto& r : shape().made) length = std::max(length, r.grid.length());
    const double F = force.sizes + most_force, M = moment.sizes + most_moment + length * F;
    return {force.sum.norm() / (F > 0 ? F : 1), moment.sum.norm() / (M > 0 ? M : 1)};
  }

 private:
  struct Sum {
    Vec3 sum = Vec3::Zero();
    double sizes = 0;
    void add(const Vec3& v) { sum += v, sizes += v.norm(); }
  };

  std::shared_ptr<const OnDemand<Shape>> shape_;
};

/// How to solve.
struct Settings {
  /// The largest relative error wanted; none: the scene's edges as they are, and 1e-6 where rods
  /// leave them to the solver.
  std::optional<double> tol = {};
  bool stable = true;  ///< leave saddles along their unstable modes; else any equilibrium will do
  bool eigenvalue = false;  ///< find the lowest eigenvalue of the second variation, too
  const Equilibrium* start =
      nullptr;  ///< of a similar scene with as many edges, trusted to be near
  std::vector<Quaternion> frames = {};  ///< instead: those of all edges
  Options options = {};
  Trace trace = {};  ///< sees each iteration
  /// Sees what the grids of a tolerance have reached, each time that one is done.
  std::function<void(const SoFar&)> progress = {};
};

}  // namespace pyrod
