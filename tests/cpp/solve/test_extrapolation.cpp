// SPDX-License-Identifier: BSD-3-Clause
// Sequences whose limit is known, on grids of h = 1, ½, ¼, …
#include <pyrod/solve/extrapolation.hpp>

#include "support/near.hpp"

#include <functional>

using namespace pyrod;
using namespace pyrod::test;

namespace {

using Sequence = std::function<Vector(double h)>;

std::vector<Vector> levels(int count, const Sequence& f) {
  std::vector<Vector> out;
  for (int k = 0; k < count; ++k) out.push_back(f(std::exp2(-k)));
  return out;
}

/// One quantity of unit size, each number by itself.
Judgement each(int size, bool even) {
  Judgement out{{}, {1}, even};
  for (int i = 0; i < size; ++i) out.rows.push_back({i, 1, 0});
  return out;
}

Extrapolated result(int count, bool even, const Sequence& f, double noise = 1e-15) {
  auto judgement = each(int(f(1).size()), even);
  judgement.noise = noise;
  return Extrapolation(levels(count, f), judgement).result();
}

const Vec3 LIMIT(1, -2, 0.5);

Vector even_series(double h) {
  const double x = h * h;
  return LIMIT + x * Vec3(0.3, 0.1, -0.2) + x * x * Vec3(-0.02, 0.05, 0.04) +
         x * x * x * Vec3(0.01, -0.01, 0.02) + x * x * x * x * Vec3(0.004, 0.003, 0.002);
}

Vector full_series(double h) {
  Vector out = LIMIT;
  const Vec3 c[] = {{0.3, 0.1, -0.2},
                    {0.03, -0.02, 0.02},
                    {-0.02, 0.05, 0.04},
                    {0.01, 0.02, 0.01},
                    {0.01, -0.01, 0.02}};
  for (int i = 0; i < 5; ++i) out += std::pow(h, 2 + i) * c[i];
  return out;
}

double true_error(const Extrapolated& of, const Vector& limit = LIMIT) {
  return (of.values - limit).lpNorm<Eigen::Infinity>();
}

}  // namespace

TEST_CASE("a polynomial is exact as soon as all its powers but one are eliminated") {
  for (const bool even : {true, false})
    for (int terms = 1; terms <= 4; ++terms) {
      const auto f = [&](double h) -> Vector {
        Vector out = LIMIT;
        for (int i = 0; i < terms; ++i)
          out += std::pow(h, even ? 2 * (i + 1) : i + 2) * Vec3(1, 0.5, -0.7) / (i + 1);
        return out;
      };
      const int count = terms + 2;
      CHECK(true_error(result(count, even, f)) < 1e-14);
      if (terms > 1) CHECK(true_error(result(count - 1, even, f)) > 1e-7);
    }
}

TEST_CASE("errors of a series are told a few times too large") {
  for (int count = 3; count <= 5; ++count) {
    const auto even = result(count, true, even_series), full = result(count, false, full_series);
    CAPTURE(count);
    for (const auto* told : {&even, &full}) {
      CHECK(told->regular);
      CHECK(told->order == doctest::Approx(2).epsilon(0.03));
      CHECK(told->error() > 1.5 * true_error(*told));
      CHECK(told->error() < 12 * true_error(*told));
    }
  }
  CHECK(true_error(result(5, true, even_series)) < 1e-8);
}

TEST_CASE("nothing is believed before it is seen") {
  for (int count = 1; count <= 2; ++count) {
    const auto told = result(count, true, even_series);
    CHECK_FALSE(told.regular);
    CHECK(std::isinf(told.error()));
    CHECK(told.values == even_series(std::exp2(1 - count)));
  }
}

TEST_CASE("two grids are enough for who knows the order") {
  const auto f = [](double h) -> Vector { return LIMIT + h * h * Vec3(0.3, 0.1, -0.2); };
  const auto told = Extrapolation(levels(2, f), each(3, true)).trusted();
  CHECK(told.regular);
  CHECK(told.values == f(0.5));
  CHECK(told.error() == doctest::Approx(2 * 0.3 / 4).epsilon(1e-14));
  CHECK(Extrapolation(levels(3, even_series), each(3, true)).trusted().values ==
        result(3, true, even_series).values);
}

TEST_CASE("lower orders are seen; the finest grid is told with an error that holds") {
  for (const double order : {0.5, 1., 1.5}) {
    const auto f = [&](double h) -> Vector { return LIMIT + std::pow(h, order) * Vec3(1, -2, 3); };
    CAPTURE(order);
    for (int count = 5; count <= 8; ++count) {
      const auto told = result(count, false, f);
      CHECK_FALSE(told.regular);
      CHECK(told.order == doctest::Approx(order).epsilon(1e-12));
      CHECK(told.values == f(std::exp2(1 - count)));
      CHECK(told.error() == doctest::Approx(3 * true_error(told)).epsilon(1e-12));
    }
    CHECK(std::isinf(result(4, false, f).error()));
  }
  const auto slow = [](double h) -> Vector { return LIMIT + std::pow(h, 0.3) * LIMIT; };
  CHECK(std::isinf(result(8, false, slow).error()));
}

TEST_CASE("what does not converge has no error") {
  const auto jumping = [](double h) -> Vector { return LIMIT * (1 + 0.1 * std::cos(40 / h)); };
  const auto told = result(7, false, jumping);
  CHECK_FALSE(told.regular);
  CHECK(std::isinf(told.error()));
}

TEST_CASE("odd powers are noticed where they should not be") {
  const auto odd = [](double h) -> Vector { return even_series(h) + 0.2 * h * h * h * LIMIT; };
  CHECK(result(5, false, odd).regular);
  const auto told = result(5, true, odd);
  CHECK_FALSE(told.regular);
  CHECK(told.values == odd(1. / 16));
  CHECK(told.error() >= true_error(told));
}

TEST_CASE("errors do not fall below rounding, nor are they less than it") {
  double sign = 1;
  const auto rounded = [&](double h) -> Vector {
    sign = -sign;
    return even_series(h) + 1e-10 * sign * Vec3(1, -0.7, 0.4);
  };
  for (int count = 3; count <= 12; ++count) {
    const auto told = result(count, true, rounded, 2e-10);
    CAPTURE(count);
    CHECK(told.regular);
    CHECK(told.error() >= true_error(told));
    CHECK(told.error() >= 2e-10);
    if (count >= 6) CHECK(told.error() < 1e-8);
  }
}

TEST_CASE("a number that does not change is exact to rounding") {
  const auto told = result(3, false, [](double) -> Vector { return LIMIT; }, 3e-14);
  CHECK(told.regular);
  CHECK(told.values == LIMIT);
  CHECK(told.error() == 3e-14);
}

TEST_CASE("a layer that the first grids do not resolve is not taken for rounding") {
  for (const double thickness : {0.25, 0.5}) {
    const auto layered = [&](double h) -> Vector {
      return even_series(h) + std::exp(-thickness / h) * Vec3(0.01, 0, 0.02);
    };
    for (int count = 3; count <= 8; ++count) {
      const auto told = result(count, true, layered);
      CAPTURE(thickness);
      CAPTURE(count);
      CHECK(told.error() >= true_error(told));
    }
  }
}

TEST_CASE("columns that shrink less than they should have errors as large as they shrink") {
  // a power between those that are eliminated: by 2^-4.5 each
  const auto f = [](double h) -> Vector {
    return LIMIT + (h * h + 0.1 * std::pow(h, 4.5)) * LIMIT;
  };
  const auto told = result(5, true, f);
  CHECK(told.regular);
  CHECK(told.error() == doctest::Approx(1.5 * true_error(told)).epsilon(1e-6));
}

TEST_CASE("an error that crosses zero on the finest grid is not taken for none") {
  // c₂ h² + c₄ h⁴ of the second quantity vanish at h = ¼, and so do its extrapolations near there
  for (const double at : {0.5, 0.25, 0.125}) {
    const auto f = [&](double h) -> Vector {
      Vector out(2);
      const double x = h * h;
      out << 1 + 0.2 * x + 0.1 * x * x + 0.05 * x * x * x,
          1 + 0.2 * x + 0.1 * x * x * (x - at * at) / (at * at);
      return out;
    };
    Judgement judgement{{{0, 1, 0}, {1, 1, 1}}, {1, 1}, true};
    for (int count = 3; count <= 6; ++count) {
      const auto told = Extrapolation(levels(count, f), judgement).result();
      CAPTURE(at);
      CAPTURE(count);
      for (int i = 0; i < 2; ++i) CHECK(told.errors[i] >= std::abs(told.values[i] - 1));
    }
  }
}

TEST_CASE("a value that happens not to change is not taken for the limit") {
  // without h² the second quantity is 1 + 0.1/64 from ½ and ¼, as it is from 1 and ½
  const auto f = [](double h) -> Vector {
    Vector out(2);
    const double x = h * h;
    out << 1 + 0.3 * x + 0.06 * x * x, 1 + 0.3 * x - 0.13125 * x * x + 0.1 * x * x * x;
    return out;
  };
  const auto told = Extrapolation(levels(3, f), {{{0, 1, 0}, {1, 1, 1}}, {1, 1}, true}).result();
  CHECK(std::abs(told.values[1] - 1) == doctest::Approx(0.1 / 64).epsilon(1e-10));
  CHECK(told.errors[1] >= std::abs(told.values[1] - 1));
}

TEST_CASE("each quantity has the error of its worst row, relative to its scale") {
  const auto f = [](double h) -> Vector {
    Vector out(5);
    out << 3, 4, 1, 0, 7;
    return out * h * h;
  };
  const Judgement judgement{{{0, 2, 0}, {2, 2, 0}, {4, 1, 1}}, {10, 0.1}, true};
  const auto told = Extrapolation(levels(2, f), judgement).trusted();
  REQUIRE(told.errors.size() == 2);
  CHECK(told.errors[0] == doctest::Approx(2. / 3 * 0.75 * 5 / 10).epsilon(1e-14));
  CHECK(told.errors[1] == doctest::Approx(2. / 3 * 0.75 * 7 / 0.1).epsilon(1e-14));
  CHECK(told.error() == told.errors[1]);
}
