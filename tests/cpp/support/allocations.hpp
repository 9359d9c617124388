// SPDX-License-Identifier: BSD-3-Clause
/// \file Counts what `new` allocates.
#pragma once

#include <cstddef>

namespace pyrod::test {

/// How often operator new was called so far in this program.
std::size_t allocations();

}  // namespace pyrod::test
