"""Ribbons, curves whose frames are adapted: how they are linked, and their edges."""

from __future__ import annotations

import numpy as np

from pyrod.base.arrays import number
from pyrod.curve._arc import require_closed
from pyrod.curve._framed import FramedCurve
from pyrod.curve._knots import nearest_whole
from pyrod.curve._polyline import Polyline
from pyrod.rotation import rotate


def link(ribbon: FramedCurve, threads: int = 0) -> int:
    """Linking number of a closed ribbon, twist plus writhe (Calugareanu, White, Fuller).
    O(n^2).

    The frames must be adapted: the twist is that about the edges.
    """
    require_closed(ribbon.polyline, "link")
    away = np.abs(rotate(ribbon.frames, [0.0, 0.0, 1.0]) - ribbon.polyline.tangents).max(axis=1)
    worst = int(np.argmax(away))
    if away[worst] > 1e-9:
        raise ValueError(
            f"frames[{worst}]: a3 is not along the edge; take adapted(), whose frames are"
        )
    return nearest_whole(ribbon.twist + ribbon.polyline.writhe(threads))


def edge(ribbon: FramedCurve, distance: float, threads: int = 0) -> Polyline:
    """The edge of the ribbon: each vertex moved by ``distance`` along a1 of its frame.

    It winds around a closed curve as often as `link` says if it stays near enough. Raises
    ``ValueError`` beyond half the `Polyline.self_approach`, where it could pass through another
    part of the curve. O(n^2).
    """
    distance = number(distance, "distance")
    nearest = ribbon.polyline.self_approach(threads)
    if not 0 < abs(distance) < nearest.distance / 2:
        raise ValueError(
            f"distance: must be less than {nearest.distance / 2:.3g}, half that of the edges "
            f"{nearest.edge} and {nearest.other}, and not 0; got {distance}"
        )
    a1 = rotate(ribbon.vertex_frames, np.array([1.0, 0.0, 0.0]))
    return Polyline(ribbon.polyline.positions + distance * a1, ribbon.polyline.closed)
