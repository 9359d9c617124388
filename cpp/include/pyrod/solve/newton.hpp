// SPDX-License-Identifier: BSD-3-Clause
/// \file Newton's method on a manifold: the method, its steps, and its search along them.
#pragma once

#include <pyrod/solve/newton_method.hpp>
#include <pyrod/solve/newton_search.hpp>
#include <pyrod/solve/newton_step.hpp>
