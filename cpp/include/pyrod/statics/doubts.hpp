// SPDX-License-Identifier: BSD-3-Clause
/// \file What one should know before trusting an equilibrium.
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/curve/cosserat.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/rotation/spatial.hpp>
#include <pyrod/statics/equilibrium.hpp>
#include <pyrod/statics/solution/quantity.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace pyrod {

/// A number with so many digits, as in a sentence.
inline std::string digits(double x, int count) {
  std::array<char, 40> to;
  const auto end =
      std::to_chars(to.data(), to.data() + to.size(), x, std::chars_format::general, count);
  return {to.data(), end.ptr};
}

namespace detail {

/// Turns, stretches and strains of a rod beyond what the edges or the model can mean.
class StrainDoubts {
 public:
  StrainDoubts(const Equilibrium& found, int number)
      : rod_(found.shape().made[std::size_t(number)]),
        curve_(found.rod(number).curve),
        strains_(found.rod(number).strains),
        of_(found.rods().size() > 1 ? text(" of rod ", number) : "") {}

  /// `turns`: neighbours that turn by more than π are told, too.
  template <class Tell>
  void tell(bool turns, const Tell& tell) const {
    stretch(tell);
    if (turns) turn(tell);
  }

 private:
  /// Of an edge: beyond what rubber does, so units are wrong more likely.
  static constexpr double most_strain = 3;

  template <class Tell>
  void stretch(const Tell& tell) const {
    std::size_t least = 0, most = 0;
    for (std::size_t j = 1; j < strains_.Γ.size(); ++j) {
      if (!(strains_.Γ[j].z() >= strains_.Γ[least].z())) least = j;
      if (size(j) > size(most)) most = j;
    }
    if (const double Γ = strains_.Γ[least].z(); Γ <= 0)
      return tell("edge ", least, of_, " is compressed to ", digits(Γ, 3),
                  " of its length, turned inside out: the loads exceed what EA allows");
    if (!(size(most) > most_strain)) return;
    Eigen::Index component = 0;
    strain(most).cwiseAbs().maxCoeff(&component);
    const std::string how = component < 2
                                ? "sheared by " + digits(size(most), 3)
                                : "stretched to " + digits(1 + size(most), 4) + " times its length";
    tell("edge ", most, of_, " is ", how,
         ": EA or GA and the loads do not fit, look at their units");
  }

  template <class Tell>
  void turn(const Tell& tell) const {
    std::size_t most = 0;
    for (std::size_t j = 1; j < strains_.K.size(); ++j)
      if (!(angle(j) <= angle(most))) most = j;
    if (angle(most) > std::numbers::pi)
      tell("the rod turns by ", digits(angle(most), 3), " rad at vertex ", most, of_,
           ": more edges are needed for the shape to mean anything");
  }

  Vec3 strain(std::size_t j) const { return strains_.Γ[j] - Vec3::UnitZ(); }
  double size(std::size_t j) const { return strain(j).lpNorm<Eigen::Infinity>(); }
  /// Beside a moment K is that behind the vertex, and tells nothing of the turn.
  double angle(std::size_t j) const {
    const auto& q = curve_.frames;
    if (j > 0 && j < q.size()) return log(q[j - 1].conjugate() * q[j]).norm();
    return rod_.grid.Δs(int(j)) * strains_.K[j].norm();
  }

  const Rod<Spatial>& rod_;
  const CosseratCurve<Spatial>& curve_;
  const Strains<Spatial>& strains_;
  std::string of_;
};

/// Which errors rounding keeps above the tolerance.
inline std::string kept_by_rounding(const Accuracy& accuracy) {
  std::string out;
  for (int q = 0; q < int(Quantity::reaction_moments); ++q) {
    double error = accuracy.error(Quantity(q));
    if (Quantity(q) == Quantity::reactions)
      error = std::max(error, accuracy.error(Quantity::reaction_moments));
    if (!(error > accuracy.tol)) continue;
    std::array<char, 40> to;
    const auto end =
        std::to_chars(to.data(), to.data() + to.size(), error, std::chars_format::scientific, 1);
    out += text(out.empty() ? "" : ", ", quantity_names[std::size_t(q)], " to ",
                std::string_view(to.data(), end.ptr));
  }
  return out;
}

}  // namespace detail

/// `stable`: whether a stable equilibrium was wanted. `strained`: there may be strains to tell of.
inline std::vector<Doubt> doubts_of(const Equilibrium& found, bool stable, bool strained) {
  std::vector<Doubt> out;
  const auto tell = [&](Doubt::Kind kind, const auto&... words) {
    out.push_back({kind, text(words...)});
  };
  if (found.index() > 0 && stable)
    tell(Doubt::Kind::unstable, "the equilibrium is unstable (index ", found.index(),
         "): a disturbed rod leaves it; start from a shape on the side that it would fall to");
  if (const auto& accuracy = found.accuracy; accuracy && found.converged()) {
    if (!accuracy->reached.regular)
      tell(Doubt::Kind::accuracy, "the grids converge with order ",
           digits(accuracy->reached.order, 2), " instead of 2, so the results are those of the ",
           "finest, ", accuracy->reached.edges, " edges: ", accuracy->reason);
    else if (accuracy->unresolved)
      tell(Doubt::Kind::accuracy, accuracy->reason,
           ": the errors that are told may be too small; smooth it, or give the places vertices "
           "(Rod.with_vertices)");
    if (const auto kept = detail::kept_by_rounding(*accuracy); !kept.empty())
      tell(Doubt::Kind::accuracy, "rounding allows no more than ", kept,
           ": they are small differences of large numbers, as the stretch of a stiff member is of "
           "lengths");
  }
  for (std::size_t i = 0; strained && i < found.rods().size(); ++i)
    detail::StrainDoubts(found, int(i)).tell(!found.accuracy, [&](const auto&... words) {
      tell(Doubt::Kind::strain, words...);
    });
  return out;
}

}  // namespace pyrod
