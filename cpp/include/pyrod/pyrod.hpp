// SPDX-License-Identifier: BSD-3-Clause
/// \file All of pyrod.
#pragma once

#include <pyrod/core/parallel.hpp>
#include <pyrod/curve/approach.hpp>
#include <pyrod/curve/averages.hpp>
#include <pyrod/curve/bishop.hpp>
#include <pyrod/curve/conversion.hpp>
#include <pyrod/curve/framing.hpp>
#include <pyrod/curve/frenet.hpp>
#include <pyrod/curve/link.hpp>
#include <pyrod/linear/linearised.hpp>
#include <pyrod/paths/branch.hpp>
#include <pyrod/rod/energy.hpp>
#include <pyrod/scene.hpp>
#include <pyrod/scene/plane.hpp>
