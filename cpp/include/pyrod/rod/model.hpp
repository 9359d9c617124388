// SPDX-License-Identifier: BSD-3-Clause
/// \file The three rod models as data: which of the strains Γ − e3 may differ from zero.
///
/// A model is a *compliance* S and nothing else: Γ = e3 + S b, with b the material section force. A
/// strain that a model constrains has S = 0 (Linn B.6): its stiffness is infinite.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rotation/space.hpp>

#include <cmath>
#include <limits>

namespace pyrod {

enum class ModelKind { cosserat, extensible, inextensible };

/// The diagonal of S from (GA1, GA2, EA), or (GA1, EA) in the plane.
template <int N>
Vec<N> compliance(const Vec<N>& stiffness) {
  return stiffness.cwiseInverse();
}

/// The stiffness that stores energy: a strain that an infinite one forbids stores none.
template <int N>
Vec<N> storing_stiffness(const Vec<N>& stiffness) {
  return stiffness.unaryExpr([](double c) { return std::isfinite(c) ? c : 0; });
}

/// The rod with rigid what the model excludes.
template <class Space>
Rod<Space> in_model(Rod<Space> rod, ModelKind model) {
  constexpr double rigid = std::numeric_limits<double>::infinity();
  constexpr int last = Space::dim - 1;
  for (auto& C : rod.stretching) {
    if (model != ModelKind::cosserat) C.template head<last>().setConstant(rigid);
    if (model == ModelKind::inextensible) C[last] = rigid;
  }
  return rod;
}

}  // namespace pyrod
