// SPDX-License-Identifier: BSD-3-Clause
/// \file The three rod models as types: which of the strains Γ − e3 may differ from zero.
///
/// A model is a *compliance* S and nothing else: Γ = e3 + S b, with b the material section force. A
/// strain that a model constrains has S = 0 (Linn B.6); its stiffness is not stored, read or
/// needed.
#pragma once

#include <pyrod/core/types.hpp>
#include <pyrod/rotation/space.hpp>

#include <type_traits>

namespace pyrod {

struct Cosserat {
  static constexpr bool shearable = true, extensible = true;
  static constexpr const char* name = "cosserat";
};

struct ExtensibleKirchhoff {
  static constexpr bool shearable = false, extensible = true;
  static constexpr const char* name = "extensible";
};

struct InextensibleKirchhoff {
  static constexpr bool shearable = false, extensible = false;
  static constexpr const char* name = "inextensible";
};

/// S of one edge, holding only the components that the model leaves free.
template <class Space, class Model>
class Compliance {
 public:
  static constexpr int dim = Space::dim;
  static constexpr int components = Model::shearable ? dim : Model::extensible ? 1 : 0;

  /// From the stiffnesses (GA1, GA2, EA), or (GA1, EA) in the plane.
  explicit Compliance(const Point<Space>& stiffness)
      : values_(stiffness.template tail<components>().cwiseInverse()) {}

  /// The diagonal of S.
  Point<Space> diagonal() const {
    Point<Space> S = Point<Space>::Zero();
    S.template tail<components>() = values_;
    return S;
  }

  /// S b.
  Point<Space> operator*(const Point<Space>& b) const { return diagonal().cwiseProduct(b); }

 private:
  Vec<components> values_;
};

}  // namespace pyrod
