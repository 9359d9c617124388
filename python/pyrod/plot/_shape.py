"""The shape: centrelines in space or in the plane of the scene."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from pyrod.base.immutable import Array
from pyrod.base.optional import need
from pyrod.pictures.box import box
from pyrod.pictures.measure import Colouring, measure
from pyrod.result.equilibrium import Equilibrium
from pyrod.result.rods import RodEquilibrium
from pyrod.result.tendons import ways
from pyrod.rotation import conjugate, rotate


def new_axes(result: Equilibrium, figure: Any = None, place: Any = 111) -> Any:
    """Axes for shapes: flat for a planar scene, else three-dimensional."""
    figure = need("matplotlib.pyplot", "plot").figure() if figure is None else figure
    return figure.add_subplot(place, projection=None if in_plane(result) else "3d")


def in_plane(result: Equilibrium) -> bool:
    """Whether the scene is."""
    return result.scene.space == "planar"


def draw_shape(
    result: Equilibrium, ax: Any, directors: bool, colour_by: str | None, style: dict[str, Any]
) -> Any:
    """All rods, one colour each, or coloured by a quantity."""
    by = None if colour_by is None else measure(result, colour_by)
    if by is not None and {"color", "c"} & set(style):
        raise ValueError("color: give either it or colour_by, not both")
    ax = new_axes(result) if ax is None else ax
    shapes = [rod.positions for rod in result.rods]
    if by is None:
        lines = draw_lines(result, ax, shapes, {} if in_plane(result) else {"linewidth": 2}, style)
        colours = [line.get_color() for line in lines]
    else:
        _draw_coloured(result, ax, by, style)
        colours = ["0.5"] * len(shapes)
    if directors and not in_plane(result):
        for rod, colour in zip(result.rods, colours, strict=True):
            _draw_fringe(rod, ax, colour)
    for way in ways(result):
        ax.plot(*coordinates(result, way).T, color="0.3", linewidth=0.8)
    return ax


def draw_lines(
    result: Equilibrium,
    ax: Any,
    shapes: Sequence[Array],
    default: dict[str, Any],
    style: dict[str, Any],
) -> list[Any]:
    """A line through the vertices of each rod, on axes of equal scales."""
    lines = []
    for r in shapes:
        lines += ax.plot(*coordinates(result, r).T, **{**default, **style})
    _finish(result, ax, shapes)
    return lines


def coordinates(result: Equilibrium, r: Array) -> Array:
    """In the plane of the scene: a3 of its first clamp to the right, a1 upwards; else in space."""
    if not in_plane(result):
        return r
    origin, frame = result.scene.plane
    return rotate(conjugate(frame), r - origin)[:, [2, 0]]


def _finish(result: Equilibrium, ax: Any, shapes: Sequence[Array]) -> None:
    if in_plane(result):
        ax.set_aspect("equal", adjustable="datalim")
        ax.set(xlabel="along the clamp's a3 [m]", ylabel="along the clamp's a1 [m]")
    else:
        ax.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")
        _equal_scales(ax, np.vstack(shapes))


def _draw_coloured(result: Equilibrium, ax: Any, by: Colouring, style: dict[str, Any]) -> None:
    """Pieces of the centrelines, and a bar that tells their colours."""
    shapes = [rod.positions for rod in result.rods]
    pieces, values = [], np.concatenate(by.values)
    for r in shapes:
        pieces += list(_pieces(coordinates(result, r), by.place))
    look = {"linewidth": 3, "capstyle": "round", **style}
    if in_plane(result):
        lines = need("matplotlib.collections", "plot").LineCollection(pieces, array=values, **look)
        ax.add_collection(lines)
        ax.autoscale_view()
    else:
        art = need("mpl_toolkits.mplot3d.art3d", "plot")
        lines = art.Line3DCollection(pieces, array=values, **look)
        ax.add_collection3d(lines)
    _finish(result, ax, shapes)
    ax.figure.colorbar(lines, ax=ax, label=by.label, shrink=0.7, pad=0.1)


def _pieces(r: Array, place: str) -> Array:
    """The edges, or for each vertex the half edges beside it."""
    if place == "edge":
        return np.stack([r[:-1], r[1:]], axis=1)
    middle = (r[:-1] + r[1:]) / 2
    return np.stack([np.vstack([r[:1], middle]), r, np.vstack([middle, r[-1:]])], axis=1)


def _draw_fringe(rod: RodEquilibrium, ax: Any, colour: Any) -> None:
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    r = rod.positions
    width = 0.03 * rod.rod.length
    edge = r + width * rotate(rod.vertex_frames, np.array([1.0, 0.0, 0.0]))
    faces = np.stack([r[:-1], r[1:], edge[1:], edge[:-1]], axis=1)
    ax.add_collection3d(Poly3DCollection(faces, facecolor=colour, alpha=0.35))


def _equal_scales(ax: Any, r: Array) -> None:
    """One scale for all axes; a rod in a plane still gets a box that is not flat."""
    from matplotlib.ticker import MaxNLocator

    limits = np.array([ax.get_xlim3d(), ax.get_ylim3d(), ax.get_zlim3d()])
    low, high = box(np.vstack([limits.T, r]))
    size = high - low
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_box_aspect(size)
    for axis, share in zip((ax.xaxis, ax.yaxis, ax.zaxis), size / size.max(), strict=True):
        axis.set_major_locator(MaxNLocator(max(2, round(6 * share))))
