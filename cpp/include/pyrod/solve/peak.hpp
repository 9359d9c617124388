// SPDX-License-Identifier: BSD-3-Clause
/// \file The largest value of a smooth function that is known at points, between them too.
#pragma once

#include <pyrod/core/types.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace pyrod {

/// At every high local maximum among the points from `first` to `last` a polynomial through its
/// neighbours is searched, if a parabola may rise above what was found so far.
template <class Values>
class Peak {
 public:
  /// `s`: the points, increasing; `values(j)`: at point j.
  Peak(const Vector& s, const Values& values, int first, int last)
      : s_(s), y_(values), first_(first), last_(last) {}

  double highest() const {
    double best = y_(last_);
    for (int j = first_; j < last_; ++j) best = std::max(best, y_(j));
    if (last_ - first_ < 2) return best;
    const double high = best - 0.75 * std::abs(best);  // no peak beside lower points tops that
    for (int j = first_; j <= last_; ++j) {
      const double y = y_(j);
      if (y < high || (j > first_ && y_(j - 1) > y) || (j < last_ && y_(j + 1) > y)) continue;
      best = std::max(best, near(j, best));
    }
    return best;
  }

 private:
  static constexpr int most = 7;  ///< points of a polynomial

  /// The top near point j, or less than `best` if it is not above that.
  double near(int j, double best) const {
    const int m = std::clamp(j, first_ + 1, last_ - 1);
    const double l = s_[m] - s_[m - 1], r = s_[m + 1] - s_[m];
    const double a = (y_(m) - y_(m - 1)) / l, b = (y_(m + 1) - y_(m)) / r;
    const double curvature = 2 * (b - a) / (l + r), slope = (a * r + b * l) / (l + r);
    if (!(curvature < 0)) return best;
    const double x = s_[m] - slope / curvature;
    if (x < s_[std::max(j - 1, first_)] || x > s_[std::min(j + 1, last_)]) return best;
    const double top = y_(m) - slope * slope / (2 * curvature);
    return y_(j) + 2 * (top - y_(j)) > best ? climbed(j, x) : best;
  }

  /// Newton's method for the top of the polynomial, from x on.
  double climbed(int j, double x) const {
    const int from = std::clamp(j - most / 2, first_, std::max(first_, last_ - most + 1)),
              count = std::min(most, last_ - from + 1);
    std::array<double, most> c{};
    for (int i = 0; i < count; ++i) c[i] = y_(from + i);
    for (int k = 1; k < count; ++k)  // divided differences
      for (int i = count; i-- > k;) c[i] = (c[i] - c[i - 1]) / (s_[from + i] - s_[from + i - k]);
    const double low = s_[std::max(j - 1, first_)], high = s_[std::min(j + 1, last_)];
    double value = y_(j);
    for (int step = 0; step < 6; ++step) {
      double p = c[count - 1], slope = 0, twice = 0;  // the last is half of p''
      for (int i = count - 1; i-- > 0;) {
        const double t = x - s_[from + i];
        twice = twice * t + slope, slope = slope * t + p, p = p * t + c[i];
      }
      value = std::max(value, p);
      if (!(twice < 0)) break;
      const double next = std::clamp(x - slope / (2 * twice), low, high);
      if (std::abs(next - x) <= 1e-12 * (high - low)) break;
      x = next;
    }
    return value;
  }

  const Vector& s_;
  const Values& y_;
  int first_, last_;
};

}  // namespace pyrod
