// SPDX-License-Identifier: BSD-3-Clause
/// \file Random input with a fixed seed: the same numbers with every standard library.
#pragma once

#include <pyrod/rod/rod.hpp>

#include <random>

namespace pyrod::test {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double number(double low = -1, double high = 1) {
    return low + (high - low) * double(engine_() >> 11) * 0x1p-53;
  }

  /// Components in (−1, 1).
  template <int N>
  Vec<N> vector() {
    return Vec<N>::NullaryExpr([this] { return number(); });
  }
  Vector vector(int size) {
    return Vector::NullaryExpr(size, [this](Eigen::Index) { return number(); });
  }

  /// Components in (low, high).
  template <int N>
  Vec<N> between(double low, double high) {
    return Vec<N>::NullaryExpr([=, this] { return number(low, high); });
  }

  /// A vector of length `angle`, in any direction.
  template <class Space>
  Spin<Space> turn(double angle) {
    Spin<Space> u = vector<Space::spin>();
    while (u.norm() < 0.1) u = vector<Space::spin>();
    return angle * u.normalized();
  }

  template <class Space>
  typename Space::Rotation rotation(double angle = 2.5) {
    return exp(turn<Space>(angle));
  }

  /// Edges that differ up to threefold.
  Grid grid(int edges, double length = 1) {
    Vector h = Vector::NullaryExpr(edges, [this](Eigen::Index) { return number(1, 3); });
    return Grid(h * (length / h.sum()));
  }

  /// Everything that may vary along a rod does.
  template <class Space>
  Rod<Space> rod(int edges, double length = 1, double curvature = 1) {
    Rod<Space> out{grid(edges, length), {}, {}, {}};
    for (int j = 0; j <= edges; ++j) {
      out.bending.push_back(between<Space::spin>(0.5, 3));
      out.K0.push_back(curvature * vector<Space::spin>());
      if (j < edges) out.stretching.push_back(between<Space::dim>(5, 30));
    }
    return out;
  }

  /// Strains of any size: each vertex turns by an angle up to `turns` [rad].
  template <class Space>
  Strains<Space> strains(const Grid& grid, double turns) {
    Strains<Space> out;
    for (int j = 0; j <= grid.edges(); ++j) {
      out.K.push_back(turn<Space>(number(0, turns)) / grid.Δs(j));
      if (j < grid.edges()) out.Γ.push_back(axis<Space>() + 0.5 * vector<Space::dim>());
    }
    return out;
  }

  template <class Space>
  CosseratCurve<Space> curve(const Grid& grid, double turns = 1) {
    return reconstruct<Space>(grid, strains<Space>(grid, turns), vector<Space::dim>(),
                              rotation<Space>());
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace pyrod::test
