// SPDX-License-Identifier: BSD-3-Clause
/// \file The response of a scene's equilibrium, planar or spatial, with all that goes in and comes
/// out in space.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/linear/linear_response.hpp>
#include <pyrod/linear/numbers.hpp>
#include <pyrod/linear/response_change.hpp>
#include <pyrod/linear/rod_fields.hpp>
#include <pyrod/linear/scene_change.hpp>
#include <pyrod/linear/vertex_loads.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/scene_network.hpp>
#include <pyrod/solve/newton.hpp>
#include <pyrod/solve/singular_equilibrium.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/ready_scene.hpp>
#include <pyrod/statics/solving/posed.hpp>
#include <pyrod/statics/start/network_start.hpp>
#include <pyrod/statics/start/restricted_network.hpp>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace pyrod {

template <class Space>
class ResponseInSpace {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `near`: an equilibrium of the scene. Newton's method takes it to rounding.
  ResponseInSpace(const ReadyScene& ready, const Equilibrium& near)
      : nodes_(ready.network().support_nodes),
        posed_(ready.template posed<Space>()),
        x_(balanced(ready, near)),
        linear_(posed_->problem(), x_),
        change_(linear_.no_change()),
        numbers_(linear_.no_numbers()) {}

  /// Numbers of a scene that is like this one. The difference of two such is a change of numbers.
  Vector numbers(const ReadyScene& other) const {
    const auto net = restricted<Space>(other.network().network, posed_->here());
    net.check();
    const Layout<Space> layout(net);
    return flat(NumbersOf<Space>(layout, posed_->layout(), x_).values());
  }

  SceneChange push(const Vector& numbers) {
    numbers_ = Eigen::Map<const Items<Space>>(numbers.data(), item_width<Space>, numbers_.cols());
    linear_.push(numbers_, change_);
    return told(change_);
  }

  Vector weights() const { return linear_.weights(); }
  Vector solved(const Vector& rows) {
    Vector δ;
    linear_.solve(rows, δ);
    return δ;
  }
  SceneChange follow(const Vector& rows) {
    linear_.follow(rows, change_);
    return told(change_);
  }

  /// `rounding`: how far rounding moves the gradient; if there is no such, it must not.
  Vector pull(const SceneChange& weights, Vector* rounding) {
    auto given = weights;
    for (auto* items : {&change_.state, &change_.told}) items->setZero();
    change_.positions.setZero();
    for_each(given, change_, [this](const Vec3& weight, auto&& item, auto kind) {
      this->from_space(weight, item, kind);
    });
    change_.told(0, linear_.told_items().energy()) = weights.energy;
    for (int i = 0; i < int(weights.tensions.size()); ++i) {
      change_.told(0, linear_.told_items().tendon_length(i)) = weights.tendon_lengths[i];
      change_.told(0, linear_.told_items().tension(i)) = weights.tensions[i];
    }
    linear_.pull(change_, numbers_);
    const Vector out = flat(numbers_);
    linear_.pull_rounding(numbers_);
    const Vector moved = flat(numbers_);
    if (rounding)
      *rounding = moved;
    else if (moved.norm() > 1e-6 * out.norm())
      throw SingularEquilibrium(
          "linear: a rod that cannot stretch is held so straight that rounding of its length moves "
          "this gradient",
          0);
    return out;
  }

  std::vector<SceneChange> free() {
    std::vector<SceneChange> out;
    for (const auto& change : linear_.free()) out.push_back(told(change));
    return out;
  }
  std::vector<Vector> pushes_freely() {
    std::vector<Vector> out;
    for (int k = 0; k < int(linear_.free().size()); ++k) {
      linear_.pull_free(k, numbers_);
      out.push_back(flat(numbers_));
    }
    return out;
  }

  /// Of forces on the vertices of all rods.
  Vector of_forces(const std::vector<std::vector<Vec3>>& forces) const {
    Items<Space> out = linear_.no_numbers();
    for (int rod = 0; rod < int(forces.size()); ++rod)
      for (int j = 0; j < int(forces[rod].size()); ++j)
        out.col(linear_.number_items().force(rod, j)).template head<dim>() =
            restrict_point<Space>(unrotate(turn(), forces[rod][j]));
    return flat(out);
  }

  /// Of moments on the edges of all rods, in the components of their frames.
  Vector of_moments(const std::vector<std::vector<Vec3>>& moments) const {
    Items<Space> out = linear_.no_numbers();
    for (int rod = 0; rod < int(moments.size()); ++rod)
      for (int j = 0; j < int(moments[rod].size()); ++j)
        out.col(linear_.number_items().following(posed_->layout().edge(rod, j)))
            .template head<spin>() = restrict_spin<Space>(moments[rod][j]);
    return flat(out);
  }

  /// Of a dead moment on a vertex, in space.
  Vector of_moment(int rod, int vertex, const Vec3& moment) const {
    Items<Space> out = linear_.no_numbers();
    VertexLoads<Space>(posed_->layout(), rod, vertex)
        .add_moment(restrict_spin<Space>(unrotate(turn(), moment)), out);
    return flat(out);
  }

  /// Of a motion of a support: of its point, and its frame by a rotation vector, both in space.
  Vector of_motion(int support, const Vec3& shift, const Vec3& φ) const {
    Items<Space> out = linear_.no_numbers();
    const int v = nodes_.at(std::size_t(support));
    out.col(linear_.number_items().position(v)).template head<dim>() =
        restrict_point<Space>(unrotate(turn(), shift));
    const auto& q = posed_->layout().network().nodes[v].frame;
    out.col(linear_.number_items().frame(v)).template head<spin>() =
        rotate_spin(q.conjugate(), restrict_spin<Space>(unrotate(turn(), φ)));
    return flat(out);
  }

  /// Columns: unit forces, then moments; NaN where these leave the plane.
  Mat<6> compliance(int rod, int vertex) {
    const VertexLoads<Space> loads(posed_->layout(), rod, vertex);
    const auto& told = linear_.told_items();
    const int place = linear_.positions().column(rod, vertex),
              rotation = told.rotation(told.vertex(rod, vertex));
    const auto unit_load = [&](int k) -> const Items<Space>& {
      numbers_.setZero();
      k < 3 ? loads.add_force(restrict_point<Space>(axis_here(k)), numbers_)
            : loads.add_moment(restrict_spin<Space>(axis_here(k)), numbers_);
      return numbers_;
    };
    Mat<6> out;
    linear_.push_all(6, unit_load, change_, [&](int k, const auto& change) {
      out.col(k) << to_space(change.positions.col(place), Kind::point),
          to_space(change.told.col(rotation), Kind::moment);
      const Vec3 unit = axis_here(k), kept = k < 3 ? embed(restrict_point<Space>(unit))
                                                   : embed_spin(restrict_spin<Space>(unit));
      if ((kept - unit).norm() > 1e-9) out.col(k).setConstant(std::nan(""));
    });
    return out;
  }

  Vector of_rod(int rod, const RodFields& fields) const {
    Items<Space> out = linear_.no_numbers();
    RodNumbers<Space>(posed_->layout(), rod).multiply(fields, out);
    return flat(out);
  }
  RodFields to_rod(int rod, const Vector& numbers) const {
    const Items<Space> items =
        Eigen::Map<const Items<Space>>(numbers.data(), item_width<Space>, numbers_.cols());
    return RodNumbers<Space>(posed_->layout(), rod).pull(items);
  }

  SceneChange empty() const {
    SceneChange out;
    for (const auto& rod : posed_->network().rods) out.rods.emplace_back(rod.edges());
    out.reaction_forces.assign(nodes_.size(), Vec3::Zero());
    out.reaction_moments = out.reaction_forces;
    out.multipliers.assign(posed_->layout().spans().size(), Vec3::Zero());
    out.tendon_lengths.assign(posed_->network().tendons.size(), 0.);
    out.tensions = out.tendon_lengths;
    return out;
  }

  bool symmetric() const { return linear_.symmetric(); }

 private:
  enum class Kind { point, moment, material_point, material_turn };

  SceneChange told(const ResponseChange<Space>& change) const {
    SceneChange out = empty();
    for_each(out, change, [this](Vec3& told, const auto& item, auto kind) {
      told = this->to_space(item, kind);
    });
    const auto& items = linear_.told_items();
    out.energy = change.told(0, items.energy());
    for (int i = 0; i < int(out.tensions.size()); ++i) {
      out.tendon_lengths[i] = change.told(0, items.tendon_length(i));
      out.tensions[i] = change.told(0, items.tension(i));
    }
    return out;
  }

  NetworkState<Space> balanced(const ReadyScene& ready, const Equilibrium& near) const {
    const StateNear<Space> starts(posed_->layout(), posed_->here(), posed_->network().nodes.size());
    Options options;
    options.tolerance = 1e-9;
    Newton<NetworkProblem<Space>> newton(posed_->problem(), options, {}, false);
    auto found = newton.solve(starts.state(start_from(near.rods(), ready.network().network)),
                              Hessian::exact, true);
    require(found.converged(), "linearised: there is no equilibrium of these edges here, ",
            advice(found.status));
    return std::move(found.state);
  }

  const Quaternion& turn() const { return posed_->here().frame; }
  static Vector flat(const Items<Space>& items) { return items.reshaped(); }

  Vec3 to_space(const auto& item, Kind kind) const {
    const Point<Space> p = item.template head<dim>();
    const Spin<Space> s = item.template head<spin>();
    switch (kind) {
      case Kind::point:
        return rotate_back(embed(p));
      case Kind::moment:
        return rotate_back(embed_spin(s));
      case Kind::material_point:
        return embed(p);
      default:
        return embed_spin(s);
    }
  }
  /// An axis of space in the components of the computation.
  Vec3 axis_here(int k) const { return unrotate(turn(), Vec3(Vec3::Unit(k % 3))); }
  Vec3 rotate_back(const Vec3& v) const { return Space::dim == 3 ? v : Vec3(rotate(turn(), v)); }

  /// The transpose.
  void from_space(const Vec3& w, auto&& item, Kind kind) const {
    const Vec3 local = Space::dim == 3 ? w : Vec3(unrotate(turn(), w));
    switch (kind) {
      case Kind::point:
        item.template head<dim>() += restrict_point<Space>(local);
        break;
      case Kind::moment:
        item.template head<spin>() += restrict_spin<Space>(local);
        break;
      case Kind::material_point:
        item.template head<dim>() += restrict_point<Space>(w);
        break;
      default:
        item.template head<spin>() += restrict_spin<Space>(w);
    }
  }

  /// Calls visit(vector in space, item, kind) for all that is told but the energy.
  template <class Visit>
  void for_each(SceneChange& s, auto& c, Visit&& visit) const {
    const auto& layout = posed_->layout();
    const auto& told = linear_.told_items();
    const auto& state = linear_.state_items();
    for (int rod = 0; rod < int(s.rods.size()); ++rod) {
      auto& r = s.rods[rod];
      for (int j = 0; j < int(r.positions.size()); ++j) {
        const int v = told.vertex(rod, j);
        visit(r.positions[j], c.positions.col(linear_.positions().column(rod, j)), Kind::point);
        visit(r.vertex_frames[j], c.told.col(told.vertex_turn(v)), Kind::material_turn);
        visit(r.rotations[j], c.told.col(told.rotation(v)), Kind::moment);
        visit(r.K[j], c.told.col(told.curvature(v)), Kind::material_turn);
        visit(r.moment[j], c.told.col(told.moment(v)), Kind::moment);
      }
      for (int j = 0; j < int(r.frames.size()); ++j) {
        const int e = layout.edge(rod, j);
        visit(r.frames[j], c.state.col(state.turn(e)), Kind::material_turn);
        visit(r.force[j], c.state.col(state.force(e)), Kind::point);
        visit(r.Γ[j], c.told.col(told.strain(e)), Kind::material_point);
      }
    }
    for (int p = 0; p < int(s.multipliers.size()); ++p)
      visit(s.multipliers[p], c.state.col(state.force(layout.first_edge(p))), Kind::point);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      visit(s.reaction_forces[i], c.told.col(told.reaction_force(nodes_[i])), Kind::point);
      visit(s.reaction_moments[i], c.told.col(told.reaction_moment(nodes_[i])), Kind::moment);
    }
  }

  std::vector<int> nodes_;
  std::shared_ptr<const Posed<Space>> posed_;
  NetworkState<Space> x_;
  LinearResponse<Space> linear_;
  ResponseChange<Space> change_;
  Items<Space> numbers_;
};

}  // namespace pyrod
