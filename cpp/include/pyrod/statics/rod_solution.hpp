// SPDX-License-Identifier: BSD-3-Clause
/// \file All there is to know of the equilibrium of one rod, and how it is put into space.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/embedding.hpp>
#include <pyrod/rotation/unit.hpp>
#include <pyrod/statics/loads.hpp>

namespace pyrod {

/// Where a planar computation lies in space: its origin, and the frame whose a1 and a3 span the
/// plane. (Or the frame that a spatial computation was turned into.)
struct Clamp {
  Vec3 position = Vec3::Zero();
  Quaternion frame = Quaternion::Identity();
};

/// A rod in equilibrium. Spatial unless a name says material.
template <class Space>
struct RodSolution {
  CosseratCurve<Space> curve;
  Strains<Space> strains;
  std::vector<Point<Space>> force;           ///< n on the n edges
  std::vector<Point<Space>> material_force;  ///< N = Rᵀn
  std::vector<Spin<Space>>
      moment;  ///< m at the vertices; where the rod is held, of the cell behind
  std::vector<Spin<Space>> material_moment;             ///< M = C (K − K0)
  std::vector<typename Space::Rotation> vertex_frames;  ///< between the edges'; see `see_vertices`
  std::vector<Point<Space>> vertex_force;               ///< n at the vertices
  std::vector<Point<Space>> load;                       ///< what acts on the vertices
  Spin<Space> load_moment = Spin<Space>::Zero();        ///< sum of the couples that act on the rod
  double bend_twist_energy = 0, stretch_shear_energy = 0;
};

/// Frames and section forces at every `stride`-th vertex, inside the rod at its ends. Where a point
/// force acts on a vertex, the section force is the mean of those on its two sides.
template <class Space>
void see_vertices(RodSolution<Space>& s, const Rod<Space>& rod,
                  const std::vector<Point<Space>>& force, const Loads<Space>& loads,
                  int stride = 1) {
  const int n = rod.edges();
  s.vertex_frames.reserve(std::size_t(n / stride + 1));
  s.vertex_force.reserve(std::size_t(n / stride + 1));
  for (int j = 0; j <= n; j += stride) {
    s.vertex_frames.push_back(rod.frame_at(s.curve, j));
    const auto before = [&] {
      return Point<Space>(force[j - 1] - loads.share(j - 1, s.curve.frames[j - 1]));
    };
    const auto behind = [&] { return Point<Space>(force[j] + loads.share(j, s.curve.frames[j])); };
    s.vertex_force.push_back(j == 0   ? behind()
                             : j == n ? before()
                                      : Point<Space>((before() + behind()) / 2));
  }
}

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
RodSolution<Spatial> placed(const RodSolution<Space>& local, const Clamp& at) {
  RodSolution<Spatial> out;
  const auto to_space = [&](const auto& from, auto& to, auto&& map) {
    to.reserve(from.size());
    for (const auto& item : from) to.push_back(map(item));
  };
  const auto frame = [&](const auto& q) { return at.frame * embed(q); };
  const auto vector = [&](const auto& n) -> Vec3 { return rotate(at.frame, embed(n)); };
  to_space(local.curve.positions, out.curve.positions,
           [&](const auto& r) -> Vec3 { return at.position + vector(r); });
  to_space(local.curve.frames, out.curve.frames, frame);
  out.curve.start_frame = frame(local.curve.start_frame);
  out.curve.end_frame = frame(local.curve.end_frame);
  to_space(local.force, out.force, vector);
  to_space(local.load, out.load, vector);
  to_space(local.vertex_frames, out.vertex_frames, frame);
  to_space(local.vertex_force, out.vertex_force, vector);
  to_space(local.moment, out.moment,
           [&](const auto& m) -> Vec3 { return rotate(at.frame, embed_spin(m)); });
  to_space(local.strains.K, out.strains.K, [](const auto& K) -> Vec3 { return embed_spin(K); });
  to_space(local.strains.Γ, out.strains.Γ, [](const auto& Γ) -> Vec3 { return embed(Γ); });
  to_space(local.material_force, out.material_force,
           [](const auto& N) -> Vec3 { return embed(N); });
  to_space(local.material_moment, out.material_moment,
           [](const auto& M) -> Vec3 { return embed_spin(M); });
  out.load_moment = rotate(at.frame, embed_spin(local.load_moment));
  out.bend_twist_energy = local.bend_twist_energy;
  out.stretch_shear_energy = local.stretch_shear_energy;
  return out;
}

}  // namespace pyrod
