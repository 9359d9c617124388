// SPDX-License-Identifier: BSD-3-Clause
/// \file All of pyrod.
#pragma once

#include <pyrod/curve/approach.hpp>
#include <pyrod/curve/averages.hpp>
#include <pyrod/curve/conversion.hpp>
#include <pyrod/curve/link.hpp>
#include <pyrod/rod/energy.hpp>
#include <pyrod/rod/refinement.hpp>
#include <pyrod/rod/section.hpp>
#include <pyrod/statics/cantilever_levels.hpp>
#include <pyrod/statics/network_levels.hpp>
