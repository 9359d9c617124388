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

    Parameters
    ----------
    rod : the rod.
    positions : (n + 1, 3).
    frames : (n, 4) unit quaternions; their signs matter, a turn may reach 2 pi.
    start_frame, end_frame : (4,) frames that hold the ends. An end without one has no half cell
        and no energy there.

    Strains that the rod's model excludes carry no energy.
    """
    bend_twist, stretch_shear, gradient, hessian = rod._compiled.energy(
        rows(positions, "positions", 3),
        as_frames(frames, "frames"),
        None if start_frame is None else as_frame(start_frame, "start_frame"),
        None if end_frame is None else as_frame(end_frame, "end_frame"),
    )
    return Energy(bend_twist, stretch_shear, frozen(gradient), hessian)
