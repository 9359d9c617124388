// SPDX-License-Identifier: BSD-3-Clause
/// \file Cross-sections: from dimensions and material to the stiffnesses of a rod.
///
/// Shear stiffness uses Cowper's shear coefficients (J. Appl. Mech. 33, 1966), torsion that of
/// Saint-Venant. Director 1 is the direction of `width`, director 2 that of `height`.
#pragma once

#include <pyrod/core/require.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pyrod {

/// Isotropic linear elasticity.
struct Material {
  double E;        ///< Young's modulus [Pa]
  double nu;       ///< Poisson's ratio, in (−1, 1/2]
  double density;  ///< [kg/m³], for gravity

  Material(double young, double poisson = 0.3, double mass_per_volume = 0)
      : E(young), nu(poisson), density(mass_per_volume) {
    require(std::isfinite(E) && E > 0, "E: Young's modulus must be positive, got ", E);
    require(nu > -1 && nu <= 0.5, "nu: Poisson's ratio must lie in (-1, 0.5], got ", nu,
            "; to prescribe G independently give the section its own stiffnesses");
    require(std::isfinite(density) && density >= 0, "density: must not be negative, got ", density);
  }
  double G() const { return E / (2 * (1 + nu)); }
};

/// Stiffnesses of a cross-section. An infinite one is a strain that does not occur.
struct Section {
  static constexpr double rigid = std::numeric_limits<double>::infinity();

  double EI1, EI2, GJ;                          ///< bending about directors 1 and 2, torsion [N m²]
  double GA1 = rigid, GA2 = rigid, EA = rigid;  ///< shear along directors 1 and 2, stretch [N]
  double mass_per_length = 0;                   ///< [kg/m]

  Section(double bend1, double bend2, double twist, double shear1 = rigid, double shear2 = rigid,
          double stretch = rigid, double mass = 0)
      : EI1(bend1),
        EI2(bend2),
        GJ(twist),
        GA1(shear1),
        GA2(shear2),
        EA(stretch),
        mass_per_length(mass) {
    check(EI1, "EI1"), check(EI2, "EI2"), check(GJ, "GJ");
    check(GA1, "GA1", true), check(GA2, "GA2", true), check(EA, "EA", true);
    require(std::isinf(GA1) == std::isinf(GA2),
            "GA1, GA2: give both shear stiffnesses or neither, got ", GA1, " and ", GA2);
    require(std::isinf(GA1) || std::isfinite(EA),
            "EA: a rod that shears must also stretch; give EA or leave GA1, GA2 out");
    require(std::isfinite(mass) && mass >= 0,
            "mass_per_length: must be finite and not negative, got ", mass);
  }

  bool operator==(const Section&) const = default;

  /// Solid circle.
  static Section circle(double radius, const Material& material) {
    return tube(radius, 0, material, "radius");
  }

  /// Ring between two radii.
  static Section tube(double outer, double inner, const Material& material,
                      const char* outer_name = "outer_radius") {
    require(std::isfinite(outer) && outer > 0, outer_name, ": must be positive, got ", outer);
    require(inner >= 0 && inner < outer, "inner_radius: must lie in [0, outer_radius), got ",
            inner);
    constexpr double π = std::numbers::pi;
    const double a2 = outer * outer, b2 = inner * inner, ν = material.nu;
    const double A = π * (a2 - b2), I = π / 4 * (a2 * a2 - b2 * b2);
    const double m2 = b2 / a2, s = (1 + m2) * (1 + m2);
    const double κ = 6 * (1 + ν) * s / ((7 + 6 * ν) * s + (20 + 12 * ν) * m2);
    const double E = material.E, G = material.G();
    return {E * I, E * I, 2 * G * I, κ * G * A, κ * G * A, E * A, material.density * A};
  }

  /// Solid rectangle: `width` along director 1, `height` along director 2.
  static Section rectangle(double width, double height, const Material& material) {
    require(std::isfinite(width) && width > 0, "width: must be positive, got ", width);
    require(std::isfinite(height) && height > 0, "height: must be positive, got ", height);
    const double A = width * height, ν = material.nu, E = material.E, G = material.G();
    const double κ = 10 * (1 + ν) / (12 + 11 * ν);
    return {E * A * height * height / 12,
            E * A * width * width / 12,
            G * rectangle_torsion(width, height),
            κ * G * A,
            κ * G * A,
            E * A,
            material.density * A};
  }

 private:
  static void check(double value, const char* name, bool may_be_rigid = false) {
    require(value > 0 && (may_be_rigid || std::isfinite(value)), name,
            ": stiffness must be positive", may_be_rigid ? "" : " and finite", ", got ", value);
  }

  /// Saint-Venant's torsion constant: a b³ (1/3 − (64/π⁵)(b/a) Σ tanh(kπa/2b)/k⁵ over odd k), a ≥
  /// b.
  static double rectangle_torsion(double width, double height) {
    constexpr double π = std::numbers::pi;
    const double a = std::max(width, height), b = std::min(width, height);
    double sum = 0;
    for (int k = 999; k > 0; k -= 2) sum += std::tanh(k * π * a / (2 * b)) / std::pow(k, 5);
    return a * b * b * b * (1. / 3 - 64 / std::pow(π, 5) * b / a * sum);
  }
};

}  // namespace pyrod
