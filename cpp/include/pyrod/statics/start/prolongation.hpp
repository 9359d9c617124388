// SPDX-License-Identifier: BSD-3-Clause
/// \file Frames on a grid from those on coarser ones.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/curve/grid.hpp>
#include <pyrod/rotation/planar.hpp>
#include <pyrod/rotation/spatial.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

namespace pyrod {

/// The edges [first, last) of a grid, in which frames change smoothly.
struct Stretch {
  const Grid& grid;
  int first, last;

  explicit Stretch(const Grid& all) : Stretch(all, 0, all.edges()) {}
  Stretch(const Grid& all, int from, int to) : grid(all), first(from), last(to) {}

  int edges() const { return last - first; }
  double centre(int j) const { return grid.centre(first + j); }
};

namespace detail {

inline Vec<4> components(const Quaternion& q) { return q.coeffs(); }
inline Vec1 components(Angle a) { return Vec1(a.radians); }
inline Quaternion rotation(const Vec<4>& q) { return Quaternion(q).normalized(); }
inline Angle rotation(const Vec1& a) { return {a[0]}; }

/// The polynomial through four values in a row, or all if they are fewer, by divided differences.
template <class Value>
class Cubic {
 public:
  Cubic(const Stretch& on, const std::vector<Value>& values, int first) {
    const int count = std::min(4, on.edges());
    for (int i = 0; i < 4; ++i) {
      at_[i] = on.centre(first + std::min(i, count - 1));
      difference_[i] = i < count ? values[std::size_t(first + i)] : Value(Value::Zero());
    }
    for (int order = 1; order < count; ++order)
      for (int i = count - 1; i >= order; --i)
        difference_[i] = (difference_[i] - difference_[i - 1]) / (at_[i] - at_[i - order]);
  }

  Value operator()(double s) const {
    const double x0 = s - at_[0], x1 = s - at_[1], x2 = s - at_[2];
    Value out;
    for (int i = 0; i < Value::SizeAtCompileTime; ++i)
      out[i] = difference_[0][i] +
               x0 * (difference_[1][i] + x1 * (difference_[2][i] + x2 * difference_[3][i]));
    return out;
  }

 private:
  std::array<double, 4> at_;
  std::array<Value, 4> difference_;
};

/// Calls put(value) for the centres of all edges of `to`, in their order: cubic through the four
/// nearest of the values at the centres of `from`.
template <class Value, class Put>
void interpolate(const Stretch& from, const std::vector<Value>& values, const Stretch& to,
                 const Put& put) {
  const int last = std::max(0, from.edges() - 4);
  for (int J = 0, j = 0; j < to.edges(); ++J) {  // between the centres J and J + 1
    const double end =
        J + 2 < from.edges() ? from.centre(J + 1) : std::numeric_limits<double>::infinity();
    if (to.centre(j) > end) continue;
    const Cubic<Value> cubic(from, values, std::clamp(J - 1, 0, last));
    for (double s; j < to.edges() && (s = to.centre(j)) <= end; ++j) put(cubic(s));
  }
}

}  // namespace detail

/// What is known of frames on a grid, in the coordinates in which they are continued: quaternions
/// component by component, whose signs must be continued.
template <class Rotation>
using Components = decltype(detail::components(Rotation{}));

template <class Rotation>
std::vector<Components<Rotation>> components(const Rotation* frames, int count) {
  std::vector<Components<Rotation>> out;
  out.reserve(std::size_t(count));
  for (int j = 0; j < count; ++j) out.push_back(detail::components(frames[j]));
  return out;
}

/// Values on a finer grid, or a coarser one.
template <class Value>
std::vector<Value> interpolated(const Stretch& from, const std::vector<Value>& values,
                                const Stretch& to) {
  std::vector<Value> out;
  out.reserve(std::size_t(to.edges()));
  detail::interpolate(from, values, to, [&](const Value& v) { out.push_back(v); });
  return out;
}

/// Appends the frames that components on a coarser grid make expect: quaternions are brought back
/// to unit length.
template <class Rotation>
void prolong(const Stretch& from, const std::vector<Components<Rotation>>& frames,
             const Stretch& to, std::vector<Rotation>& out) {
  detail::interpolate(from, frames, to,
                      [&](const Components<Rotation>& q) { out.push_back(detail::rotation(q)); });
}

/// What is still to come, over the last change, of what differs from grid to grid by errors of
/// second order: from `now` edges to `finer` ones, after that from `before` to `now`. See
/// docs/theory.md, "Coarse grids first".
inline double still_to_come(int before, int now, int finer) {
  const auto square = [](double x) { return x * x; };
  if (before >= now) return 0;
  return (1 - square(double(now) / finer)) / (square(double(now) / before) - 1);
}

}  // namespace pyrod
