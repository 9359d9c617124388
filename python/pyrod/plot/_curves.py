"""Curves without mechanics."""

from __future__ import annotations

from typing import Any, Union

import numpy as np
from numpy.typing import ArrayLike

from pyrod.base.arrays import array
from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.curve import FramedCurve, Polyline
from pyrod.rotation import rotate

_FRINGE = 0.03
"""Of the length of a curve: how wide the fringe is that shows how its frames turn."""


def draw_curve(
    curve: Union[Polyline, FramedCurve],
    ax: Any = None,
    *,
    colour_by: ArrayLike | None = None,
    label: str = "",
    **style: Any,
) -> Any:
    """Draws the curve with matplotlib.

    Framed curves have a fringe along a1. A curve in the plane z = 0 without frames is drawn on flat
    axes, unless others are given.

    Parameters
    ----------
    curve : `Polyline` or `FramedCurve`
    ax : Axes
        Axes to draw on; made if not given.
    colour_by : (k,) or (n,) array
        Values of the k vertices, or of the n edges of an open curve, such as its curvature;
        coloured with a bar.
    label : str
        What the values are, with their unit, for the bar.
    style : object
        Passed to ``Axes.plot``, or to the collection of coloured lines.

    Returns
    -------
    Axes
        With equal scales.

    Raises
    ------
    ValueError
        Another number of values.
    ImportError
        matplotlib is not installed: ``pip install 'pyrod[plot]'``.
    """
    pyplot = need("matplotlib.pyplot", "plot")
    arc = curve.polyline if isinstance(curve, FramedCurve) else curve
    r = arc.positions[[*range(len(arc.positions)), *([0] if arc.closed else [])]]
    flat = not isinstance(curve, FramedCurve) and not r[:, 2].any()
    if ax is None:
        ax = pyplot.figure().add_subplot(projection=None if flat else "3d")
    in_space = hasattr(ax, "get_zlim")
    shown = r if in_space else r[:, :2]
    if colour_by is None:
        (line,) = ax.plot(*shown.T, **style)
        colour = line.get_color()
    else:
        _draw_coloured_edges(ax, shown, _of_edges(arc, colour_by), label, style, in_space)
        colour = "0.5"
    if isinstance(curve, FramedCurve) and in_space:
        _draw_side(curve, ax, r, colour)
    ax.set(xlabel="x [m]", ylabel="y [m]")
    if in_space:
        ax.set(zlabel="z [m]")
        ax.set_aspect("equal")
    else:
        ax.set_aspect("equal", adjustable="datalim")
    return ax


def _of_edges(arc: Polyline, values: ArrayLike) -> Array:
    x = array(values, "colour_by")
    if x.shape == (len(arc.positions),):
        return arc.at_centres(x)
    if x.shape == (arc.edges,):
        return x
    raise ValueError(
        f"colour_by: expected {len(arc.positions)} values (one per vertex) or {arc.edges} (one per "
        f"edge), got shape {x.shape}"
    )


def _draw_coloured_edges(
    ax: Any, r: Array, values: Array, label: str, style: dict[str, Any], in_space: bool
) -> None:
    pieces = np.stack([r[:-1], r[1:]], axis=1)
    look = {"linewidth": 3, "capstyle": "round", **style}
    if in_space:
        art = need("mpl_toolkits.mplot3d.art3d", "plot")
        lines = art.Line3DCollection(pieces, array=values, **look)
        ax.add_collection3d(lines)
        ax.auto_scale_xyz(*r.T)
    else:
        lines = need("matplotlib.collections", "plot").LineCollection(pieces, array=values, **look)
        ax.add_collection(lines)
        ax.autoscale_view()
    ax.figure.colorbar(lines, ax=ax, label=label, shrink=0.7, pad=0.1)


def _draw_side(curve: FramedCurve, ax: Any, r: Array, colour: Any) -> None:
    art = need("mpl_toolkits.mplot3d.art3d", "plot")
    a1 = rotate(curve.vertex_frames, [1.0, 0.0, 0.0])
    a1 = np.vstack([a1, a1[:1]]) if curve.polyline.closed else a1
    side = r + _FRINGE * curve.polyline.length * a1
    faces = np.stack([r[:-1], r[1:], side[1:], side[:-1]], axis=1)
    ax.add_collection3d(art.Poly3DCollection(faces, facecolor=colour, alpha=0.35))
