// SPDX-License-Identifier: BSD-3-Clause
/// \file CHOLMOD's simplicial LDLᵀ, owned: analysed once, factorised often, with the inertia.
///
/// Only functions of CHOLMOD's Core/Utility and Ldlt modules are called (LGPL). CHOLMOD reports
/// trouble sparingly: an indefinite matrix is factorised without a word, and so is one with NaN. So
/// every outcome is looked at here.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/sparse/symmetric.hpp>

#include <cholmod.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace pyrod {

/// Numbers of negative, and of zero or non-finite, pivots: the inertia of the factorised matrix.
struct Inertia {
  int negative = 0, broken = 0;
};

class Ldlt {
 public:
  /// Symbolic factorisation in the given numbering. Keeps a pointer to `A`, whose pattern must not
  /// change and whose values are read by `factorise`.
  explicit Ldlt(const SymmetricMatrix& A) : matrix_(&A) {
    cholmod_start(&common_);
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_NATURAL;
    common_.postorder = false;
    common_.supernodal = CHOLMOD_SIMPLICIAL;
    common_.final_ll = false;
    common_.error_handler = nullptr;
    common_.print = 0;
    auto view = sparse_view();
    factor_ = cholmod_analyze(&view, &common_);
    if (!factor_) {
      cholmod_finish(&common_);
      throw std::bad_alloc();
    }
  }
  Ldlt(const Ldlt&) = delete;
  Ldlt& operator=(const Ldlt&) = delete;
  ~Ldlt() {
    cholmod_free_dense(&work_y_, &common_);
    cholmod_free_dense(&work_e_, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  /// Factorises A + shift·I and returns its inertia.
  Inertia factorise(double shift = 0) {
    auto view = sparse_view();
    double beta[2] = {shift, 0};
    cholmod_factorize_p(&view, beta, nullptr, 0, factor_, &common_);
    if (common_.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
    return inertia();
  }

  /// Factorises A + diag(added), where A must be the matrix that this looks at. It is left as it
  /// was.
  Inertia factorise(SymmetricMatrix& A, const Vector& added) {
    saved_.resize(std::size_t(A.size()));
    for (int k = 0; k < A.size(); ++k) {
      saved_[k] = A.diagonal(k);
      A.diagonal(k) += added[k];
    }
    const Inertia found = factorise();
    for (int k = 0; k < A.size(); ++k) A.diagonal(k) = saved_[k];
    return found;
  }

  /// Solves with the last factor; `b` and the result have A's size. `x` may be `b`.
  void solve(const Vector& b, Vector& x) {
    x.resize(b.size());
    solve(dense_view(b), dense_view(x));
  }

  /// Overwrites columns by solutions. CHOLMOD takes four at a time.
  void solve(Eigen::MatrixXd& columns) { solve(dense_view(columns), dense_view(columns)); }

  /// CHOLMOD's cheap estimate of the reciprocal condition number: smallest over largest pivot.
  double reciprocal_condition() { return cholmod_rcond(factor_, &common_); }

  /// Memory that CHOLMOD holds.
  std::size_t bytes() const { return common_.memory_inuse; }

  /// Entries of the factor, to compare with the matrix's own: equal when there is no fill.
  std::size_t factor_entries() const {
    const auto* count = static_cast<const int*>(factor_->ColCount);
    std::size_t sum = 0;
    for (std::size_t k = 0; k < factor_->n; ++k) sum += std::size_t(count[k]);
    return sum;
  }

 private:
  cholmod_sparse sparse_view() const {
    cholmod_sparse view{};
    view.nrow = view.ncol = std::size_t(matrix_->size());
    view.nzmax = matrix_->values.size();
    view.p = const_cast<int*>(matrix_->starts.data());
    view.i = const_cast<int*>(matrix_->rows.data());
    view.x = const_cast<double*>(matrix_->values.data());
    view.stype = 1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = true;
    return view;
  }

  void solve(cholmod_dense right, cholmod_dense left) {
    keep_workspace();
    auto* out = &left;  // large enough: kept
    const int done = cholmod_solve2(CHOLMOD_A, factor_, &right, nullptr, &out, nullptr, &work_y_,
                                    &work_e_, &common_);
    if (!done) throw std::bad_alloc();
  }

  /// CHOLMOD keeps a workspace only if it has the shape that is asked for; it is left with that of
  /// its last use, one row of the four that were allocated.
  void keep_workspace() {
    if (!work_y_ || work_y_->ncol == 0) return;
    work_y_->nrow = work_y_->d = work_y_->nzmax / work_y_->ncol;
  }

  static cholmod_dense dense_view(const Eigen::MatrixXd& columns) {
    return dense_view(columns.data(), columns.rows(), columns.cols());
  }
  static cholmod_dense dense_view(const Vector& v) { return dense_view(v.data(), v.size(), 1); }
  static cholmod_dense dense_view(const double* from, Eigen::Index rows, Eigen::Index cols) {
    cholmod_dense view{};
    view.nrow = view.d = std::size_t(rows);
    view.ncol = std::size_t(cols);
    view.nzmax = view.nrow * view.ncol;
    view.x = const_cast<double*>(from);
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    return view;
  }

  Inertia inertia() const {
    constexpr std::uint64_t infinity = std::uint64_t(0x7ff) << 53;  // without its sign
    Inertia count;
    const auto* starts = static_cast<const int*>(factor_->p);
    const auto* values = static_cast<const double*>(factor_->x);
    for (std::size_t k = 0; k < factor_->n; ++k) {  // by bits: no branches, few comparisons
      const auto bits = std::bit_cast<std::uint64_t>(values[starts[k]]);
      const bool broken = (bits << 1) - 1 >= infinity - 1;  // also zero, which wraps around
      count.broken += broken;
      count.negative += int(bits >> 63) & !broken;
    }
    return count;
  }

  const SymmetricMatrix* matrix_;
  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
  std::vector<double> saved_;
  cholmod_dense *work_y_ = nullptr, *work_e_ = nullptr;
};

}  // namespace pyrod
