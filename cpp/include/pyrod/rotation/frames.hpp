// SPDX-License-Identifier: BSD-3-Clause
/// \file Lists of frames, several at a time.
#pragma once

#include <pyrod/core/dispatch.hpp>
#include <pyrod/core/pack.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <algorithm>
#include <array>
#include <cstddef>

namespace pyrod {

/// Consecutive frames as a pack, and back.
template <class Real>
QuaternionOf<Real> load_frames(const Quaternion* q) {
  const double* from = q->coeffs().data();
  return {Real::load(from + 3, 4), Real::load(from, 4), Real::load(from + 1, 4),
          Real::load(from + 2, 4)};
}
template <class Real>
AngleOf<Real> load_frames(const Angle* q) {
  return {Real::load(&q->radians)};
}

template <class Real>
void store_frames(const QuaternionOf<Real>& frames, Quaternion* q) {
  for (int i = 0; i < 4; ++i) frames.coeffs()[i].store(q->coeffs().data() + i, 4);
}
template <class Real>
void store_frames(const AngleOf<Real>& frames, Angle* q) {
  frames.radians.store(&q->radians);
}

/// A kernel: n frames, each moved by its increment, one increment after another in `turns`.
template <class Space>
struct MoveFrames {
  using Rotation = typename Space::Rotation;
  static constexpr int spin = Space::spin;

  int n;
  const Rotation* frames;
  const double* turns;
  Rotation* out;

  template <int W>
  void run() const {
    int j = 0;
    for (; j + W <= n; j += W) move<W>(frames + j, turns + std::ptrdiff_t(spin) * j, out + j);
    if (j == n) return;
    std::array<Rotation, W> rest, moved_rest;
    std::array<double, spin * W> turns_of_rest{};
    rest.fill(Rotation::Identity());
    std::copy(frames + j, frames + n, rest.data());
    std::copy(turns + std::ptrdiff_t(spin) * j, turns + std::ptrdiff_t(spin) * n,
              turns_of_rest.data());
    move<W>(rest.data(), turns_of_rest.data(), moved_rest.data());
    std::copy(moved_rest.data(), moved_rest.data() + (n - j), out + j);
  }

 private:
  template <int W>
  static void move(const Rotation* q, const double* δ, Rotation* to) {
    using Real = Pack<W>;
    Spin<Space, Real> φ;
    for (int i = 0; i < spin; ++i) φ[i] = Real::load(δ + i, spin);
    store_frames<Real>(moved(load_frames<Real>(q), φ), to);
  }
};

}  // namespace pyrod
