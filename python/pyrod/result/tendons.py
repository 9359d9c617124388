"""Where tendons run in an equilibrium."""

from __future__ import annotations

import numpy as np

from pyrod.base.immutable import Array
from pyrod.result.equilibrium import Equilibrium
from pyrod.rotation import rotate


def ways(result: Equilibrium) -> list[Array]:
    """Of each tendon, (k, 3) points in the sections of the vertices that it passes."""
    out = []
    for tendon in result.scene.actuators:
        rod = result.rods[tendon.rod]
        s, rounding = rod.s, 1e-9 * rod.rod.length
        start = 0.0 if tendon.start is None else tendon.start
        end = s[-1] if tendon.end is None else tendon.end
        passed = (s >= start - rounding) & (s <= end + rounding)
        if callable(tendon.offset) or tendon.offset.ndim == 1:
            offsets = tendon.offsets(s[passed])
        else:
            offsets = tendon.offset[passed]
        in_section = np.column_stack([offsets, np.zeros(len(offsets))])
        out.append(rod.positions[passed] + rotate(rod.vertex_frames[passed], in_section))
    return out
