"""Discrete Cosserat curves: strains from positions and frames, and back (Linn 2020, sect. 6)."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
from numpy.typing import ArrayLike

import pyrod._core as _core
from pyrod.base.arrays import Array, array, rows, yes_or_no
from pyrod.base.immutable import vector
from pyrod.base.words import shortly
from pyrod.rotation import as_frame, from_matrix, quaternions

Measure = Literal["log", "chord", "cayley"]
"""The size of a turn by theta, which is theta, 2 sin(theta/2), or 2 tan(theta/2).

All agree to the third order in theta. "log" tells turns of frames up to 2 pi, the others up to pi;
a chord is at most 2, "cayley" goes to infinity at pi.
"""


def checked_measure(measure: Any, *also: str) -> Any:
    """The name of a measure; refuses what is none."""
    names = ("log", "chord", "cayley", *also)
    if not isinstance(measure, str) or measure not in names:
        raise ValueError(f"measure: expected one of {', '.join(names)}, got {shortly(measure)}")
    return measure


def strains(
    edge_lengths: ArrayLike,
    positions: ArrayLike,
    frames: ArrayLike,
    start_frame: ArrayLike | None = None,
    end_frame: ArrayLike | None = None,
    *,
    measure: Measure = "log",
    closed: bool = False,
) -> tuple[Array, Array]:
    """Material strains of a framed curve, Linn (48) and (50).

    Parameters
    ----------
    edge_lengths : (n,) array [m]
        Reference lengths h of the edges.
    positions : (n + 1, 3) array [m]
        Vertices; (n, 3) if closed.
    frames : (n, 4) array
        Unit quaternions, the frames of the edges. Signs matter: a turn may reach 2 pi.
    start_frame, end_frame : (4,) array
        Frames that hold the ends; an end without one does not turn over its half edge.
    measure : `Measure`
        How the turn from one frame to the next is measured, see `Measure`.
    closed : bool
        Whether the last edge leads back to vertex 0, where the smaller of the two possible turns
        counts.

    Returns
    -------
    K : (n + 1, 3) array [1/m]
        Curvature at the vertices; (n, 3) if closed.
    Gamma : (n, 3) array
        Shear and stretch of the edges.

    Raises
    ------
    ValueError
        Neighbouring frames differ by 2 pi (other measures than "log": by pi or more).
    """
    return _core.curve.strains(
        array(edge_lengths, "edge_lengths"),
        rows(positions, "positions", 3),
        _rows_of_frames(frames),
        None if start_frame is None else as_frame(start_frame, "start_frame"),
        None if end_frame is None else as_frame(end_frame, "end_frame"),
        checked_measure(measure),
        yes_or_no(closed, "closed"),
    )


def _rows_of_frames(frames: Any) -> Array:
    q = quaternions(frames, "frames")
    return from_matrix(q) if q.shape[1:] == (3, 3) else rows(q, "frames", 4)


def reconstruct(
    edge_lengths: ArrayLike,
    K: ArrayLike,
    Gamma: ArrayLike | None = None,
    position: ArrayLike = (0.0, 0.0, 0.0),
    frame: ArrayLike = (1.0, 0.0, 0.0, 0.0),
    *,
    measure: Measure = "log",
) -> tuple[Array, Array, Array]:
    """The curve with the given strains that starts at ``position`` in ``frame``.

    The exact inverse of `strains` of an open curve.

    Parameters
    ----------
    edge_lengths : (n,) array [m]
    K : (n + 1, 3) array [1/m]
        Curvature at the vertices.
    Gamma : (n, 3) array
        Default: (0, 0, 1) on every edge, neither sheared nor stretched.
    position : (3,) array [m]
    frame : (4,) or (3, 3) array
    measure : `Measure`

    Returns
    -------
    positions : (n + 1, 3) array [m]
    frames : (n, 4) array
    end : (4,) array
        The frame of the end.
    """
    h = array(edge_lengths, "edge_lengths")
    if Gamma is None:
        Gamma = np.tile([0.0, 0.0, 1.0], (h.size, 1))
    return _core.curve.reconstruct(
        h,
        rows(K, "K", 3),
        rows(Gamma, "Gamma", 3),
        vector(position, "position"),
        as_frame(frame, "frame"),
        checked_measure(measure),
    )
