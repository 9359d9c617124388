"""Frenet's numbers and Bishop's, and polylines that are not yet regular."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array, finite, number, rows, transposed, yes_or_no


def bishop_from_frenet(curvature: ArrayLike, dihedral_angles: ArrayLike) -> Array:
    """Curvature binormals in the Bishop frame whose a2 is the first binormal.

    Parameters
    ----------
    curvature : (n + 1,) array [1/m]
        kappa at the vertices, in any measure; (n,) if the curve is closed.
    dihedral_angles : (n,) array [rad]
        Angles alpha of the edges: torsion times edge length.

    Returns
    -------
    (n + 1, 3) or (n, 3) array [1/m]
        K = (kappa1, kappa2, 0). Exact at any coarseness: parallel transport keeps binormals at
        vertices, and along an edge they turn by alpha.
    """
    return _core.curve.bishop_curvature(
        finite(curvature, "curvature"), finite(dihedral_angles, "dihedral_angles")
    )


def frenet_from_bishop(K: ArrayLike) -> tuple[Array, Array]:
    """The inverse of `bishop_from_frenet`: curvature and dihedral angles, from -pi to pi.

    Where the curvature vanishes the binormal stays as it was, so that the whole angle falls on the
    edge into the next bent vertex.

    Parameters
    ----------
    K : (n + 1, 3) array [1/m]
        Curvatures in Bishop frames at the vertices of an open curve; the third column, which is
        zero there, is not looked at.
    """
    return _core.curve.frenet_numbers(rows(K, "K", 3))


def without_repeats(
    positions: ArrayLike, closed: bool = False, distance: float = 0.0
) -> tuple[Array, Array]:
    """Leaves out vertices that coincide with the one kept before them.

    Returns the vertices that are kept, and their indices.

    Parameters
    ----------
    positions : (m, 3) or (m, 2) array [m]
        Vertices.
    closed : bool
        Whether the last vertex is also compared with the first, which repeats it in many files.
    distance : float [m]
        Two vertices coincide if they are no farther apart than this.
    """
    r = array(positions, "positions")
    if r.ndim != 2 or r.shape[1] not in (2, 3):
        hint = transposed(r, 2, 3)
        raise ValueError(f"positions: expected shape (m, 3) or (m, 2), got {r.shape}{hint}")
    if not np.isfinite(r).all():
        worst = int(np.argmin(np.isfinite(r).all(axis=1)))
        raise ValueError(f"positions[{worst}]: expected finite numbers, got {r[worst]}")
    closed, distance = yes_or_no(closed, "closed"), number(distance, "distance")
    if not distance >= 0:
        raise ValueError(f"distance: must not be negative, got {distance}")
    points = r.tolist()  # for single points much faster than rows of an array
    kept: list[int] = []
    for j, point in enumerate(points):
        if not kept or math.dist(point, points[kept[-1]]) > distance:
            kept.append(j)
    while closed and len(kept) > 1 and math.dist(points[kept[-1]], points[kept[0]]) <= distance:
        kept.pop()
    return r[kept], np.array(kept, dtype=np.intp)
