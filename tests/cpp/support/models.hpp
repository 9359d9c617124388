// SPDX-License-Identifier: BSD-3-Clause
/// \file Tests for each space and each model:
///   TEST_CASE_TEMPLATE("…", S, EACH_SPACE) { using Space = S; }
///   TEST_CASE_TEMPLATE("…", Case, EACH_MODEL) { using Space = typename Case::Space; … }
#pragma once

#include <pyrod/rod/model.hpp>

#include <doctest/doctest.h>

namespace pyrod::test {

/// A model as a type.
template <ModelKind model>
struct Of {
  static constexpr ModelKind kind = model;
  static constexpr bool shearable = model == ModelKind::cosserat;
  static constexpr bool extensible = model != ModelKind::inextensible;
};
using Cosserat = Of<ModelKind::cosserat>;
using ExtensibleKirchhoff = Of<ModelKind::extensible>;
using InextensibleKirchhoff = Of<ModelKind::inextensible>;

template <class S, class M>
struct With {
  using Space = S;
  using Model = M;
};

/// One edge's stiffness with rigid what the model excludes.
template <class Model, int N>
Vec<N> in(Vec<N> stiffness) {
  constexpr double rigid = std::numeric_limits<double>::infinity();
  if (!Model::shearable) stiffness.template head<N - 1>().setConstant(rigid);
  if (!Model::extensible) stiffness[N - 1] = rigid;
  return stiffness;
}

}  // namespace pyrod::test

#define EACH_SPACE ::pyrod::Planar, ::pyrod::Spatial
#define EACH_MODEL                                                                \
  ::pyrod::test::With<::pyrod::Planar, ::pyrod::test::Cosserat>,                  \
      ::pyrod::test::With<::pyrod::Planar, ::pyrod::test::ExtensibleKirchhoff>,   \
      ::pyrod::test::With<::pyrod::Planar, ::pyrod::test::InextensibleKirchhoff>, \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::test::Cosserat>,             \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::test::ExtensibleKirchhoff>,  \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::test::InextensibleKirchhoff>
