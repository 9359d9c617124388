// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "bind.hpp"

#include <pyrod/curve/cosserat.hpp>

namespace pyrod::bind {

/// Arrays of positions and frames as a curve on the grid, checked; ends without a frame take that
/// of their edge.
CosseratCurve<Spatial> framed_curve(const Grid& grid, const Array& positions, const Array& frames,
                                    const std::optional<Array>& start_frame,
                                    const std::optional<Array>& end_frame,
                                    Measure measure = Measure::log);

}  // namespace pyrod::bind
