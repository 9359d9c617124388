// SPDX-License-Identifier: BSD-3-Clause
/// \file Which part of a vertex's cell is meant.
#pragma once

namespace pyrod {

/// The whole cell, from edge to edge; or that half of it which lies before the vertex, or behind.
enum class CellKind { whole, before, behind };

}  // namespace pyrod
