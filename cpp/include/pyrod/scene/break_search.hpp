// SPDX-License-Identifier: BSD-3-Clause
/// \file Where a function of arc length jumps or has kinks, found from samples.
///
/// Fourth differences of samples a distance d apart fall with d⁴ where a function is smooth, with d
/// at a kink, and not at all at a jump. Where they stand out they are followed to finer samples,
/// until their order tells what is there (docs/accuracy.md, "Where something jumps").
#pragma once

#include <pyrod/core/require.hpp>
#include <pyrod/scene/breaks.hpp>
#include <pyrod/scene/samples.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace pyrod {

namespace detail {

/// A jump or a kink, and how exactly it is known where.
struct BreakPlace {
  double at, width;
};

/// Where the lines before and behind the kink between s and s + 4 d meet. The interval beside the
/// kink that changes most in slope holds it.
inline BreakPlace meeting(double s, double d, const Samples& values) {
  Eigen::Index c = 0;
  const auto slopes = [&](Eigen::Index i) { return (values.row(i + 1) - values.row(i)) / d; };
  (slopes(3) - slopes(0)).cwiseAbs().maxCoeff(&c);
  const double first = slopes(0)[c], last = slopes(3)[c];
  if (first == last) return {s + 2 * d, 2 * d};
  const double x = (values(4, c) - values(0, c) - last * 4 * d) / (first - last);
  return {s + std::min(std::max(x, 0.), 4 * d), 1e-3 * d};
}

class BreakSearch {
 public:
  static constexpr int samples = 256;  ///< intervals; four times as many where much stands out
  static constexpr int dense = 24;     ///< places that stand out, from which on there are more
  static constexpr int most = 128;     ///< jumps and kinks that are told apart

  /// `size`: what each component is measured by.
  BreakSearch(const SampledFunction& function, Eigen::RowVectorXd size, double length)
      : function_(function), size_(std::move(size)), length_(length) {}

  /// Finds what is between a and b; false if more stands out than is worth following.
  bool look(double a, double b, int intervals, int worth, int depth = 0) {
    const auto s = evenly(a, b, intervals);
    Samples values;
    sample(s, values);
    const auto peaks = peaks_of(fourth_differences(std::move(values)));
    if (std::ssize(peaks) > worth) return false;
    const double d = (b - a) / intervals;
    for (const auto i : peaks) {
      if (std::ssize(known_) > most) break;
      if (const auto place = followed(s[i], d)) keep(*place, d, depth);
    }
    return true;
  }

  Breaks found() const {
    const bool many = std::ssize(known_) > most;
    Breaks out{{}, many || unresolved_};
    if (many) return out;
    for (const auto& known : known_) out.at.push_back(known.at);
    std::ranges::sort(out.at);
    return out;
  }

 private:
  static constexpr double smallest = 1e-7;   ///< differences that stand out, of the largest value
  static constexpr double rounding = 3e-12;  ///< differences that may be rounding
  static constexpr double apart = 1e-6;      ///< of the length: places that are nearer are one
  static constexpr int strip = 16;     ///< intervals in which the neighbourhood is looked at again
  static constexpr int halvings = 24;  ///< after which what has no order yet has none

  /// `around`: how far beside the place others were looked for.
  struct Known {
    double at, around;
  };

  void sample(std::span<const double> s, Samples& values) const {
    function_(s, values);
    require(values.rows() == std::ssize(s) && values.cols() == size_.size(),
            "a function of arc length gives ", values.cols(), " numbers at ", s[0], ", and ",
            size_.size(), " at 0");
    values.array().rowwise() /= size_.array();
  }

  static std::vector<std::size_t> peaks_of(const std::vector<double>& sizes) {
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      const double before = i == 0 ? 0 : sizes[i - 1];
      const double behind = i + 1 == sizes.size() ? 0 : sizes[i + 1];
      if (sizes[i] > smallest && sizes[i] >= before && sizes[i] >= behind) out.push_back(i);
    }
    return out;
  }

  /// Takes a place, and looks for others that it hides.
  void keep(BreakPlace place, double d, int depth) {
    const double margin = apart * length_ + 2 * place.width;
    if (!(margin < place.at && place.at < length_ - margin)) return;
    const auto is = [&](const Known& known) { return std::abs(place.at - known.at) < margin; };
    auto known = std::ranges::find_if(known_, is);
    if (known == known_.end()) known = known_.insert(known, {place.at, 0});
    if (known->around >= d) return;
    known->around = d;
    const double x = known->at;
    if (depth == 2) return;
    for (const auto& [from, to] :
         {std::pair(x - 4 * d, x - margin), std::pair(x + margin, x + 4 * d)}) {
      const double a = std::max(from, 0.), b = std::min(to, length_);
      if (b - a > 8 * margin) look(a, b, strip, strip, depth + 1);
    }
  }

  /// What is between s and s + 4 d; none: it is smooth.
  std::optional<BreakPlace> followed(double s, double d) {
    Samples values, between, finer(9, size_.size());
    sample(std::array{s, s + d, s + 2 * d, s + 3 * d, s + 4 * d}, values);
    std::vector<double> sizes;
    while (std::ssize(sizes) < halvings) {
      d /= 2;
      sample(std::array{s + d, s + 3 * d, s + 5 * d, s + 7 * d}, between);
      for (Eigen::Index i = 0; i < 9; ++i)
        finer.row(i) = i % 2 == 0 ? values.row(i / 2) : between.row(i / 2);
      const auto differences = fourth_differences(finer);
      const auto k =
          std::ranges::max_element(differences, [](double a, double b) { return exceeds(b, a); }) -
          differences.begin();
      s += double(k) * d;
      values = finer.middleRows(k, 5);
      sizes.push_back(differences[std::size_t(k)]);
      if (sizes.back() < rounding || order(sizes) > 2.6) return std::nullopt;
      if (sizes.size() < 6) continue;
      if (const auto place = settled(sizes, s, d, values)) return place;
    }
    unresolved_ = true;  // singular: it tends to no order
    return std::nullopt;
  }

  /// The power of the distance with which the last sizes fall; 0: too few to say.
  static double order(const std::vector<double>& sizes) {
    const auto n = sizes.size();
    return n >= 6 ? std::log2(sizes[n - 4] / sizes[n - 1]) / 3 : 0;
  }

  /// The place of a jump, a kink or a jump of the second derivative, if it is clear by now.
  std::optional<BreakPlace> settled(const std::vector<double>& sizes, double s, double d,
                                    const Samples& values) const {
    const double p = order(sizes);
    if (p < 0.3 && sizes.size() % 6 == 0) return jump(s, s + 4 * d, sizes.back());
    if (sizes.back() < 100 * rounding || (p > 1.6 && sizes.size() >= 12))
      return BreakPlace{s + 2 * d, 2 * d};
    if (0.8 < p && p < 1.3 && sizes.size() >= 10) return meeting(s, d, values);
    return std::nullopt;
  }

  /// Halved until its ends are neighbours; none if it is none after all.
  std::optional<BreakPlace> jump(double low, double high, double size) const {
    Samples first, last, at;
    sample(std::array{low}, first);
    sample(std::array{high}, last);
    while (high - low > 1e-15 * length_) {
      const double middle = (low + high) / 2;
      sample(std::array{middle}, at);
      const bool before = largest((at - first).row(0).eval()) > largest((last - at).row(0).eval());
      (before ? high : low) = middle;
      (before ? last : first).swap(at);
    }
    if (!(largest((last - first).row(0).eval()) > size / 4)) return std::nullopt;
    return BreakPlace{high, 0};
  }

  const SampledFunction& function_;
  Eigen::RowVectorXd size_;
  double length_;
  std::vector<Known> known_;
  bool unresolved_ = false;
};

}  // namespace detail

/// The jumps, kinks and jumps of the second derivative inside [0, length].
inline Breaks breaks_of(const SampledFunction& function, double length) {
  using Search = detail::BreakSearch;
  Samples some;
  function(detail::evenly(0, length, 16), some);
  if (some.size() == 0 || !some.allFinite()) return {};
  Eigen::RowVectorXd size = some.cwiseAbs().colwise().maxCoeff();
  const double most = size.maxCoeff();
  size = (size.array() == 0).select(most > 0 ? most : 1., size);
  Search coarse(function, size, length);
  if (coarse.look(0, length, Search::samples, Search::dense)) return coarse.found();
  Search fine(function, size, length);
  fine.look(0, length, 4 * Search::samples, 4 * Search::samples);
  return fine.found();
}

}  // namespace pyrod
