// SPDX-License-Identifier: BSD-3-Clause
/// \file How far a chain of edges reaches, and how that changes: the rows of the multiplier that
/// holds its ends.
#pragma once

#include <pyrod/core/pack.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>
#include <pyrod/statics/equations/chain.hpp>

#include <array>
#include <cstddef>

namespace pyrod {

/// Σ h R Γ of theory (14), what is left of it without strains by itself, so that small strains are
/// not rounded to the length; and Σ h R S Rᵀ, of which the upper triangle.
template <class Space>
struct Reach {
  Point<Space> rigid, strained;
  Mat<Space::dim> give;
};

/// The reach, and for each of the first `open` columns of C the row ∂(Cᵀ Σ h R Γ)/∂φ, where
/// ∂(h R Γ)/∂φ = h R ([b]ᵀ S − [Γ]), Bᵀ of theory (17); a kernel.
template <class Space>
class ChainReach {
 public:
  static constexpr int dim = Space::dim, spin = Space::spin;

  /// `rows`: where the rows go, one number for each unknown of the chain.
  ChainReach(const Chain<Space>& chain, const Mat<dim>& C, int open,
             const std::array<double*, dim>& rows, Reach<Space>& out)
      : chain_(chain), C_(C), open_(open), rows_(rows), out_(out) {}

  template <int W>
  void run() const {
    using Real = Pack<W>;
    using Values = Point<Space, Real>;
    std::array<Sum<W>, dim> rigid, strained;
    std::array<Sum<W>, dim*(dim + 1) / 2> give;
    for (int first = 0; first < chain_.edges; first += W) {
      const int count = std::min(W, chain_.edges - first), number = chain_.first + first;
      const auto frame = chain_.template frames_at<Real>(first);
      const Mat<dim, dim, Real> R = matrix<Real>(frame);
      const Real h = leading(chain_.columns.lengths.template at<Real>(number)[0], count);
      const Values S = chain_.columns.compliance.template at<Real>(number),
                   b = unrotate(frame, chain_.template force<Real>(first)),
                   strain = S.cwiseProduct(b), Γ = axis<Space, Real>() + strain;
      const Values stretched = R * strain;
      for (int i = 0; i < dim; ++i) {
        rigid[i].add(first, h * R(i, dim - 1));
        strained[i].add(first, h * stretched[i]);
      }
      const Mat<dim, dim, Real> RS = R * (h * S).asDiagonal();
      for (int l = 0, e = 0; l < dim; ++l)
        for (int i = 0; i <= l; ++i) give[e++].add(first, RS.row(i).dot(R.row(l)));
      for (int k = 0; k < open_; ++k)
        store(lever<Real>(h * turned(R, k), b, S, Γ), rows_[k] + std::ptrdiff_t(spin) * first,
              count);
    }
    for (int i = 0; i < dim; ++i) out_.rigid[i] = rigid[i].total();
    for (int i = 0; i < dim; ++i) out_.strained[i] = strained[i].total();
    for (int l = 0, e = 0; l < dim; ++l)
      for (int i = 0; i <= l; ++i) out_.give(i, l) = give[e++].total();
  }

 private:
  /// Rᵀ times column k of C.
  template <class Real>
  Point<Space, Real> turned(const Mat<dim, dim, Real>& R, int k) const {
    Point<Space, Real> c = R.row(0) * Real(C_(0, k));
    for (int i = 1; i < dim; ++i) c += R.row(i) * Real(C_(i, k));
    return c;
  }

  /// c × Γ + b × S c.
  template <class Real>
  static Vec<3, Real> lever(const Vec<3, Real>& c, const Vec<3, Real>& b, const Vec<3, Real>& S,
                            const Vec<3, Real>& Γ) {
    Vec<3, Real> out;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      out[i] = c[j] * (Γ[k] - S[j] * b[k]) - c[k] * (Γ[j] - S[k] * b[j]);
    }
    return out;
  }
  template <class Real>
  static Vec<1, Real> lever(const Vec<2, Real>& c, const Vec<2, Real>& b, const Vec<2, Real>& S,
                            const Vec<2, Real>& Γ) {
    return Vec<1, Real>(c[1] * (Γ[0] - S[1] * b[0]) - c[0] * (Γ[1] - S[0] * b[1]));
  }

  template <class Real>
  static void store(const Spin<Space, Real>& row, double* to, int count) {
    for (int lane = 0; lane < count; ++lane)
      for (int i = 0; i < spin; ++i) *to++ = row[i].values[lane];
  }

  const Chain<Space>& chain_;
  const Mat<dim>& C_;
  int open_;
  const std::array<double*, dim>& rows_;
  Reach<Space>& out_;
};

}  // namespace pyrod
