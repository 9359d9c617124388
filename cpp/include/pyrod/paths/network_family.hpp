// SPDX-License-Identifier: BSD-3-Clause
/// \file Networks that depend on a number, as a family whose paths can be followed.
#pragma once

#include <pyrod/core/hessian.hpp>
#include <pyrod/core/types.hpp>
#include <pyrod/paths/network_amplitude.hpp>
#include <pyrod/paths/network_source.hpp>
#include <pyrod/solve/family.hpp>
#include <pyrod/solve/problem.hpp>
#include <pyrod/sparse/block_symmetric.hpp>
#include <pyrod/statics/equations/network_problem.hpp>
#include <pyrod/statics/unknowns/layout.hpp>
#include <pyrod/statics/unknowns/network_state.hpp>

#include <memory>
#include <utility>

namespace pyrod {

template <class Space>
class NetworkFamily {
 public:
  using State = NetworkState<Space>;
  using Storage = Linearisation<BlockSymmetric>;

  explicit NetworkFamily(std::unique_ptr<NetworkSource<Space>> source)
      : source_(std::move(source)), weights_(problem().weights()) {}

  const Layout<Space>& layout() const { return source_->layout(); }
  const NetworkProblem<Space>& problem() const { return source_->problem(); }

  void set(double λ) { source_->set(λ); }
  void place(State& x) const { source_->place(x); }
  void slope(const State& x, Vector& w) { source_->slope(x, w); }
  double amplitude(const State& x0, const State& x, const Vector& mode, Vector& gradient) const {
    return pyrod::amplitude(layout(), weights_, x0, x, mode, gradient);
  }

  // Of the problem as it is now.
  Storage linearisation() const { return problem().linearisation(); }
  void linearise(const State& x, Hessian kind, Storage& out) const {
    problem().linearise(x, kind, out);
  }
  void move(const State& x, const Vector& δ, State& out) const { problem().move(x, δ, out); }
  bool conservative() const { return problem().conservative(); }
  bool dead_loads() const { return problem().dead_loads(); }
  void multiply_skew(const State& x, const Vector& v, Vector& out) const {
    problem().multiply_skew(x, v, out);
  }
  void multiplier_sizes(const State& x, Vector& out) const { problem().multiplier_sizes(x, out); }
  void rounding(const State& x, Vector& out) const { problem().rounding(x, out); }
  const Vector& weights() const { return weights_; }
  const Vector& units() const { return problem().units(); }
  const Vector& stiffness() const { return problem().stiffness(); }
  const Vector& softness() const { return problem().softness(); }
  double unit_energy() const { return problem().unit_energy(); }
  double least_shift() const { return problem().least_shift(); }

 private:
  std::unique_ptr<NetworkSource<Space>> source_;
  Vector weights_;
};

static_assert(Family<NetworkFamily<Planar>> && Family<NetworkFamily<Spatial>>);

}  // namespace pyrod
