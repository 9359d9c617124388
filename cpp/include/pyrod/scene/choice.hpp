// SPDX-License-Identifier: BSD-3-Clause
/// \file Space and model chosen at run time.
#pragma once

#include <pyrod/rod/model.hpp>
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

}  // namespace pyrod
