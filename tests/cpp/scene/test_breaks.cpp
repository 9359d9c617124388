// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/scene/break_search.hpp>

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>

using namespace pyrod;

namespace {

using Function = std::function<Vec3(double)>;

constexpr double at = 0.4321;

SampledFunction asked(const Function& function) {
  return [function](std::span<const double> s, Samples& values) {
    values.resize(std::ssize(s), 3);
    for (std::size_t i = 0; i < s.size(); ++i) values.row(Eigen::Index(i)) = function(s[i]);
  };
}

double table(double s, const std::vector<double>& stations, const std::vector<double>& values) {
  std::size_t i = 1;
  while (i + 1 < stations.size() && s > stations[i]) ++i;
  const double part = (s - stations[i - 1]) / (stations[i] - stations[i - 1]);
  return (1 - part) * values[i - 1] + part * values[i];
}

/// So many stations, between which the values 0, 1 and 2 take turns.
double zigzag(double s, int stations) {
  const double x = s * (stations - 1);
  const int i = std::min(int(x), stations - 2);
  return (1 - (x - i)) * (i % 3) + (x - i) * ((i + 1) % 3);
}

void finds(const Function& function, const std::vector<double>& places, double near = 1e-9) {
  for (const double length : {1., 250.}) {
    const auto found = breaks_of(asked([&](double s) { return function(s / length); }), length);
    CHECK(!found.unresolved);
    REQUIRE(found.at.size() == places.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      CHECK(std::abs(found.at[i] - places[i] * length) < near * length);
  }
}

}  // namespace

TEST_CASE("jumps are found to rounding, also small ones in one component") {
  finds([](double s) { return Vec3(s > at ? 5 : 0, 0, 0); }, {at}, 2e-15);
  finds([](double s) { return Vec3(1, 1e-5 * (s > at), std::sin(9 * s)); }, {at}, 2e-15);
  finds([](double s) { return Vec3((0.2 < s && s < 0.207) + (s > 0.7), 0, 0); }, {0.2, 0.207, 0.7});
}

TEST_CASE("kinks are found, and jumps of the second derivative") {
  finds([](double s) { return Vec3(std::abs(s - 1. / 3), 0.5, 0.2); }, {1. / 3});
  finds([](double s) { return Vec3(std::exp(s) + 1e-2 * std::max(s - at, 0.), 0, 0); }, {at});
  finds([](double s) { return Vec3(std::pow(std::max(s - at, 0.), 2), 1, 0); }, {at}, 1e-4);
}

TEST_CASE("what is near to another is told apart from it") {
  finds([](double s) { return Vec3(table(s, {0, 0.5, 0.5001, 1}, {1, 1, 2, 2}), 0, 0); },
        {0.5, 0.5001});
  const std::vector<double> stations{0, 0.03, 0.11, 0.179, 0.41, 0.4321, 0.77, 1};
  finds([&](double s) { return Vec3(0, table(s, stations, {1, 4, 1.5, 2, 3, 1, 2.5, 2}), 0); },
        {stations.begin() + 1, stations.end() - 1});
}

TEST_CASE("more than 24 are told apart, from more samples") {
  std::vector<double> places;
  for (int i = 1; i < 41; ++i)
    if (i % 3 != 1) places.push_back(i / 41.);  // else the slope goes on
  REQUIRE(places.size() == 26);
  finds([](double s) { return Vec3(zigzag(s, 42), 0, 0); }, places);
}

TEST_CASE("smooth functions have none") {
  const std::vector<Function> smooth{
      [](double) { return Vec3(1, 2, 3); },
      [](double s) { return Vec3(std::sin(40 * s), std::exp(-20 * s), 1 / (1 + s)); },
      [](double s) { return Vec3(std::tanh((s - at) / 2e-3), 0, 0); },
      [](double s) { return Vec3(1e12 + s, 0, 1e-9 * std::pow(s, 5)); },
      [](double) { return Vec3(0.1 + 0.2, 1e-300, 0); },
      [](double) { return Vec3(0, 0, 0); }};
  for (const auto& function : smooth) {
    const auto found = breaks_of(asked(function), 1);
    CHECK(found.at.empty());
    CHECK(!found.unresolved);
  }
}

TEST_CASE("what cannot be found is told") {
  const std::vector<Function> hopeless{
      [](double s) { return Vec3(1 + 1e-5 * std::sin(1e9 * s * s), 0, 0); },  // noise, to samples
      [](double s) { return Vec3(std::sqrt(s), 0, 0); },
      [](double s) { return Vec3(zigzag(s, 401), 0, 0); }};
  for (const auto& function : hopeless) CHECK(breaks_of(asked(function), 1).unresolved);
}

TEST_CASE("what is no number is not looked at, or told") {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const auto found = breaks_of(asked([](double s) { return Vec3(s < 0.5 ? 1 : nan, 0, 0); }), 1);
  CHECK(found.at.empty());
  CHECK(!found.unresolved);
  const auto gap = [](double s) { return Vec3(0.51 < s && s < 0.53 ? nan : s > 0.5, 0, 0); };
  for (const double s : breaks_of(asked(gap), 1).at) CHECK(std::abs(s - 0.5) < 1e-9);
}

TEST_CASE("a smooth function is asked 274 times, and what it throws comes through") {
  int count = 0;
  breaks_of(asked([&](double s) { return ++count, Vec3(std::cos(s), 1, 0); }), 2);
  CHECK(count == 17 + 257);
  const auto throws = asked([](double s) -> Vec3 {
    if (s > 1) throw std::runtime_error("too far");
    return Vec3::Zero();
  });
  CHECK_THROWS_WITH(breaks_of(throws, 2), "too far");
  CHECK(breaks_of([](std::span<const double> s, Samples& v) { v.resize(std::ssize(s), 0); }, 1)
            .at.empty());
}

TEST_CASE("a function of other numbers at other places is refused") {
  int batch = 0;
  const auto grows = [&](std::span<const double> s, Samples& values) {
    values = Samples::Ones(std::ssize(s), ++batch);
  };
  CHECK_THROWS_WITH(breaks_of(grows, 1),
                    "a function of arc length gives 2 numbers at 0, and 1 at 0");
}
