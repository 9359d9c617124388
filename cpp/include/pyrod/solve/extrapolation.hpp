// SPDX-License-Identifier: BSD-3-Clause
/// \file What results on grids of h, h/2, h/4, … tend to, and how far from it one is.
///
/// The errors of a symmetric scheme have an expansion in whole powers of h, from the second on. Its
/// terms are eliminated one by one (Richardson, Romberg). Nothing is believed unseen: the ratios of
/// successive differences must be those of the powers, as section 12 of docs/theory.md tells.
#pragma once

#include <pyrod/core/types.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace pyrod {

/// Numbers that are judged together: `width` of them from `first` on, part of a quantity. Numbers
/// without a row are extrapolated like the others.
struct Row {
  int first, width, quantity;
};

/// Which errors are compared with what.
struct Judgement {
  std::vector<Row> rows;
  std::vector<double> scales;  ///< of the quantities; errors are relative to them
  bool even = false;           ///< whether the expansion has even powers only
  double noise = 1e-15;        ///< relative rounding errors of the finest grid
};

struct Extrapolated {
  Vector values;
  std::vector<double> errors;  ///< of the quantities; infinite where nothing can be said
  double order = std::numeric_limits<double>::quiet_NaN();  ///< of the grids' own errors, as seen
  bool regular = false;                                     ///< the differences shrink as expected

  double error() const { return *std::max_element(errors.begin(), errors.end()); }
};

class Extrapolation {
 public:
  /// `levels`: results on successively halved grids, the coarsest first.
  Extrapolation(std::span<const Vector> levels, Judgement judgement)
      : judgement_(std::move(judgement)),
        last_(int(levels.size()) - 1),
        weights_(Vector::Zero(levels[0].size())) {
    for (const auto& row : judgement_.rows)
      weights_.segment(row.first, row.width).setConstant(1 / judgement_.scales[row.quantity]);
    columns_.reserve(levels.size());
    auto& grids = columns_.emplace_back(weights_.size(), last_ + 1);
    for (int k = 0; k <= last_; ++k) grids.col(k) = levels[std::size_t(k)];
  }

  Extrapolated result();

  /// Of two grids alone, by the word of the caller that the errors are of second order.
  Extrapolated trusted();

 private:
  /// Of column m of the tableau.
  auto finest(int m) const { return columns_[std::size_t(m)].col(last_ - m); }
  auto coarsest(int m) const { return columns_[std::size_t(m)].col(0); }

  /// Grid k less grid k − 1, in column m of the tableau.
  auto difference(int m, int k) const {
    const auto& column = columns_[std::size_t(m)];
    return column.col(k - m) - column.col(k - m - 1);
  }

  /// Of a vector, or what is computed when it is asked for.
  template <class V>
  auto weighted(const V& v) const {
    return v.cwiseProduct(weights_);
  }

  /// 2^p − 1 and p of the power that column m eliminates.
  int power(int m) const { return judgement_.even ? 2 * (m + 1) : m + 2; }
  double divisor(int m) const { return std::exp2(power(m)) - 1; }

  /// Column m + 1 from column m: T + (T − T of the coarser grid)/(2^p − 1).
  void eliminate() {
    for (int m = 0; m < last_ - 1; ++m) {
      const auto& T = columns_.back();
      const auto finer = T.rightCols(last_ - m), coarser = T.leftCols(last_ - m);
      columns_.push_back(finer + (finer - coarser) / divisor(m));  // there is room: T stays
    }
  }

  /// The last difference of column m over the one before, as far as they are parallel.
  double shrinking(int m) const {
    const auto now = weighted(difference(m, last_)), before = weighted(difference(m, last_ - 1));
    const double square = before.squaredNorm();
    return square > 0 ? now.dot(before) / square : 0;
  }

  bool seen(int m) const { return size(difference(m, last_)) > 100 * judgement_.noise; }

  /// Where odd powers are excluded, none shows.
  bool even_as_told() const {
    if (!judgement_.even || last_ < 3 || !seen(1)) return true;
    const double ratio = shrinking(1);
    return ratio > 1. / 24 && ratio < 1. / 11;
  }

  /// What is told are the values before the last elimination. Their column shrinks no less than the
  /// one before it was seen to, which tells their errors, theory (25): where rounding hides the
  /// powers, or a layer thinner than h, these are as large as the differences. Grids whose own
  /// errors do not yet shrink quite as they should have more behind them. Errors that happen to
  /// vanish on this grid are kept from a part of what they were on the one before.
  std::vector<double> corrections() const {
    const int m = last_ - 1;
    const double ratio = std::clamp(decay(m - 1), std::exp2(1 - power(m)), 0.75);
    // of three grids, the ratio is that of the errors themselves: cautious enough
    const double early = m > 1 ? 1 + 20 * std::abs(4 * shrinking(0) - 1) : 1;
    const double caution = 1.5 * early * ratio / (1 - ratio);
    const Vector now = caution * difference(m, last_);
    const Vector before = caution * divisor(m) * (coarsest(m) - coarsest(m - 1));
    const double smaller = size(before) > 0 ? std::min(1., size(now) / size(before)) : 1;
    auto errors = sizes(now);
    const auto earlier = sizes(0.4 * smaller * before);
    for (std::size_t i = 0; i < errors.size(); ++i) errors[i] = std::max(errors[i], earlier[i]);
    return errors;
  }

  /// By how much the differences of a column shrink.
  double decay(int m) const {
    const double before = weighted(difference(m, last_ - 1)).norm();
    return before > 0 ? weighted(difference(m, last_)).norm() / before : 1;
  }

  /// The finest grid as it is; its error from how the last three differences shrink.
  Extrapolated plain(Extrapolated& out) const {
    out.values = finest(0);
    if (last_ < 4) return out;
    const auto norm = [&](int k) { return weighted(difference(0, k)).norm(); };
    const double before = norm(last_ - 1);
    const double ratio = std::max(norm(last_) / before, before / norm(last_ - 2));
    if (!(ratio < 0.75)) return out;
    out.errors = sizes(3 * ratio / (1 - ratio) * difference(0, last_));
    return bounded(out);
  }

  template <class V>
  std::vector<double> sizes(const V& v) const {
    std::vector<double> out(judgement_.scales.size(), 0);
    for (const auto& row : judgement_.rows)
      out[row.quantity] =
          std::max(out[row.quantity], v.segment(row.first, row.width).norm() * weights_[row.first]);
    return out;
  }

  template <class V>
  double size(const V& v) const {
    return weighted(v).template lpNorm<Eigen::Infinity>();
  }

  Extrapolated bounded(Extrapolated& out) const {
    for (auto& error : out.errors) error = std::max(error, judgement_.noise);
    return std::move(out);
  }

  Judgement judgement_;
  int last_;
  Vector weights_;
  std::vector<Eigen::MatrixXd> columns_;  ///< of the tableau, the coarsest grid first
};

inline Extrapolated Extrapolation::result() {
  Extrapolated out;
  out.values = finest(0);
  out.errors.assign(judgement_.scales.size(), std::numeric_limits<double>::infinity());
  if (last_ < 2) return out;
  const double change = size(difference(0, last_)), ratio = shrinking(0);
  out.order = -std::log2(std::abs(ratio));
  if (change < 30 * judgement_.noise) {
    out.regular = true;
    out.errors = sizes(2 * difference(0, last_));
    return bounded(out);
  }
  eliminate();
  out.regular = ratio > 0.22 && ratio < 0.28 && even_as_told();
  if (!out.regular) return plain(out);
  out.values = finest(last_ - 1);
  out.errors = corrections();
  return bounded(out);
}

inline Extrapolated Extrapolation::trusted() {
  if (last_ != 1) return result();
  Extrapolated out;
  out.values = finest(0);
  out.regular = true;
  out.errors = sizes(2. / 3 * difference(0, 1));
  return bounded(out);
}

/// What one number tends to; its error is relative.
struct Limit {
  double value, error = std::numeric_limits<double>::infinity();
};

/// Of a number that coarse grids may tell irregularly, such as a maximum: as many of the finest are
/// taken, three or more, as tell the least error, three times which is told. If none do, the finest
/// is told, which is at most by its last change from its limit if errors fall to a half.
inline Limit limit_of(const std::vector<double>& levels, double scale, bool even, double noise) {
  Limit best{levels.back()};
  if (levels.size() > 1)
    best.error = 2 * std::abs(levels.back() - levels[levels.size() - 2]) / scale + noise;
  for (auto from = levels.begin(); levels.end() - from >= 3; ++from) {
    std::vector<Vector> taken;
    for (auto level = from; level != levels.end(); ++level)
      taken.push_back(Vector::Constant(1, *level));
    const auto found = Extrapolation(taken, {{{0, 1, 0}}, {scale}, even, noise}).result();
    if (3 * found.error() < best.error) best = {found.values[0], 3 * found.error()};
  }
  return best;
}

}  // namespace pyrod
