// SPDX-License-Identifier: BSD-3-Clause
/// \file All there is to know of the equilibrium of one rod, and how it is put into space.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/placement.hpp>

#include <cstddef>
#include <vector>

namespace pyrod {

/// What holds just before an inner vertex at which something acts, holds or jumps.
template <class Space>
struct Before {
  int vertex;
  Point<Space> force;
  Spin<Space> K, moment;
  bool halves;  ///< the frame there is told by what the halves of the cell turn
};

/// The largest norms along a rod, between its vertices too; see `Extremes`.
struct Largest {
  double K = 0, force = 0, moment = 0;
};

/// A rod in equilibrium. Spatial unless a name says material. What jumps at a vertex is told as it
/// is just behind, but at the end of the rod; for the other side see `before`.
template <class Space>
struct RodSolution {
  CosseratCurve<Space> curve;
  Strains<Space> strains;
  std::vector<Point<Space>> force;                      ///< n on the n edges
  std::vector<Point<Space>> material_force;             ///< N = Rᵀn
  std::vector<Spin<Space>> moment;                      ///< m at the vertices
  std::vector<Spin<Space>> material_moment;             ///< M = C (K − K0)
  std::vector<typename Space::Rotation> vertex_frames;  ///< between the edges'; see `Vertices`
  std::vector<Point<Space>> vertex_force;               ///< n at the vertices
  std::vector<Point<Space>> backbone_force;             ///< without tendons'; none: there are none
  std::vector<Before<Space>> before;                    ///< inner vertices, in their order
  std::vector<Point<Space>> load;                       ///< what acts on the vertices
  Spin<Space> load_moment = Spin<Space>::Zero();        ///< sum of the moments that act on the rod
  double bend_twist_energy = 0, stretch_shear_energy = 0;
  Largest largest;
};

/// A node in equilibrium, and what its support exerts on it.
template <class Space>
struct NodeSolution {
  Point<Space> position, reaction_force;
  typename Space::Rotation frame;
  Spin<Space> reaction_moment;
};

/// Forces on vertices brought to every `stride`-th, as by levers.
template <class Vector>
std::vector<Vector> lumped(const std::vector<Vector>& forces, int stride) {
  std::vector<Vector> out((forces.size() - 1) / std::size_t(stride) + 1, Vector::Zero());
  for (std::size_t j = 0; j < forces.size(); ++j) {
    const std::size_t J = j / std::size_t(stride), rest = j % std::size_t(stride);
    const double part = double(rest) / stride;
    out[J] += (1 - part) * forces[j];
    if (rest > 0) out[J + 1] += part * forces[j];
  }
  return out;
}

/// A solution in the frame of `at`, put where that is.
template <class Space>
RodSolution<Spatial> placed(const RodSolution<Space>& local, const Placement<Spatial>& at) {
  RodSolution<Spatial> out;
  const auto to_space = [&](const auto& from, auto& to, auto&& map) {
    to.reserve(from.size());
    for (const auto& item : from) to.push_back(map(item));
  };
  const Mat3 R = matrix(at.frame);
  const auto frame = [&](const auto& q) { return at.frame * embed(q); };
  const auto vector = [&](const auto& n) -> Vec3 { return R * embed(n); };
  to_space(local.curve.positions, out.curve.positions,
           [&](const auto& r) -> Vec3 { return at.position + vector(r); });
  to_space(local.curve.frames, out.curve.frames, frame);
  out.curve.start_frame = frame(local.curve.start_frame);
  out.curve.end_frame = frame(local.curve.end_frame);
  to_space(local.force, out.force, vector);
  to_space(local.load, out.load, vector);
  to_space(local.vertex_frames, out.vertex_frames, frame);
  to_space(local.vertex_force, out.vertex_force, vector);
  to_space(local.backbone_force, out.backbone_force, vector);
  to_space(local.moment, out.moment, [&](const auto& m) -> Vec3 { return R * embed_spin(m); });
  to_space(local.strains.K, out.strains.K, [](const auto& K) -> Vec3 { return embed_spin(K); });
  to_space(local.strains.Γ, out.strains.Γ, [](const auto& Γ) -> Vec3 { return embed(Γ); });
  to_space(local.material_force, out.material_force,
           [](const auto& N) -> Vec3 { return embed(N); });
  to_space(local.material_moment, out.material_moment,
           [](const auto& M) -> Vec3 { return embed_spin(M); });
  to_space(local.before, out.before, [&](const auto& b) -> Before<Spatial> {
    return {b.vertex, vector(b.force), embed_spin(b.K), R * embed_spin(b.moment), b.halves};
  });
  out.load_moment = R * embed_spin(local.load_moment);
  out.bend_twist_energy = local.bend_twist_energy;
  out.stretch_shear_energy = local.stretch_shear_energy;
  out.largest = local.largest;
  return out;
}

}  // namespace pyrod
