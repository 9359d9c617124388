// SPDX-License-Identifier: BSD-3-Clause
/// \file Space and model chosen at run time.
#pragma once

#include <pyrod/rod/model.hpp>
#include <pyrod/rod/rod.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/rotation/space.hpp>

namespace pyrod {

enum class Dimension { planar, spatial };
enum class ModelKind { cosserat, extensible, inextensible };

/// f(Planar{}) or f(Spatial{}).
template <class F>
auto in_space(Dimension dimension, const F& f) {
  return dimension == Dimension::planar ? f(Planar{}) : f(Spatial{});
}

/// f(Cosserat{}), f(ExtensibleKirchhoff{}) or f(InextensibleKirchhoff{}).
template <class F>
auto with_model(ModelKind model, const F& f) {
  switch (model) {
    case ModelKind::cosserat:
      return f(Cosserat{});
    case ModelKind::extensible:
      return f(ExtensibleKirchhoff{});
    case ModelKind::inextensible:
      break;
  }
  return f(InextensibleKirchhoff{});
}

/// The rod with rigid what the model excludes: a network knows a model by infinite stiffness.
inline Rod<Spatial> in_model(Rod<Spatial> rod, ModelKind model) {
  for (auto& C : rod.stretching) {
    if (model != ModelKind::cosserat) C[0] = C[1] = Section::rigid;
    if (model == ModelKind::inextensible) C[2] = Section::rigid;
  }
  return rod;
}

}  // namespace pyrod
