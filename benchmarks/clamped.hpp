// SPDX-License-Identifier: BSD-3-Clause
/// \file The rod of the benchmarks: anisotropic, of length 1, clamped at its start.
#pragma once

#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/scene/loads.hpp>
#include <pyrod/scene/network.hpp>
#include <pyrod/statics/start/restricted.hpp>

namespace pyrod::benchmark {

/// In the plane with the curvature about a2 alone.
template <class Space>
Rod<Space> rod(int n, Vec3 K0 = {0.5, 0.2, 1}) {
  if (Space::spin == 1) K0 = {0, K0.y(), 0};
  return restricted<Space>(
      Rod<Spatial>::uniform(Grid::uniform(1, n), {1, 1.5, 0.7}, {4e3, 4e3, 1e4}, K0));
}

template <class Space>
Network<Space> clamped(const Rod<Space>& rod, const Loads<Space>& loads) {
  Network<Space> out;
  out.rods.push_back(rod);
  out.placements.emplace_back();
  out.loads.push_back(loads);
  out.nodes.emplace_back();
  out.nodes[0].free.resize(Space::dim, 0);
  out.nodes[0].turns.resize(Space::spin, 0);
  out.attachments.push_back({0, 0, 0, true});
  return out;
}

}  // namespace pyrod::benchmark
