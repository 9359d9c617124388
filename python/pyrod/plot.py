"""Pictures of rods with matplotlib, which is imported when one is drawn."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from pyrod.rotation import rotate

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from pyrod.equilibrium import Equilibrium, RodEquilibrium


def draw(
    result: Equilibrium, ax: Axes | None = None, *, directors: bool = True, **style: Any
) -> Axes:
    """Draws the centrelines, with a fringe along director a1 that shows how the rod is twisted.

    Parameters
    ----------
    result : what to draw.
    ax : axes to draw on; made if not given: flat for a planar scene, else three-dimensional.
    directors : draw the fringe (in space only).
    style : passed to ``Axes.plot``.

    Returns the axes, with equal scales and labelled with coordinates in metres.
    """
    import matplotlib.pyplot as plt

    planar = result.scene.space == "planar"
    if ax is None:
        ax = plt.figure().add_subplot(projection=None if planar else "3d")
    if planar:
        _draw_planar(result, ax, style)
    else:
        for rod in result.rods:
            _draw_spatial(rod, ax, directors, style)
        _equal_scales(ax, np.vstack([rod.positions for rod in result.rods]))
    return ax


def _draw_planar(result: Equilibrium, ax: Axes, style: dict[str, Any]) -> None:
    """In the plane of the scene: a3 of its first clamp to the right, a1 upwards."""
    origin, frame = result.scene.plane
    for rod in result.rods:
        local = rotate(frame * np.array([1, -1, -1, -1]), rod.positions - origin)
        ax.plot(local[:, 2], local[:, 0], **style)
    ax.set_aspect("equal", adjustable="datalim")
    ax.set(xlabel="along the clamp's a3 [m]", ylabel="along the clamp's a1 [m]")


def _draw_spatial(rod: RodEquilibrium, ax: Any, directors: bool, style: dict[str, Any]) -> None:
    r = rod.positions
    (line,) = ax.plot(*r.T, **{"linewidth": 2, **style})
    if directors:
        from mpl_toolkits.mplot3d.art3d import Poly3DCollection

        width = 0.03 * rod.rod.length
        edge = r + width * rotate(rod.vertex_frames, np.array([1.0, 0.0, 0.0]))
        faces = np.stack([r[:-1], r[1:], edge[1:], edge[:-1]], axis=1)
        ax.add_collection3d(Poly3DCollection(faces, facecolor=line.get_color(), alpha=0.35))
    ax.set(xlabel="x [m]", ylabel="y [m]", zlabel="z [m]")


def _equal_scales(ax: Any, r: np.ndarray) -> None:
    """One scale for all axes; a rod in a plane still gets a box that is not flat."""
    from matplotlib.ticker import MaxNLocator

    limits = np.array([ax.get_xlim3d(), ax.get_ylim3d(), ax.get_zlim3d()])
    low = np.minimum(limits.min(axis=1), r.min(axis=0))
    high = np.maximum(limits.max(axis=1), r.max(axis=0))
    centre, size = (low + high) / 2, high - low
    size = np.maximum(size, size.max() / 4)
    low, high = centre - size / 2, centre + size / 2
    ax.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), zlim=(low[2], high[2]))
    ax.set_box_aspect(size)
    for axis, share in zip((ax.xaxis, ax.yaxis, ax.zaxis), size / size.max(), strict=True):
        axis.set_major_locator(MaxNLocator(max(2, round(6 * share))))
