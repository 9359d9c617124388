"""Where a rod is at rest, and its shape there."""

from __future__ import annotations

from numpy.typing import ArrayLike

from pyrod.base.immutable import Array, frozen, vector
from pyrod.rod.rod import Rod, rod_of
from pyrod.rotation import as_frame, exp, frame_along, multiply, unit_frame


def placed(
    rod: Rod,
    position: ArrayLike | None = None,
    frame: ArrayLike | None = None,
    *,
    tangent: ArrayLike | None = None,
    normal: ArrayLike | None = None,
) -> Rod:
    """The same rod with its start elsewhere at rest.

    Parameters
    ----------
    rod : `Rod`
    position, frame, tangent, normal : as for `Clamp`
    """
    if tangent is not None:
        frame = frame_along(tangent, normal)
    place = (
        rod.placement[0] if position is None else vector(position, "position"),
        rod.placement[1] if frame is None else frozen(unit_frame(frame, "frame")),
    )
    return rod_of(rod._compiled.replaced(rod.model, *place), rod._law, place)


def frame_at_rest(rod: Rod, vertex: int, frames: Array | None = None) -> Array:
    """(4,) frame of a vertex at rest.

    Parameters
    ----------
    rod : `Rod`
    vertex : int
    frames : (n, 4) array
        Those of the edges, if they are at hand.
    """
    if vertex == 0:
        return rod.placement[1]
    q = rod.at_rest()[1] if frames is None else frames
    return multiply(q[vertex - 1], exp(rod.edge_lengths[vertex - 1] / 2 * rod.K0[vertex]))


def at_rest(
    rod: Rod, position: ArrayLike | None = None, frame: ArrayLike | None = None
) -> tuple[Array, Array]:
    """Positions (n + 1, 3) and frames (n, 4) of the stress-free shape, started as given.

    Parameters
    ----------
    rod : `Rod`
    position : (3,) array [m]
        Of the start; default: its ``placement``.
    frame : (4,) or (3, 3) array
        Of the start; default: the same.
    """
    return rod._compiled.at_rest(
        rod.placement[0] if position is None else vector(position, "position"),
        rod.placement[1] if frame is None else as_frame(frame, "frame"),
    )
