// SPDX-License-Identifier: BSD-3-Clause
/// \file Sine, cosine and the angle of a point: by the standard library for a double, by
/// polynomials for packs.
///
/// The polynomials are the best ones (Remez) on their intervals; with them the errors are below
/// 1e-17 of the result, far less than the rounding.
#pragma once

#include <pyrod/core/pack.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace pyrod {

namespace series {

/// Σ a[k] xᵏ.
template <std::size_t N, class Real>
constexpr Real horner(const std::array<double, N>& a, const Real& x) {
  Real sum = a[N - 1];
  for (std::size_t k = N - 1; k-- > 0;) sum = sum * x + Real(a[k]);
  return sum;
}

}  // namespace series

template <class Real>
struct SineCosine {
  Real sine, cosine;
};

inline SineCosine<double> sine_cosine(double θ) { return {std::sin(θ), std::cos(θ)}; }

/// θ is brought into ±π/4 by taking off k quarter turns. π/2 is a sum of three numbers, of which
/// the first two have 33 bits, so that their products with k < 2²⁰ are exact.
template <int W>
SineCosine<Pack<W>> sine_cosine(const Pack<W>& θ) {
  using Real = Pack<W>;
  using Bits = typename detail::Lanes<W>::Bits;
  constexpr double quarter[] = {0x1.921fb544p+0, 0x1.0b4611a6p-34, 0x1.3198a2e037073p-69};
  constexpr double shift = 0x1.8p+52;  // added, it leaves the nearest integer in the last bits
  constexpr std::array sine{-0.16666666666666632,  0.0083333333333224243,  -0.00019841269829816834,
                            2.7557313695192401e-6, -2.5050758648535035e-8, 1.5896827678171534e-10};
  constexpr std::array cosine{0.0416666666666666,    -0.0013888888888874139,
                              2.4801587289491904e-5, -2.7557314355258136e-7,
                              2.0875723686108196e-9, -1.1359669934277295e-11};

  SineCosine<Real> out;
  if (!everywhere(abs(θ) <= Real(0x1p+20))) {
    for (int i = 0; i < W; ++i) {
      out.sine.values[i] = std::sin(θ.values[i]);
      out.cosine.values[i] = std::cos(θ.values[i]);
    }
    return out;
  }
  const Real shifted = θ * Real(2 / std::numbers::pi) + Real(shift), k = shifted - Real(shift);
  const Real r = ((θ - k * Real(quarter[0])) - k * Real(quarter[1])) - k * Real(quarter[2]);
  const Real x = r * r;
  const Real s = r + r * x * series::horner(sine, x);
  const Real c = Real(1) - (Real(0.5) * x - x * x * series::horner(cosine, x));

  const Bits quarters = reinterpret_cast<Bits>(shifted.values);
  const Bits odd = (quarters & 1) != 0;
  const Bits minus_sine = (quarters & 2) << 62, minus_cosine = ((quarters + 1) & 2) << 62;
  const typename Real::Values a = odd ? c.values : s.values, b = odd ? s.values : c.values;
  out.sine.values = reinterpret_cast<typename Real::Values>(reinterpret_cast<Bits>(a) ^ minus_sine);
  out.cosine.values =
      reinterpret_cast<typename Real::Values>(reinterpret_cast<Bits>(b) ^ minus_cosine);
  return out;
}

/// Angle in [0, π] of the point (cosine, sine), sine ≥ 0, of any length but zero.
inline double angle(double sine, double cosine) { return std::atan2(sine, cosine); }

/// The angle t is that of the octant's point; half of it is below π/8.
template <int W>
Pack<W> angle(const Pack<W>& sine, const Pack<W>& cosine) {
  using Real = Pack<W>;
  constexpr double π = std::numbers::pi;
  constexpr std::array atan{-0.33333333333333199,  0.19999999999954083,   -0.14285714280248662,
                            0.11111110786145818,   -0.090908978366760752, 0.076920616410176395,
                            -0.066631204262751753, 0.058480092098270396,  -0.05039846770575069,
                            0.038078351460847247,  -0.01792231121685419};
  const Real adjacent = abs(cosine);
  const auto steep = adjacent < sine;
  const Real t = select(steep, adjacent, sine) / select(steep, sine, adjacent);
  const Real half = t / (Real(1) + sqrt(Real(1) + t * t)), x = half * half;
  const Real octant = Real(2) * (half + half * x * series::horner(atan, x));
  const Real quadrant = select(steep, Real(π / 2) - octant, octant);
  return select(cosine < Real(0), Real(π) - quadrant, quadrant);
}

}  // namespace pyrod
