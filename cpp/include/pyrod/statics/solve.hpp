// SPDX-License-Identifier: BSD-3-Clause
/// \file One call for every rod: space and model chosen at run time, results always in space.
#pragma once

#include <pyrod/rotation/embedding.hpp>
#include <pyrod/statics/cantilever.hpp>

namespace pyrod {

enum class Dimension { planar, spatial };
enum class ModelKind { cosserat, extensible, inextensible };

/// Holds the start of a rod in position and frame.
struct Clamp {
  Vec3 position = Vec3::Zero();
  Quaternion frame = Quaternion::Identity();
};

/// The planar rod in the a1–a3 plane, or the rod itself. What leaves the plane is refused.
template <class Space>
Rod<Space> restricted(const Rod<Spatial>& rod) {
  Rod<Space> out{rod.grid, {}, {}, {}};
  for (const auto& C : rod.bending) out.bending.push_back(restrict_spin<Space>(C));
  for (const auto& C : rod.stretching) out.stretching.push_back(restrict_point<Space>(C));
  for (std::size_t j = 0; j < rod.K0.size(); ++j) {
    out.K0.push_back(restrict_spin<Space>(rod.K0[j]));
    require(embed_spin(out.K0[j]) == rod.K0[j], "K0[", j,
            "]: a planar rod bends about director 2 "
            "only, got (",
            rod.K0[j].transpose(), "); choose the spatial rod");
  }
  return out;
}

/// Loads in the clamp's frame, restricted to the space; what leaves it by more than rounding is
/// refused.
template <class Space>
Loads<Space> restricted(const Loads<Spatial>& loads, const Quaternion& frame) {
  loads.check();
  double scale = 0;
  for (const auto& F : loads.force) scale = std::max(scale, F.norm());
  double spin_scale = loads.end_couple.norm();
  for (const auto& m : loads.couple) spin_scale = std::max(spin_scale, m.norm());

  Loads<Space> out(int(loads.couple.size()));
  const auto point = [&](const Vec3& F) {
    const Vec3 local = unrotate(frame, F);
    const Point<Space> kept = restrict_point<Space>(local);
    require((local - embed(kept)).norm() <= 1e-12 * scale, "loads: a force (", F.transpose(),
            ") leaves the plane of the clamp's directors a1 and a3; choose the spatial rod");
    return kept;
  };
  const auto spin = [&](const Vec3& m) {
    const Vec3 local = unrotate(frame, m);
    const Spin<Space> kept = restrict_spin<Space>(local);
    require((local - embed_spin(kept)).norm() <= 1e-12 * spin_scale, "loads: a moment (",
            m.transpose(), ") is not about the clamp's director a2; choose the spatial rod");
    return kept;
  };
  for (std::size_t j = 0; j < loads.force.size(); ++j) out.force[j] = point(loads.force[j]);
  for (std::size_t j = 0; j < loads.couple.size(); ++j) out.couple[j] = spin(loads.couple[j]);
  out.end_couple = spin(loads.end_couple);
  return out;
}

/// A solution in the clamp's frame, put where the clamp is.
template <class Space>
Solution<Spatial> placed(const Solution<Space>& local, const Clamp& clamp) {
  Solution<Spatial> out;
  const auto to_space = [&](const auto& from, auto& to, auto&& map) {
    to.reserve(from.size());
    for (const auto& item : from) to.push_back(map(item));
  };
  const auto frame = [&](const auto& q) { return clamp.frame * embed(q); };
  to_space(local.curve.positions, out.curve.positions,
           [&](const auto& r) -> Vec3 { return clamp.position + rotate(clamp.frame, embed(r)); });
  to_space(local.curve.frames, out.curve.frames, frame);
  out.curve.start_frame = clamp.frame;
  out.curve.end_frame = frame(local.curve.end_frame);
  to_space(local.force, out.force, [&](const auto& n) { return rotate(clamp.frame, embed(n)); });
  to_space(local.moment, out.moment,
           [&](const auto& m) { return rotate(clamp.frame, embed_spin(m)); });
  to_space(local.strains.K, out.strains.K, [](const auto& K) -> Vec3 { return embed_spin(K); });
  to_space(local.strains.Γ, out.strains.Γ, [](const auto& Γ) -> Vec3 { return embed(Γ); });
  to_space(local.material_force, out.material_force,
           [](const auto& N) -> Vec3 { return embed(N); });
  to_space(local.material_moment, out.material_moment,
           [](const auto& M) -> Vec3 { return embed_spin(M); });
  out.bend_twist_energy = local.bend_twist_energy;
  out.stretch_shear_energy = local.stretch_shear_energy;
  out.status = local.status;
  out.index = local.index;
  out.residual = local.residual;
  out.load_steps = local.load_steps;
  out.record = local.record;
  return out;
}

/// Equilibrium of a rod held by `clamp` under dead loads. `start`: frames of the edges to start
/// from, trusted to be near; none: the shape at rest.
template <class Space, class Model>
Solution<Spatial> solve(const Rod<Spatial>& rod, const Clamp& clamp, const Loads<Spatial>& loads,
                        const std::vector<Quaternion>& start = {}, const Options& options = {},
                        const Trace& trace = {}) {
  const Cantilever<Space, Model> scene(restricted<Space>(rod), Point<Space>::Zero(),
                                       Space::Rotation::Identity(),
                                       restricted<Space>(loads, clamp.frame));
  if (start.empty()) return placed(scene.solve(options, trace), clamp);
  typename Cantilever<Space, Model>::Frames frames;
  for (const auto& q : start)
    frames.push_back(restrict_rotation<Space>(clamp.frame.conjugate() * q));
  return placed(scene.solve(std::move(frames), options, trace), clamp);
}

inline Solution<Spatial> solve(const Rod<Spatial>& rod, Dimension dimension, ModelKind model,
                               const Clamp& clamp, const Loads<Spatial>& loads,
                               const std::vector<Quaternion>& start = {},
                               const Options& options = {}, const Trace& trace = {}) {
  const auto in = [&]<class Space>(Space) {
    const auto with = [&]<class M>(M) {
      return solve<Space, M>(rod, clamp, loads, start, options, trace);
    };
    switch (model) {
      case ModelKind::cosserat:
        return with(Cosserat{});
      case ModelKind::extensible:
        return with(ExtensibleKirchhoff{});
      case ModelKind::inextensible:
        break;
    }
    return with(InextensibleKirchhoff{});
  };
  return dimension == Dimension::planar ? in(Planar{}) : in(Spatial{});
}

}  // namespace pyrod
