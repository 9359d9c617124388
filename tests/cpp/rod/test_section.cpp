// SPDX-License-Identifier: BSD-3-Clause
#include <pyrod/rod/section.hpp>

#include "support/near.hpp"

using namespace pyrod;
using namespace pyrod::test;
using doctest::Approx;

namespace {
constexpr double π = std::numbers::pi;
const Material steel(200e9, 0.3);
}  // namespace

TEST_CASE("shear modulus") {
  CHECK(Material(2.6, 0.3).G() == Approx(1).epsilon(1e-15));
  CHECK(Material(3, 0.5).G() == Approx(1).epsilon(1e-15));
  CHECK(Material(1).nu == 0.3);
}

TEST_CASE("circle") {
  const Section s = Section::circle(2e-3, steel);
  const double I = π * std::pow(2e-3, 4) / 4, A = π * 4e-6;
  CHECK(s.EI1 == Approx(200e9 * I).epsilon(1e-14));
  CHECK(s.EI2 == s.EI1);
  CHECK(s.GJ == Approx(steel.G() * 2 * I).epsilon(1e-14));
  CHECK(s.EA == Approx(200e9 * A).epsilon(1e-14));
  CHECK(s.GA1 == Approx(6 * 1.3 / (7 + 6 * 0.3) * steel.G() * A).epsilon(1e-14));  // Cowper
  CHECK(s.GA2 == s.GA1);
}

TEST_CASE("tube: a circle less its hole, thin-walled in the limit") {
  const Section tube = Section::tube(2, 1, steel), whole = Section::circle(2, steel),
                hole = Section::circle(1, steel);
  CHECK(tube.EI1 == Approx(whole.EI1 - hole.EI1).epsilon(1e-14));
  CHECK(tube.GJ == Approx(whole.GJ - hole.GJ).epsilon(1e-14));
  CHECK(tube.EA == Approx(whole.EA - hole.EA).epsilon(1e-14));

  const Section almost_solid = Section::tube(2, 1e-9, steel);
  CHECK(almost_solid.EI1 == Approx(whole.EI1).epsilon(1e-12));
  CHECK(almost_solid.GA1 == Approx(whole.GA1).epsilon(1e-12));

  const double t = 1e-6;  // Cowper's coefficient of the thin tube: 2 (1 + ν)/(4 + 3ν)
  const Section thin = Section::tube(1 + t / 2, 1 - t / 2, steel);
  CHECK(thin.GA1 == Approx(2 * 1.3 / 4.9 * steel.G() * 2 * π * t).epsilon(1e-5));
  CHECK(thin.EI1 == Approx(200e9 * π * t).epsilon(1e-5));
}

TEST_CASE("rectangle: bending about each director, shear, stretch") {
  const Section s = Section::rectangle(2, 3, Material(2.6, 0.3));
  CHECK(s.EI1 == Approx(2.6 * 2 * 27 / 12).epsilon(1e-14));
  CHECK(s.EI2 == Approx(2.6 * 3 * 8 / 12).epsilon(1e-14));
  CHECK(s.EA == Approx(2.6 * 6).epsilon(1e-14));
  CHECK(s.GA1 == Approx(13. / 15.3 * 6).epsilon(1e-14));
  CHECK(s.GA2 == s.GA1);
}

TEST_CASE("rectangle: Saint-Venant's torsion") {
  const Material unit(2, 0);  // G = 1
  CHECK(Section::rectangle(1, 1, unit).GJ == Approx(0.1405770150).epsilon(1e-9));
  CHECK(Section::rectangle(2, 1, unit).GJ == Approx(2 * 0.2286816).epsilon(1e-6));
  CHECK(Section::rectangle(10, 1, unit).GJ == Approx(10 * 0.3123).epsilon(1e-4));
  CHECK(Section::rectangle(1, 2, unit).GJ == Section::rectangle(2, 1, unit).GJ);
  // A thin strip: a b³/3 less the ends, 0.630 b⁴ /3.
  const double thin = Section::rectangle(1, 1e-3, unit).GJ;
  CHECK(thin == Approx(1e-9 / 3 * (1 - 0.63025e-3)).epsilon(1e-7));
}

TEST_CASE("a section given by its stiffnesses is rigid where nothing is said") {
  const Section s(1, 2, 3);
  CHECK(s.EI2 == 2);
  CHECK(std::isinf(s.GA1));
  CHECK(std::isinf(s.GA2));
  CHECK(std::isinf(s.EA));
  CHECK_NOTHROW(Section(1, 2, 3, Section::rigid, Section::rigid, 5));
  CHECK_NOTHROW(Section(1, 2, 3, 4, 5, 6));
}

TEST_CASE("what no section can be is refused by name") {
  CHECK_REFUSED("E: Young's modulus must be positive, got 0", Material(0));
  CHECK_REFUSED("E:", Material(Section::rigid));
  CHECK_REFUSED("nu: Poisson's ratio must lie in (-1, 0.5], got 0.6", Material(1, 0.6));
  CHECK_REFUSED("nu:", Material(1, -1));
  CHECK_REFUSED("radius: must be positive, got -1", Section::circle(-1, steel));
  CHECK_REFUSED("outer_radius:", Section::tube(0, 0, steel));
  CHECK_REFUSED("inner_radius:", Section::tube(1, 1, steel));
  CHECK_REFUSED("inner_radius:", Section::tube(1, -0.1, steel));
  CHECK_REFUSED("width:", Section::rectangle(0, 1, steel));
  CHECK_REFUSED("height:", Section::rectangle(1, std::nan(""), steel));
  CHECK_REFUSED("EI1: stiffness must be positive and finite, got 0", Section(0, 1, 1));
  CHECK_REFUSED("EI2:", Section(1, -1, 1));
  CHECK_REFUSED("GJ:", Section(1, 1, Section::rigid));
  CHECK_REFUSED("GA2: stiffness must be positive, got -5", Section(1, 1, 1, 5, -5, 5));
  CHECK_REFUSED("EA:", Section(1, 1, 1, 5, 5, std::nan("")));
  CHECK_REFUSED("GA1, GA2:", Section(1, 1, 1, 5, Section::rigid, 5));
  CHECK_REFUSED("EA: a rod that shears must also stretch", Section(1, 1, 1, 5, 5));
}
