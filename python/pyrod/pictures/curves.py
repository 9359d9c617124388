"""Curves without mechanics as lines, tubes and ribbons, for pyvista."""

from __future__ import annotations

from typing import Any, Union

import numpy as np
from numpy.typing import NDArray

from pyrod.base.arrays import number, whole
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.curve import FramedCurve, Polyline
from pyrod.rotation import rotate

Indices = NDArray[np.intp]


def curve_poly(
    curve: Union[Polyline, FramedCurve],
    *,
    radius: float | None = None,
    width: float | None = None,
    sides: int = 24,
) -> Any:
    """The curve as a line, a tube or a ribbon, for pyvista.

    Parameters
    ----------
    curve : `Polyline` or `FramedCurve`
    radius : float [m]
        Of a tube around it, the surface of VTK's filter.
    width : float [m]
        Of a ribbon, from one side to the other along a1: of framed curves.
    sides : int
        Of the tube, at least 3; default 24.

    Returns
    -------
    ``pyvista.PolyData``
        Point data are "s", the arc length, "curvature" and, of framed curves, the directors "a1",
        "a2", "a3"; lines have "torsion" on their cells, one for each edge.

    Raises
    ------
    ValueError
        Both, or a width of a curve without frames; sizes that are not positive.
    ImportError
        pyvista is not installed: ``pip install 'pyrod[view]'``.
    """
    if width is not None and (radius is not None or not isinstance(curve, FramedCurve)):
        raise ValueError("width: is of the ribbon of a FramedCurve, and not together with radius")
    pyvista = need("pyvista", "view")
    arc = curve.polyline if isinstance(curve, FramedCurve) else curve
    columns = _point_data(curve, arc)
    n = len(arc.positions)
    if width is not None:
        across = _length_of(width, "width") / 2 * columns["a1"]
        points = np.vstack([arc.positions - across, arc.positions + across])
        start, end = _ends(arc)
        corners = np.column_stack([np.full(arc.edges, 4), start, end, end + n, start + n])
        made = pyvista.PolyData(points, corners.ravel())
        made.point_data.update({name: np.concatenate([x, x]) for name, x in columns.items()})
        return made
    if radius is None:
        start, end = _ends(arc)
        lines = np.column_stack([np.full(arc.edges, 2), start, end])
        made = pyvista.PolyData(arc.positions, lines=lines.ravel())
        made.point_data.update(columns)
        made.cell_data["torsion"] = arc.torsion()
        return made
    sides = whole(sides, "sides")
    if sides < 3:
        raise ValueError(f"sides: must be at least 3, got {sides}")
    order = [*range(n), *([0] if arc.closed else [])]
    line = pyvista.PolyData(arc.positions, lines=[len(order), *order])
    line.point_data.update(columns)
    return line.tube(radius=_length_of(radius, "radius"), n_sides=sides)


def _point_data(curve: Union[Polyline, FramedCurve], arc: Polyline) -> dict[str, Array]:
    columns = {"s": arc.arc_lengths, "curvature": arc.curvature(ends="continued")}
    if isinstance(curve, FramedCurve):
        for name, axis in zip(("a1", "a2", "a3"), np.eye(3), strict=True):
            columns[name] = rotate(curve.vertex_frames, axis)
    return {name: np.array(x) for name, x in columns.items()}


def _ends(arc: Polyline) -> tuple[Indices, Indices]:
    """Numbers of the vertices at both ends of the edges."""
    start = np.arange(arc.edges)
    return start, (start + 1) % len(arc.positions)


def _length_of(value: Any, name: str) -> float:
    made = number(value, name)
    if not 0 < made < np.inf:
        raise ValueError(f"{name}: must be positive, got {made}")
    return made
