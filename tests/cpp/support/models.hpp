// SPDX-License-Identifier: BSD-3-Clause
/// \file Tests for each space and each model:
///   TEST_CASE_TEMPLATE("…", S, EACH_SPACE) { using Space = S; }
///   TEST_CASE_TEMPLATE("…", Case, EACH_MODEL) { using Space = typename Case::Space; … }
#pragma once

#include <pyrod/rod/model.hpp>

#include <doctest/doctest.h>

namespace pyrod::test {

template <class S, class M>
struct With {
  using Space = S;
  using Model = M;
};

}  // namespace pyrod::test

#define EACH_SPACE ::pyrod::Planar, ::pyrod::Spatial
#define EACH_MODEL                                                          \
  ::pyrod::test::With<::pyrod::Planar, ::pyrod::Cosserat>,                  \
      ::pyrod::test::With<::pyrod::Planar, ::pyrod::ExtensibleKirchhoff>,   \
      ::pyrod::test::With<::pyrod::Planar, ::pyrod::InextensibleKirchhoff>, \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::Cosserat>,             \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::ExtensibleKirchhoff>,  \
      ::pyrod::test::With<::pyrod::Spatial, ::pyrod::InextensibleKirchhoff>
