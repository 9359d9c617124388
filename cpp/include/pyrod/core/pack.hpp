// SPDX-License-Identifier: BSD-3-Clause
/// \file Several numbers that go through a formula together: the scalar type with which a kernel
/// that is written for one edge computes as many as a vector register holds.
///
/// A formula over `Real` serves doubles and packs alike; where it branches it asks `everywhere` and
/// `select`, which doubles have as well. What a lane becomes does not depend on its neighbours.
#pragma once

#include <pyrod/core/types.hpp>

#include <array>
#include <cmath>
#include <type_traits>

namespace pyrod {

namespace detail {

template <int W>
struct Lanes;
#define PYROD_LANES(W)                                                                \
  template <>                                                                         \
  struct Lanes<W> {                                                                   \
    typedef double Values __attribute__((vector_size(8 * W)));                        \
    typedef long long Bits __attribute__((vector_size(8 * W)));                       \
    typedef double Memory __attribute__((vector_size(8 * W), aligned(8), may_alias)); \
  }
PYROD_LANES(2);
PYROD_LANES(4);
PYROD_LANES(8);
#undef PYROD_LANES

}  // namespace detail

/// What a comparison of packs gives: all bits of a lane, or none.
template <int W>
struct Mask {
  typename detail::Lanes<W>::Bits bits;

  Mask() = default;
  Mask(const Mask& other) : bits(other.bits) {}
  Mask& operator=(const Mask&) = default;
  friend Mask operator&(Mask a, const Mask& b) {
    a.bits &= b.bits;
    return a;
  }
};

/// W doubles. Copying is spelled out so that no function takes or returns a pack in registers:
/// which registers there are depends on the instruction set a function is compiled for, and
/// functions for different ones call each other.
template <int W>
struct Pack {
  using Values = typename detail::Lanes<W>::Values;
  using Memory = typename detail::Lanes<W>::Memory;
  static constexpr int width = W;
  Values values;

  Pack() = default;
  Pack(const Pack& other) : values(other.values) {}
  Pack& operator=(const Pack& other) {
    values = other.values;
    return *this;
  }
  template <class T>
    requires std::is_arithmetic_v<T>
  Pack(T same) {
    values = Values{} + double(same);
  }

  static Pack load(const double* from) {
    Pack out;
    out.values = *reinterpret_cast<const Memory*>(from);
    return out;
  }
  static Pack load(const double* from, int stride) {
    Pack out(0);
    for (int i = 0; i < W; ++i) out.values[i] = from[i * stride];
    return out;
  }
  void store(double* to) const { *reinterpret_cast<Memory*>(to) = values; }
  void store(double* to, int stride) const {
    for (int i = 0; i < W; ++i) to[i * stride] = values[i];
  }

  Pack& operator+=(const Pack& b) {
    values += b.values;
    return *this;
  }
  Pack& operator-=(const Pack& b) {
    values -= b.values;
    return *this;
  }
  Pack& operator*=(const Pack& b) {
    values *= b.values;
    return *this;
  }
  Pack& operator/=(const Pack& b) {
    values /= b.values;
    return *this;
  }
  friend Pack operator+(Pack a, const Pack& b) { return a += b; }
  friend Pack operator-(Pack a, const Pack& b) { return a -= b; }
  friend Pack operator*(Pack a, const Pack& b) { return a *= b; }
  friend Pack operator/(Pack a, const Pack& b) { return a /= b; }
  friend Pack operator-(Pack a) {
    a.values = -a.values;
    return a;
  }
  friend Mask<W> operator<(const Pack& a, const Pack& b) { return mask(a.values < b.values); }
  friend Mask<W> operator<=(const Pack& a, const Pack& b) { return mask(a.values <= b.values); }
  friend Mask<W> operator>(const Pack& a, const Pack& b) { return mask(a.values > b.values); }
  friend Mask<W> operator==(const Pack& a, const Pack& b) { return mask(a.values == b.values); }

 private:
  template <class Bits>
  static Mask<W> mask(const Bits& bits) {
    Mask<W> out;
    out.bits = reinterpret_cast<typename detail::Lanes<W>::Bits>(bits);
    return out;
  }
};

/// How many numbers a scalar of a kernel stands for; 0 for what is none.
template <class T>
inline constexpr int width_of = 0;
template <>
inline constexpr int width_of<double> = 1;
template <int W>
inline constexpr int width_of<Pack<W>> = W;

template <class T>
concept Number = width_of<T> > 0;

/// Whether a condition holds in every lane.
inline bool everywhere(bool condition) { return condition; }
template <int W>
bool everywhere(const Mask<W>& condition) {
  long long every = -1;
  for (int i = 0; i < W; ++i) every &= condition.bits[i];
  return every != 0;
}

/// a where the condition holds, else b.
inline double select(bool condition, double a, double b) { return condition ? a : b; }
template <int W>
Pack<W> select(const Mask<W>& condition, const Pack<W>& a, const Pack<W>& b) {
  Pack<W> out;
  out.values = condition.bits ? a.values : b.values;
  return out;
}

template <int W>
Pack<W> sqrt(const Pack<W>& a) {
  Pack<W> out;
  for (int i = 0; i < W; ++i) out.values[i] = std::sqrt(a.values[i]);
  return out;
}
template <int W>
Pack<W> abs(const Pack<W>& a) {
  return select(a < Pack<W>(0), -a, a);
}
template <int W>
Pack<W> max(const Pack<W>& a, const Pack<W>& b) {
  return select(a < b, b, a);
}

/// The lanes of a, one further down; the last lane becomes the first of `next`.
template <int W>
Pack<W> shifted(const Pack<W>& a, const Pack<W>& next) {
  Pack<W> out;
  for (int i = 0; i + 1 < W; ++i) out.values[i] = a.values[i + 1];
  out.values[W - 1] = next.values[0];
  return out;
}

/// a in the first lanes, zero in the others.
template <int W>
Pack<W> leading(const Pack<W>& a, int lanes) {
  Pack<W> out = a;
  for (int i = lanes; i < W; ++i) out.values[i] = 0;
  return out;
}

/// A long sum of packs. Number j goes to the partial sum j mod 8, so that the result does not
/// depend on W.
template <int W>
class Sum {
 public:
  /// Numbers j, j + 1, …; j is a multiple of W.
  void add(int j, const Pack<W>& a) { parts_[j / W % packs] += a; }

  double total() const {
    double sum = 0;
    for (const auto& part : parts_)
      for (int i = 0; i < W; ++i) sum += part.values[i];
    return sum;
  }

 private:
  static constexpr int packs = 8 / W;
  std::array<Pack<W>, packs> parts_ = [] {
    std::array<Pack<W>, packs> zero;
    zero.fill(Pack<W>(0));
    return zero;
  }();
};

}  // namespace pyrod

/// A pack is a scalar to Eigen's fixed-size vectors and matrices.
template <int W>
struct Eigen::NumTraits<pyrod::Pack<W>> : Eigen::GenericNumTraits<double> {
  using Real = pyrod::Pack<W>;
  using NonInteger = pyrod::Pack<W>;
  using Nested = pyrod::Pack<W>;
  using Literal = pyrod::Pack<W>;  // what Eigen makes of the 2 in v / 2
  enum { RequireInitialization = 0 };
};

/// It has its own alignment, which is larger than what Eigen would ask for.
template <int W, int Size>
struct Eigen::internal::compute_default_alignment<pyrod::Pack<W>, Size> {
  enum { value = 0 };
};
