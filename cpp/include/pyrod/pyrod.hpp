// SPDX-License-Identifier: BSD-3-Clause
/// \file All of pyrod.
#pragma once

#include <pyrod/rod/energy.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/statics/solve.hpp>
