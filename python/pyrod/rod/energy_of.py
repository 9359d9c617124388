"""The elastic energy of a rod."""

from __future__ import annotations

from numpy.typing import ArrayLike

from pyrod.base.arrays import rows
from pyrod.base.immutable import frozen
from pyrod.rod.energy import Energy
from pyrod.rod.rod import Rod
from pyrod.rotation import as_frame, as_frames


def energy_of(
    rod: Rod,
    positions: ArrayLike,
    frames: ArrayLike,
    start_frame: ArrayLike | None = None,
    end_frame: ArrayLike | None = None,
) -> Energy:
    """Elastic energy, Linn (49) and (51), with gradient and Hessian.

    Strains that the rod's model excludes carry no energy.

    Parameters
    ----------
    rod : `Rod`
    positions : (n + 1, 3) array [m]
        The vertices.
    frames : (n, 4) array
        Unit quaternions; their signs matter, a turn may reach 2 pi.
    start_frame, end_frame : (4,) array
        Frames that hold the ends. An end without one has no half cell and no energy there.
    """
    bend_twist, stretch_shear, gradient, hessian = rod._compiled.energy(
        rows(positions, "positions", 3),
        as_frames(frames, "frames"),
        None if start_frame is None else as_frame(start_frame, "start_frame"),
        None if end_frame is None else as_frame(end_frame, "end_frame"),
    )
    return Energy(bend_twist, stretch_shear, frozen(gradient), hessian)
