// SPDX-License-Identifier: BSD-3-Clause
/// \file Functions that pyrod::compiled has; without it they are inline, and headers that declare
/// them include their definitions.
#pragma once

#ifdef PYROD_COMPILED
#define PYROD_DEFINITION
#else
#define PYROD_DEFINITION inline
#endif
