// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method on a manifold: the method and its search along a step.
#pragma once

#include <pyrod/solve/newton_method.hpp>
#include <pyrod/solve/newton_search.hpp>
