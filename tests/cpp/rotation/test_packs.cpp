// SPDX-License-Identifier: BSD-3-Clause
// Functions of angles for packs, beside long double: each lane on its own side of a branch.
#include <pyrod/rotation/frames.hpp>

#include "support/instructions.hpp"
#include "support/near.hpp"
#include "support/random.hpp"
#include "support/ulp.hpp"

using namespace pyrod;
using namespace pyrod::test;

namespace {

using Long = long double;
constexpr double π = std::numbers::pi;

/// Largest error of f over `samples`, whose neighbours are far apart, with any instructions.
template <class F, class Exact>
Worst worst_of_packs(const std::vector<double>& samples, const F& f, const Exact& exact) {
  Worst found;
  const auto in = mixed(samples);
  with_each_instructions([&](Instructions set) {
    const auto out = mapped(f, in, set);
    for (std::size_t i = 0; i < in.size(); ++i) {
      const double error = ulps(out[i], exact(Long(in[i])));
      if (!(error <= found.ulps)) found = {error, in[i]};
    }
  });
  return found;
}

/// Lanes by themselves and among others: the same bits.
template <class F>
void check_independence(const std::vector<double>& samples, const F& f) {
  const auto in = mixed(samples);
  with_each_instructions([&](Instructions set) {
    const auto alone = [&](const auto& x) {
      auto out = x;
      for (int i = 0; i < width_of<std::decay_t<decltype(x)>>; ++i)
        out.values[i] = f(std::decay_t<decltype(x)>(x.values[i])).values[i];
      return out;
    };
    CHECK(mapped(f, in, set) == mapped(alone, in, set));
  });
}

std::vector<double> signed_angles(double end, const std::vector<double>& branches) {
  auto out = angles(end, branches);
  const std::size_t size = out.size();
  for (std::size_t i = 0; i < size; ++i) out.push_back(-out[i]);
  return out;
}

}  // namespace

// The bounds are the errors found, rounded up.

TEST_CASE("sine and cosine of packs") {
  std::vector<double> branches;
  for (int k = 1; k < 60; ++k) branches.push_back(k * π / 4);
  for (const double k : {1e3, 3e4, 6e5}) branches.push_back(std::round(k) * π / 2);
  auto at = signed_angles(50, branches);
  for (const double large : {0x1p+20, 0x1.0000000000001p+20, 1e7, 1e15, 1e300}) at.push_back(large);
  const auto sine = [](const auto& θ) { return sine_cosine(θ).sine; };
  const auto cosine = [](const auto& θ) { return sine_cosine(θ).cosine; };
  const Worst s = worst_of_packs(at, sine, [](Long θ) { return std::sin(θ); });
  CAPTURE(s.at);
  CHECK(s.ulps < 1.5);
  const Worst c = worst_of_packs(at, cosine, [](Long θ) { return std::cos(θ); });
  CAPTURE(c.at);
  CHECK(c.ulps < 1.8);
}

TEST_CASE("the angle of points of any length, in packs") {
  for (const double size : {1., 1e-200, 1e200}) {
    const auto of_point = [&](const auto& ψ) {
      auto sine = ψ, cosine = ψ;
      for (int i = 0; i < width_of<std::decay_t<decltype(ψ)>>; ++i) {
        sine.values[i] = size * std::sin(ψ.values[i]);
        cosine.values[i] = size * std::cos(ψ.values[i]);
      }
      return angle(sine, cosine);
    };
    const auto exact = [&](Long ψ) {
      return std::atan2(Long(size * std::sin(double(ψ))), Long(size * std::cos(double(ψ))));
    };
    auto at = angles(π, {π / 4, π / 2, 3 * π / 4});
    std::erase_if(at, [&](double ψ) { return ψ > π || (ψ > 0 && size * ψ < 1e-300); });
    const Worst w = worst_of_packs(at, of_point, exact);
    CAPTURE(size);
    CAPTURE(w.at);
    CHECK(w.ulps < 3.2);
  }
}

TEST_CASE("half_turn in packs") {
  const auto at = angles(400, {1});
  const auto cosine = [](const auto& θ2) { return half_turn(θ2).cosine; };
  const auto sine = [](const auto& θ2) { return half_turn(θ2).sine_over_θ; };
  const auto exact = [](Long θ2) {
    const Long θ = std::sqrt(θ2);
    return θ == 0 ? Long(0.5) : std::sin(θ / 2) / θ;
  };
  with_each_instructions([&](Instructions set) {
    const auto in = mixed(at), c = mapped(cosine, in, set), s = mapped(sine, in, set);
    double worst_cosine = 0, worst_sine = 0;  // absolute, of one: both have zeros
    for (std::size_t i = 0; i < in.size(); ++i) {
      const Long x = std::sqrt(Long(in[i])) / 2;
      worst_cosine = std::max(worst_cosine, double(std::abs(c[i] - std::cos(x)) / 2.2e-16L));
      worst_sine = std::max(worst_sine, double(std::abs(s[i] - exact(in[i])) * (1 + x) / 2.2e-16L));
    }
    CHECK(worst_cosine < 4.1);
    CHECK(worst_sine < 2.4);
  });
  check_independence(at, cosine);
  check_independence(at, sine);
}

TEST_CASE("half_angle_ratio in packs") {
  const auto ratio = [](const auto& half) {
    auto sine = half, cosine = half;
    for (int i = 0; i < width_of<std::decay_t<decltype(half)>>; ++i) {
      sine.values[i] = std::sin(half.values[i]);
      cosine.values[i] = std::cos(half.values[i]);
    }
    return half_angle_ratio(sine, cosine);
  };
  const auto exact = [](Long half) {
    const Long sine = std::sin(double(half)), cosine = std::cos(double(half));
    return sine == 0 ? 1 / cosine : std::atan2(sine, cosine) / sine;
  };
  auto at = angles(π, {std::atan(0.25), π / 4, π / 2});
  std::erase_if(at, [](double half) { return half >= π || (half > 0 && half < 1e-300); });
  const Worst w = worst_of_packs(at, ratio, exact);
  CAPTURE(w.at);
  CHECK(w.ulps < 2.2);
  check_independence(at, ratio);
}

TEST_CASE("the logarithm's coefficients in packs are those of doubles") {
  auto at = angles(4 * π * π * (1 - 1e-14), {0.5, π * π});
  const auto c = [](const auto& x) { return log_coefficients_of_square(x).c; };
  const auto slope = [](const auto& x) { return log_coefficients_of_square(x).slope; };
  with_each_instructions([&](Instructions set) {
    const auto in = mixed(at), packs_c = mapped(c, in, set), packs_slope = mapped(slope, in, set);
    Worst worst_c, worst_slope;
    for (std::size_t i = 0; i < in.size(); ++i) {
      const auto expected = in[i] > π * π ? log_coefficients_beyond_π(std::sqrt(in[i]))
                                          : log_coefficients_of_square(in[i]);
      const double of_c = ulps(packs_c[i], expected.c);
      const double of_slope = ulps(packs_slope[i], expected.slope);
      if (!(of_c <= worst_c.ulps)) worst_c = {of_c, in[i]};
      if (!(of_slope <= worst_slope.ulps)) worst_slope = {of_slope, in[i]};
    }
    CAPTURE(worst_c.at);
    CAPTURE(worst_slope.at);
    CHECK(worst_c.ulps == 0);
    CHECK(worst_slope.ulps == 0);
  });
  check_independence(at, c);
  check_independence(at, slope);
}

TEST_CASE_TEMPLATE("frames move in packs as they move one by one", Space, Planar, Spatial) {
  using Rotation = typename Space::Rotation;
  constexpr int spin = Space::spin;
  Random random(1);
  for (const double size : {1e-9, 0.3, 1., 7.})
    for (int n = 1; n < 20; ++n) {
      CAPTURE(n);
      std::vector<Rotation> frames, expected;
      Vector turns(spin * n);
      for (int j = 0; j < n; ++j) {
        const Spin<Space> φ = random.turn<Space>(size * random.number(0, 1));
        frames.push_back(random.rotation<Space>());
        expected.push_back(moved(frames[j], φ));
        turns.segment<spin>(spin * j) = φ;
      }
      with_each_instructions([&](Instructions set) {
        const Rotation untouched = exp(Spin<Space>(Spin<Space>::Constant(0.1)));
        std::vector<Rotation> out(n + 1, untouched);
        dispatch(MoveFrames<Space>{n, frames.data(), turns.data(), out.data()}, set);
        CHECK(distance(out[n], untouched) == 0);
        out.pop_back();
        CHECK(distance(out, expected) < 2e-15);
        if constexpr (spin == 3)
          for (const auto& q : out) CHECK(std::abs(q.norm() - 1) < 3e-16);
      });
    }
}
